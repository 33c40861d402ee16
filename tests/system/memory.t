#!/usr/bin/env python3
"""Whatever comes in, nothing is written where no object lies: memory around the image holds a pattern, console and link are
flooded with the fuzzer's corpus and random bytes, and the emulator tells what memory holds afterwards."""
import contextlib
import glob
import json
import os
import random
import shutil
import socket
import subprocess
import sys
import tempfile
import threading
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from controller import TYPES, unwire, wire  # noqa: E402
from firmware import COMMANDS, Firmware, Tap  # noqa: E402

WHERE = "mps2-an386"
RAM, RAM_END, FLASH_END = 0x20000000, 0x20400000, 0x400000
PSRAM, PSRAM_END = 0x21000000, 0x22000000
STACK_SPARE = 1024  # bytes that the deepest call leaves, and that are 0 since power on
FLOOD_S, RANDOM_BYTES, HEARD_MAX = 4.0, 20000, 4096
tap = Tap()
folder = tempfile.mkdtemp(prefix="squeal-memory-")


def path(name):
    return os.path.join(folder, name)


def connected(where):
    """A socket to where somebody is about to listen."""
    until = time.monotonic() + 20
    while not os.path.exists(where) and time.monotonic() < until:
        time.sleep(0.02)
    peer = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
    peer.settimeout(20)
    peer.connect(where)
    return peer


def sections(image):
    """Start and end by name of those that lie in RAM."""
    table = subprocess.run(["arm-none-eabi-objdump", "-h", image], capture_output=True, text=True, check=True).stdout
    rows = (line.split() for line in table.splitlines())
    found = {row[1]: (int(row[3], 16), int(row[3], 16) + int(row[2], 16)) for row in rows if row and row[0].isdigit()}
    return {name: (start, end) for name, (start, end) in found.items() if RAM <= start < RAM_END}


class Monitor:
    """QEMU's QMP: one command, one answer."""

    def __init__(self, where):
        self.stream = connected(where).makefile("rw")
        self.stream.readline()
        self.ask("qmp_capabilities")

    def ask(self, command, **arguments):
        self.stream.write(json.dumps({"execute": command, "arguments": arguments}) + "\n")
        self.stream.flush()
        while True:
            answer = json.loads(self.stream.readline())
            if "error" in answer:
                raise SystemExit(f"{command}: {answer['error']}")
            if "return" in answer:
                return answer["return"]

    def memory(self, start, end):
        self.ask("pmemsave", val=start, size=end - start, filename=path("saved"))
        with open(path("saved"), "rb") as saved:
            return saved.read()


class Link:
    """The link's other end: says anything, and hears everything meanwhile, so that the link never waits for it."""

    def __init__(self, where):
        self.socket, self.heard = connected(where), b""
        self.socket.settimeout(60)
        threading.Thread(target=self._hear, daemon=True).start()

    def _hear(self):
        with contextlib.suppress(OSError):
            while chunk := self.socket.recv(65536):
                self.heard = (self.heard + chunk)[-HEARD_MAX:]

    def send(self, data):
        self.socket.sendall(data)

    def frames(self):
        """Those heard last, and what is no frame as None."""
        return map(unwire, self.heard.split(b"\0"))


def poke(where, address, byte):
    """One byte by the debugger's port."""
    peer = connected(where)
    text = f"M{address:x},1:{byte:02x}"
    peer.sendall(f"+${text}#{sum(text.encode()) & 0xff:02x}".encode())
    heard = b""
    while b"$OK#9a" not in heard:
        heard += peer.recv(100)
    return peer


def spoiled(seen, wanted, start):
    """Addresses that do not hold what they should."""
    return [hex(start + at) for at in range(len(wanted)) if seen[at] != wanted[at]][:8] if seen != wanted else []


def inputs():
    """What each input of the corpus says on the console and on the link."""
    corpus = sorted(glob.glob("tests/fuzz/corpus/*"))
    random.Random(1).shuffle(corpus)
    subprocess.run([os.environ["REPLAY"], "--lines", folder, *corpus], check=True, stdout=subprocess.DEVNULL, timeout=60)
    for name in map(os.path.basename, corpus):
        with open(path(name + ".console"), "rb") as console, open(path(name + ".link"), "rb") as link:
            yield console.read(), link.read()


def flood(firmware, link):
    """Each input from a fresh set; beyond its time the rest is left out. Inputs, and bytes on either line."""
    until, said = time.monotonic() + FLOOD_S, [0, 0, 0]
    for typed, framed in inputs():
        if time.monotonic() > until:
            break
        firmware.send(b"\rdefaults\r" + typed)
        link.send(b"\0" + wire(TYPES["RESET"], 0, 0) + framed)
        firmware.flush()
        said = [said[0] + 1, said[1] + len(typed), said[2] + len(framed)]
    noise = random.Random(2).randbytes(RANDOM_BYTES)
    for at in range(0, RANDOM_BYTES, 500):
        firmware.send(noise[at:at + 500])
        link.send(noise[-at - 500:][:500])
        firmware.flush()
    return said


def link_answers(link):
    """After whatever it was told."""
    until, wanted = time.monotonic() + 30, (TYPES["PING"] | 0x80, 4711, b"squealed")
    link.send(b"\0" + wire(TYPES["STOP"], 0, 0) + wire(TYPES["PING"], 4711, 0, b"squealed"))
    while time.monotonic() < until:
        if wanted in ((frame[0], frame[1], frame[3]) for frame in link.frames() if frame):
            return True
        time.sleep(0.05)
    return False


def console_answers(firmware):
    firmware.send("\rstop\recho off\rstop\rget A_p")
    while not firmware.answer().startswith("ok get A_p=0.00229"):
        pass
    return True


image = COMMANDS[WHERE][-1]
taken = sections(image)
pattern = random.Random(3)
regions = {name: (start, pattern.randbytes(end - start)) for name, start, end in (
    ("RAM behind the objects", max(end for _, end in taken.values()), RAM_END), ("PSRAM", PSRAM, PSRAM_END))}
options = ["-qmp", f"unix:{path('qmp')},server=on,wait=off",
           "-chardev", f"socket,path={path('gdb')},server=on,wait=off,id=gdb", "-gdb", "chardev:gdb"]
for name, (start, content) in regions.items():
    with open(path(name), "wb") as file:
        file.write(content)
    options += ["-device", f"loader,file={path(name)},addr={start:#x},force-raw=on"]

with Firmware(WHERE, extra=options, link=path("link")) as firmware:
    monitor, link = Monitor(path("qmp")), Link(path("link"))
    for name, (start, end) in (("code", (0, FLASH_END)), ("emergency stack", taken[".emergency"])):
        regions[name] = (start, monitor.memory(start, end))
    count, typed, framed = flood(firmware, link)
    tap.note(f"{count} inputs, {typed} bytes on the console and {framed} on the link, then {RANDOM_BYTES} random ones on each")
    tap.check(count > 0 and link_answers(link) and console_answers(firmware), "flooded, both lines answer")
    monitor.ask("stop")
    stack = monitor.memory(*taken[".stack"])
    spare = len(stack) - len(stack.lstrip(b"\0"))
    tap.check(STACK_SPARE <= spare < len(stack), f"the stack keeps {STACK_SPARE} bytes to spare")
    tap.note(f"it took {len(stack) - spare} of {len(stack)} bytes")
    for name, (start, content) in regions.items():
        wrong = spoiled(monitor.memory(start, start + len(content)), content, start)
        tap.check(not wrong, f"{name}: {len(content)} bytes as they were", *wrong)
    start, content = regions["RAM behind the objects"]
    address = start + len(content) // 2
    peer = poke(path("gdb"), address, content[len(content) // 2] ^ 0xff)
    wrong = spoiled(monitor.memory(start, start + len(content)), content, start)
    tap.check(wrong == [hex(address)], "one byte that is written there is seen", *wrong)
    peer.close()

shutil.rmtree(folder)
tap.finish()
