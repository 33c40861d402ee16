"""Lines that misbehave, for tests of a client: a bridge between it and a plant, and a device that is none."""
import contextlib
import itertools
import os
import select
import socket
import threading
import tty

names = itertools.count()


class Bridge:
    """Carries bytes between whoever connects to `port` and the plant's socket, each way in pieces that end with a 00.

    to_client, to_plant: what becomes of a piece, a function from bytes to bytes; set them at any time.
    kind: unix, tcp or pty, what the client sees.
    """

    def __init__(self, plant, folder, kind="unix"):
        self.to_client = self.to_plant = lambda piece: piece
        self._plant = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
        self._plant.connect(plant)
        self._ends = contextlib.ExitStack()
        self._ends.callback(self._plant.close)
        self._wake, self._stop = os.pipe()
        self._listener, self._client = None, None
        if kind == "pty":
            self._client, slave = os.openpty()
            tty.setraw(slave)
            self._ends.callback(os.close, slave)
            self.port = f"pty:{os.ttyname(slave)}"
        else:
            self._listener = socket.socket(socket.AF_UNIX if kind == "unix" else socket.AF_INET, socket.SOCK_STREAM)
            self._listener.bind(os.path.join(folder, f"line-{next(names)}") if kind == "unix" else ("127.0.0.1", 0))
            self._listener.listen()
            name = self._listener.getsockname()
            self.port = f"unix:{name}" if kind == "unix" else f"tcp:127.0.0.1:{name[1]}"
        self._thread = threading.Thread(target=self._carry, daemon=True)

    def __enter__(self):
        self._thread.start()
        return self

    def __exit__(self, *_):
        os.close(self._stop)
        self._thread.join()
        self._ends.close()

    def _carry(self):
        if self._listener:
            if self._wake in select.select([self._listener, self._wake], [], [])[0]:
                return
            self._client = self._listener.accept()[0].detach()
        ways = {self._client: [self._plant.fileno(), "to_plant", b""], self._plant.fileno(): [self._client, "to_client", b""]}
        with contextlib.suppress(OSError):
            while True:
                ready = select.select([*ways, self._wake], [], [])[0]
                if self._wake in ready:
                    break
                for source in ready:
                    if not self._carry_one(source, ways[source]):
                        return
        os.close(self._client)

    def _carry_one(self, source, way):
        data = os.read(source, 65536)
        *pieces, way[2] = (way[2] + data).split(b"\0")
        for piece in pieces:
            os.write(way[0], getattr(self, way[1])(piece + b"\0"))
        return bool(data)


@contextlib.contextmanager
def listener(folder, speak):
    """The port of a device that gives each piece it hears to speak(piece), and says what that returns."""
    path = os.path.join(folder, f"line-{next(names)}")
    server = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
    server.bind(path)
    server.listen()

    def serve():
        with contextlib.suppress(OSError):
            line = server.accept()[0]
            while heard := line.recv(65536):
                line.sendall(b"".join(speak(piece) for piece in heard.split(b"\0") if piece))

    thread = threading.Thread(target=serve, daemon=True)
    thread.start()
    try:
        yield f"unix:{path}"
    finally:
        server.close()
