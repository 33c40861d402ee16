#!/usr/bin/env python3
"""Whatever comes in, nothing is written where no object lies: memory around the image holds a pattern, console and link are
flooded with the fuzzer's corpus and random bytes, and the emulator tells what memory holds afterwards."""
import glob
import json
import os
import random
import select
import shutil
import socket
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from controller import TYPES, Controller, Silence, wire  # noqa: E402
from firmware import COMMANDS, Firmware, Tap  # noqa: E402

WHERE = "mps2-an386"
RAM, RAM_END, FLASH_END = 0x20000000, 0x20400000, 0x400000
PSRAM, PSRAM_END = 0x21000000, 0x22000000
STACK_SPARE = 1024  # bytes that the deepest call leaves, and that are 0 since power on
FLOOD_S, RANDOM_BYTES = 4.0, 20000
tap = Tap()
folder = tempfile.mkdtemp(prefix="squeal-memory-")


def path(name):
    return os.path.join(folder, name)


def sections(image):
    """Start and end by name of those that lie in RAM."""
    table = subprocess.run(["arm-none-eabi-objdump", "-h", image], capture_output=True, text=True, check=True).stdout
    rows = (line.split() for line in table.splitlines())
    found = {row[1]: (int(row[3], 16), int(row[3], 16) + int(row[2], 16)) for row in rows if row and row[0].isdigit()}
    return {name: (start, end) for name, (start, end) in found.items() if RAM <= start < RAM_END}


class Monitor:
    """QEMU's QMP: one command, one answer."""

    def __init__(self, where):
        until = time.monotonic() + 20
        while not os.path.exists(where) and time.monotonic() < until:
            time.sleep(0.02)
        self.socket = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
        self.socket.settimeout(20)
        self.socket.connect(where)
        self.stream = self.socket.makefile("rw")
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


def poke(where, address, byte):
    """One byte by the debugger's port."""
    peer = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
    peer.settimeout(20)
    peer.connect(where)
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


def hear(controller):
    """Takes what the link says, so that it goes on."""
    while select.select([controller.socket], [], [], 0)[0] and controller.socket.recv(65536):
        pass


def flood(firmware, controller):
    """Each input from a fresh set; beyond its time the rest is left out. Inputs, and bytes on either line."""
    until, said = time.monotonic() + FLOOD_S, [0, 0, 0]
    for console, link in inputs():
        if time.monotonic() > until:
            break
        firmware.send(b"\rdefaults\r" + console)
        controller.send(b"\0" + wire(TYPES["RESET"], 0, 0) + link)
        firmware.flush()
        hear(controller)
        said = [said[0] + 1, said[1] + len(console), said[2] + len(link)]
    noise = random.Random(2).randbytes(RANDOM_BYTES)
    for at in range(0, RANDOM_BYTES, 500):
        firmware.send(noise[at:at + 500])
        controller.send(noise[-at - 500:][:500])
        firmware.flush()
        hear(controller)
    return said


def link_answers(controller):
    """After whatever it was told; what is left of a frame that was not heard whole comes first."""
    until = time.monotonic() + 30
    controller.send(b"\0" + wire(TYPES["STOP"], 0, 0) + wire(TYPES["PING"], 4711, 0, b"squealed"))
    while time.monotonic() < until:
        try:
            kind, sequence, _, payload = controller.any_frame()
        except Silence:
            continue
        if (kind, sequence) == (TYPES["PING"] | 0x80, 4711):
            return payload == b"squealed"
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
    monitor, controller = Monitor(path("qmp")), Controller(path("link"))
    for name, (start, end) in (("code", (0, FLASH_END)), ("emergency stack", taken[".emergency"])):
        regions[name] = (start, monitor.memory(start, end))
    count, typed, framed = flood(firmware, controller)
    tap.note(f"{count} inputs, {typed} bytes on the console and {framed} on the link, then {RANDOM_BYTES} random ones on each")
    tap.check(count > 0 and link_answers(controller) and console_answers(firmware), "flooded, both lines answer")
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
    controller.close()

shutil.rmtree(folder)
tap.finish()
