#!/usr/bin/env python3
"""The board's hal from outside: floods in both directions, sleep, the exit code, and what becomes of a fault."""
import os
import re
import subprocess
import time

from tap import Tap

BOARD = os.environ["BOARD"]
IMAGE = os.environ["PROBE"]
COMMAND = ["timeout", "150", *os.environ["BOARD_RUN"].split(), IMAGE if os.sep in IMAGE else "./" + IMAGE]
PASTE = bytes(33 + (i * 7 + i // 91) % 90 for i in range(200000))
# Exception and cfsr. Where the stack overflows depends on the architecture: the processor of Armv8-M watches its end.
NOWHERE, OVERFLOWN, LIMITED = 0xF0000000, (4, 0x92), (6, 0x100000)
FAULTS = (("0", "a store to the null page", (4, 0x82)), ("1", "a load from nowhere", (5, 0x8200)),
          ("2", "a division by zero", (6, 0x2000000)), ("3", "an overflown stack", OVERFLOWN, LIMITED),
          ("4", "an unused interrupt", (36, 0)))
tap = Tap()


class Probe:
    """It speaks first: an emulated receiver may drop what comes before it is switched on."""

    def __init__(self):
        self.child = subprocess.Popen(COMMAND, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
        self.field("awake")

    def send(self, data):
        self.child.stdin.write(data.encode() if isinstance(data, str) else data)
        self.child.stdin.flush()

    def field(self, name):
        for line in self.child.stdout:
            if line.startswith(name.encode() + b"="):
                return int(line.split(b"=")[1])
        return None

    def end(self, data=b""):
        out = self.child.communicate(data.encode() if isinstance(data, str) else data)[0]
        return out.decode(), self.child.returncode


def paste(before):
    probe = Probe()
    probe.send(before + "p")
    probe.field("ready")
    probe.send(PASTE + b"\n")
    result = [probe.field(name) for name in ("count", "sum", "lost")]
    probe.end("q")
    wanted = 0
    for byte in PASTE:
        wanted = (wanted * 31 + byte) & 0xFFFFFFFF
    return result == [len(PASTE), wanted, 0], result


good, seen = paste("")
tap.check(good, "200 kB pasted into a sleeping main loop arrive whole", seen)
good, seen = paste("t")
tap.check(good, "and beside a tick of 10 kHz", seen)

probe = Probe()
probe.send("f")
time.sleep(0.5)
lines = 0
while lines < 300 and probe.child.stdout.readline() == b"x" * 999 + b"\n":
    lines += 1
tap.check(lines == 300, "a reader that comes late gets every byte", lines)
out, code = probe.end("q")
tap.check(code == 7, "the exit code comes through", code)

probe = Probe()
probe.send("c")
first = probe.field("clock")
time.sleep(1)
probe.send("c")
asleep = probe.field("clock") - first
tap.check(asleep < 250000, "time stands still while main sleeps", asleep)
probe.send("t")
time.sleep(0.2)
probe.send("n")
ticks = probe.field("ticks")
tap.check(ticks > 0, "the tick runs after a sleep", ticks)
probe.end("q")

before = os.times()
probe = Probe()
time.sleep(1)
probe.end("q")
after = os.times()
spent = after.children_user + after.children_system - before.children_user - before.children_system
tap.check(spent < 0.5, "a sleep of 1 s costs the machine little", spent)

if BOARD == "host":
    probe = Probe()
    out, code = probe.end("cn")
    tap.check(code == 0 and out.startswith("clock=") and out.endswith("ticks=0\r\n"), "the end of input ends it", (out, code))
else:
    for command, name, *wanted in FAULTS:
        out, code = Probe().end(command)
        line = re.search(r"\r\n! fault exception=(\w{8}) cfsr=(\w{8}) hfsr=(\w{8}) bfar=(\w{8}) pc=(\w{8})\r\n$", out)
        seen = [int(text, 16) for text in line.groups()] if line else [0] * 5
        tap.check(code == 99 and tuple(seen[:2]) in wanted and (seen[4] != 0) == (tuple(seen[:2]) != OVERFLOWN) and
           (command != "1" or seen[3] == NOWHERE), name + " ends with one line and exit code 99", (out, code))
tap.finish()
