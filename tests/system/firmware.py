"""Talks to a firmware image through its console, for the system tests. Standard library only."""
import os
import re
import select
import shlex
import signal
import subprocess
import sys
import time

sys.path.append(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from tap import Tap  # noqa: E402, F401: the tests have both from here

# By board, as make command prints them; "board" is the one under test.
COMMANDS = {name: shlex.split(command)
            for name, command in (line.split(": ", 1) for line in os.environ["COMMANDS"].splitlines())}
COMMANDS["board"] = COMMANDS[os.environ["BOARD"]]


# A test that is told to end does so by its with blocks, which end the firmware.
signal.signal(signal.SIGTERM, lambda *unused: sys.exit(1))


class Silence(Exception):
    """The firmware did not answer in time, or ended."""


def is_emulated(where):
    return "null" in COMMANDS[where]


def line(link):
    """The emulator's options for the link's line. A socket is as make monitor LINK= has it, the others are plain."""
    if link == "pty":
        return ["-serial", "pty"]
    if link.startswith("tcp:"):
        return ["-serial", f"tcp:127.0.0.1:{link[4:]},server=on,wait=off,nodelay=on"]
    return ["-chardev", f"socket,id=link,path={link},server=on,wait=off,mux=on", "-serial", "chardev:link", "-echr", "256"]


class Firmware:
    """One running image. Every wait has an end; the child never outlives the test."""

    def __init__(self, where="board", extra=(), limit_s=60.0, link=None):
        """link: a path, the firmware's link listens on a socket there; of an emulator tcp:PORT of this machine as well, or
        pty, whose name is then in pty."""
        # Options of the emulator go before -kernel, which is the last one; its second line is the link.
        command = COMMANDS[where]
        command = command[:1] + list(extra) + command[1:]
        environment = dict(os.environ)
        if link and is_emulated(where):
            null = command.index("null")
            command[null - 1:null + 1] = line(link)
        elif link:
            environment["SQUEAL_LINK"] = f"unix:{link}"
        self.limit_s = limit_s
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                        stderr=subprocess.DEVNULL, start_new_session=True, env=environment)
        os.set_blocking(self.process.stdout.fileno(), False)
        os.set_blocking(self.process.stdin.fileno(), False)
        self.input, self.lines, self.partial = b"", [], b""
        self.body, self.notices, self.samples = [], [], []
        self.pty = None
        self.hear_banner()
        self.ask("echo off")

    def __enter__(self):
        return self

    def __exit__(self, *unused):
        try:
            os.killpg(self.process.pid, signal.SIGKILL)
        except ProcessLookupError:
            pass
        self.process.wait()

    def _pump(self, until):
        """Moves bytes both ways once."""
        out, into = self.process.stdout, self.process.stdin
        readable, writable, _ = select.select([out], [into] if self.input else [], [], max(0.0, until - time.monotonic()))
        if writable:
            self.input = self.input[os.write(into.fileno(), self.input[:4096]):]
        if readable:
            chunk = os.read(out.fileno(), 65536)
            if not chunk:
                raise Silence("the firmware ended")
            *whole, self.partial = (self.partial + chunk).split(b"\r\n")
            self.lines += [line.decode("ascii", "replace") for line in whole]

    def hear_banner(self):
        """Waits for the firmware to speak: an emulated receiver may drop what comes before it is switched on."""
        until = time.monotonic() + self.limit_s
        while not any(re.search(r"^squeal ", line, re.MULTILINE) for line in self.lines):  # an emulator's line may stand before
            if time.monotonic() > until:
                raise Silence("no banner")
            self._pump(until)

    def send(self, data):
        self.input += data if isinstance(data, bytes) else data.encode() + b"\r"

    def flush(self):
        """Waits until all that was sent is on its way."""
        until = time.monotonic() + self.limit_s
        while self.input:
            self._pump(until)

    def answer(self):
        """Next line that begins with ok or error; what comes before is sorted."""
        until = time.monotonic() + self.limit_s
        self.body, self.notices, self.samples = [], [], []
        while True:
            while self.lines:
                line = self.lines.pop(0)
                if re.match(r"(ok|error) ", line):
                    return line
                if line.startswith("char device redirected to "):
                    self.pty = line.split()[4]
                if line.startswith("- "):
                    self.body.append(line[2:])
                elif line.startswith("! "):
                    self.notices.append(line[2:])
                elif re.match(r"\d", line):
                    self.samples.append(line.split(","))
            if time.monotonic() > until:
                raise Silence("no answer")
            self._pump(until)

    def ask(self, line):
        """Sends a line; its answer's fields, or the answer itself if it is an error."""
        self.send(line)
        answer = self.answer()
        return answer if answer.startswith("error") else fields(answer)


def fields(line):
    return dict(word.split("=", 1) for word in line.split() if "=" in word)
