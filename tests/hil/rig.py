"""Two firmwares wired together: a plant, and a controller that steers it over the link. Standard library only.

COMMANDS in the environment holds what make command prints, a line for each board; an image's neighbour, controller in place
of squeal, is the controller's."""
import os
import select
import shlex
import signal
import subprocess
import sys
import tempfile
import time

COLUMNS = ("turn step hash t_s speed_m_per_s demand_pa pressure_pa load_n friction_n amplitude_m propensity flags "
           "phase").split()
PROPENSITIES = ["unknown", "quiet", "watch", "squeal"]
PHASES = ["build", "hold", "release", "dither", "safe"]
COMMANDS = dict(line.split(": ", 1) for line in os.environ.get("COMMANDS", "").splitlines())

# Whoever is told to end does so by its with blocks, which end the children.
signal.signal(signal.SIGTERM, lambda *unused: sys.exit(1))


class Silence(Exception):
    """Nothing came in time, or the firmware has ended."""


class Child:
    """A firmware as a child process, with its console; it never outlives its with block. Every wait has an end."""

    def __init__(self, command, environment, limit_s):
        self.limit_s, self.partial, self.lines = limit_s, b"", []
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                        start_new_session=True, env={**os.environ, **environment})
        os.set_blocking(self.process.stdout.fileno(), False)

    def __enter__(self):
        return self

    def __exit__(self, *unused):
        try:
            os.killpg(self.process.pid, signal.SIGKILL)
        except ProcessLookupError:
            pass
        self.process.wait()

    def send(self, line):
        self.process.stdin.write(line.encode() + b"\r")
        self.process.stdin.flush()

    def pump(self, wait_s):
        """Fetches what the console has said, waiting so long for some."""
        out = self.process.stdout
        if not select.select([out], [], [], wait_s)[0]:
            return
        chunk = os.read(out.fileno(), 65536)
        if not chunk:
            error = self.process.stderr.read().decode(errors="replace").strip()
            raise Silence(f"{os.path.basename(self.process.args[0])} has ended. {error}")
        *whole, self.partial = (self.partial + chunk).split(b"\r\n")
        self.lines += [line.decode("ascii", "replace") for line in whole]

    def line(self):
        """The next line of the console."""
        until = time.monotonic() + self.limit_s
        while not self.lines:
            if time.monotonic() > until:
                raise Silence("no line in time")
            self.pump(0.1)
        return self.lines.pop(0)

    def ask(self, line):
        """The fields of a plant's answer."""
        self.send(line)
        while True:
            answer = self.line()
            if answer.startswith("error"):
                raise Silence(f"{line}: {answer}")
            if answer.startswith(f"ok {line.split()[0]} "):  # not that of an order before
                return read_fields(answer)

    def freeze(self, is_frozen):
        os.killpg(self.process.pid, signal.SIGSTOP if is_frozen else signal.SIGCONT)


def wired(board, link, options):
    """The board's command with its link at a socket. mux: as in hal/qemu.mk."""
    command = shlex.split(COMMANDS[board])
    if "null" in command:
        at = command.index("null")
        command[at - 1:at + 1] = ["-chardev", f"socket,id=link,path={link},mux=on{options}", "-serial", "chardev:link", "-echr", "256"]
    return command


def plant_command(board, link):
    return wired(board, link, ",server=on,wait=off"), {"SQUEAL_LINK": f"unix:{link}"}


def controller_command(board, link):
    """The controller measures silence, so its clock is that of the wall: no -icount, or real time on the host."""
    command = wired(board, link, "")
    if "-icount" in command:
        at = command.index("-icount")
        del command[at:at + 2]
    folder, image = os.path.split(command[-1])
    command[-1] = os.path.join(folder, image.replace("squeal", "controller"))
    return command, {"SQUEAL_LINK": f"unix-connect:{link}", "SQUEAL_REALTIME": "1"}


class Stop:
    """What the controller has told of a stop: a row a turn, the phases of its law, and how it ended."""

    def __init__(self):
        self.rows, self.phases, self.opened, self.end, self.fields = [], [], {}, "", {}

    def take(self, line):
        """True if the stop has ended with this line."""
        if line[:1].isdigit():
            values = line.split(",")
            self.rows.append({name: text if name == "hash" else int(text) if text.isdigit() else float(text)
                              for name, text in zip(COLUMNS, values)})
        elif line.startswith("phase "):
            fields = read_fields(line)
            self.phases.append((float(fields["t_s"]), fields["now"], float(fields["pressure_pa"])))
        elif line.startswith("opened "):
            self.opened = {key: float(text) for key, text in read_fields(line).items()}
        elif line.split(" ")[0] in ("score", "refused", "lost", "error"):
            self.end, self.fields = line, read_fields(line)
            return True
        return False

    def hashes(self):
        return [(row["step"], row["hash"]) for row in self.rows]

    def score(self, name):
        return float(self.fields[name])


def read_fields(line):
    return dict(word.split("=", 1) for word in line.split() if "=" in word)


class Rig:
    """A plant and its controller, booted and wired."""

    def __init__(self, plant="mps2-an386", controller=None, limit_s=30.0):
        self.folder = tempfile.TemporaryDirectory(prefix="squeal-hil-")
        self.boards, self.limit_s, self.children = (plant, controller or plant), limit_s, []

    def __enter__(self):
        link = os.path.join(self.folder.name, "link")
        try:
            self.plant = self.start(*plant_command(self.boards[0], link))
            while not self.plant.line().startswith("squeal "):  # its socket listens before it speaks
                pass
            self.controller = self.start(*controller_command(self.boards[1], link))
            while not self.controller.line().startswith("controller "):
                pass
        except BaseException:
            self.__exit__()
            raise
        return self

    def start(self, command, environment):
        child = Child(command, environment, self.limit_s)
        self.children.append(child)
        return child

    def __exit__(self, *unused):
        for child in self.children:
            child.__exit__()
        self.folder.cleanup()

    def stop(self, order, tamper=None):
        """Gives the order, "stop 2 law" say, and returns the Stop that it made. tamper(rig, stop), if given, is called after
        each line of the controller's but the last."""
        stop = Stop()
        self.controller.send(order)
        while not stop.take(self.controller.line()):
            self.plant.pump(0.0)
            if tamper:
                tamper(self, stop)
        return stop
