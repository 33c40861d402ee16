"""A program in a pseudo terminal, and what it shows there. Standard library only."""
import fcntl
import os
import pty
import re
import select
import signal
import struct
import termios
import time

SEQUENCE = re.compile(rb"\x1b\[([0-9;?]*)([A-Za-z])")


class Terminal:
    """Every wait has an end; the child never outlives the test."""

    def __init__(self, command, rows=24, cols=80, **variables):
        environment = dict(os.environ, TERM="xterm-256color", LANG="C.UTF-8", LC_ALL="", COLORTERM="", NO_COLOR="")
        environment.update(variables)
        self.pid, self.fd = pty.fork()
        if self.pid == 0:
            os.execvpe(command[0], command, environment)
        self.resize(rows, cols)
        self.attributes = termios.tcgetattr(self.fd)
        self.row = self.col = self.frames = self.received = 0
        self.is_alternate, self.is_cursor_shown, self.is_over = False, True, False
        self.raw, self.pending, self.looks, self.unknown = b"", b"", set(), set()
        self.code = None

    def __enter__(self):
        return self

    def __exit__(self, *unused):
        if self.code is None:
            os.kill(self.pid, signal.SIGTERM)  # it ends what it has started
        if self.code is None and self.end() is None:
            os.kill(self.pid, signal.SIGKILL)
            os.waitpid(self.pid, 0)
        os.close(self.fd)

    def resize(self, rows, cols):
        self.rows, self.cols = rows, cols
        self.cells = [[" "] * cols for _ in range(rows)]
        fcntl.ioctl(self.fd, termios.TIOCSWINSZ, struct.pack("HHHH", rows, cols, 0, 0))

    def send(self, keys):
        os.write(self.fd, keys if isinstance(keys, bytes) else keys.encode())

    def _sequence(self, parameters, last):
        if last == "H":
            row, _, col = parameters.partition(";")
            self.row, self.col = int(row or 1) - 1, int(col or 1) - 1
        elif last == "m":
            self.looks.add(parameters)
        elif last == "J":
            self.cells = [[" "] * self.cols for _ in range(self.rows)]
        elif parameters == "?1049":
            self.is_alternate = last == "h"
        elif parameters == "?25":
            self.is_cursor_shown = last == "h"
        elif parameters == "?2026":
            self.frames += last == "h"
        elif parameters != "?7":
            self.unknown.add(parameters + last)

    def _take(self, data):
        data = self.pending + data
        at, self.pending = 0, b""
        while at < len(data):
            found = SEQUENCE.match(data, at)
            size = 1 if data[at] < 0x80 else 2 if data[at] < 0xe0 else 3 if data[at] < 0xf0 else 4
            if found:
                self._sequence(found.group(1).decode(), found.group(2).decode())
                at = found.end()
            elif at + size > len(data) or (data[at] == 0x1b and len(data) - at < 16):
                self.pending = data[at:]
                return
            else:
                character = data[at:at + size].decode("utf-8", "replace")
                if 0 <= self.row < self.rows and 0 <= self.col < self.cols and character >= " ":
                    self.cells[self.row][self.col] = character
                self.col += 1
                at += size

    def pump(self, seconds):
        """Takes what comes for so long, or until the program has ended."""
        until = time.monotonic() + seconds
        while not self.is_over and time.monotonic() < until:
            if select.select([self.fd], [], [], max(0.0, until - time.monotonic()))[0]:
                try:
                    data = os.read(self.fd, 65536)
                except OSError:
                    data = b""
                self.is_over = not data
                self.raw += data
                self.received += len(data)
                self._take(data)

    def lines(self):
        return ["".join(row).rstrip() for row in self.cells]

    def text(self):
        return "\n".join(self.lines())

    def until(self, holds, limit_s=60.0):
        """Waits until that holds of the text shown: the text, or None."""
        end = time.monotonic() + limit_s
        while True:
            if holds(self.text()):
                return self.text()
            if self.is_over or time.monotonic() > end:
                return None
            self.pump(0.05)

    def end(self, limit_s=10.0):
        """The exit code, negative for a signal; None if it did not end."""
        until = time.monotonic() + limit_s
        while self.code is None and time.monotonic() < until:
            self.pump(0.02)
            pid, status = os.waitpid(self.pid, os.WNOHANG)
            if pid != 0:
                self.code = os.waitstatus_to_exitcode(status)
                self.pump(0.1)
        return self.code

    def last_words(self):
        """Lines after the terminal was given back."""
        return self.raw.rsplit(b"\x1b[?1049l", 1)[-1].decode("utf-8", "replace").split("\r\n")[:-1] if not self.is_alternate else []

    def is_as_it_was(self):
        return not self.is_alternate and self.is_cursor_shown and termios.tcgetattr(self.fd) == self.attributes
