"""The firmware at the rate that the table promises it, and at half as much again, through its console."""
import math
import re
import select
import subprocess
import time

SECONDS = 10    # of the emulated clock
TICK_HZ_MAX = 100000
SQUEAL = "preset brake", "set spp 64 rough 0 runout 0"
LINE_S = 20.0   # no line of the console takes longer
SHARE = 15 / 16  # of a period; a longer tick counts as overrun


def shift_of(clock_hz):
    """The first shift of -icount with which an instruction is no shorter than a clock."""
    shift = 0
    while 2**shift < 1e9 / clock_hz:
        shift += 1
    return shift


class Console:
    def __init__(self, command):
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
        self.heard = b""

    def __enter__(self):
        # What comes before the UART is open is lost: the banner tells that it is.
        if not select.select([self.process.stdout], [], [], LINE_S)[0]:
            raise TimeoutError("no banner")
        return self

    def __exit__(self, *unused):
        self.process.kill()
        self.process.wait()

    def ask(self, line):
        """The answer to a line."""
        self.process.stdin.write(line.encode() + b"\r")
        self.process.stdin.flush()
        end = time.monotonic() + LINE_S
        while time.monotonic() < end:
            *lines, self.heard = self.heard.split(b"\n")
            for said in lines:
                text = said.decode(errors="replace").strip()
                if re.match(r"(ok|error) ", text):
                    return text
            if select.select([self.process.stdout], [], [], 1.0)[0]:
                chunk = self.process.stdout.read1(65536)
                if not chunk:
                    break
                self.heard += chunk
        raise TimeoutError(f"no answer to {line}")

    def number(self, line, name):
        return int(re.search(rf"\b{name}=(\d+)", self.ask(line)).group(1))


def run(board, rate_hz, wanted, substeps=1):
    """Squeals at a rate. Returns ticks, overruns, ticks shed, and whether the brake was heard to squeal."""
    command = [re.sub(r"shift=\d+", f"shift={shift_of(board.clock_hz)}", word) for word in board.command]
    with Console(command) as console:
        console.ask("echo off")
        for line in SQUEAL + (f"set tick {rate_hz} substeps {substeps}", "run"):
            answer = console.ask(line)
            if not answer.startswith("ok"):
                raise ValueError(f"{line}: {answer}")
        counts = {}
        while counts.get("ticks", 0) + counts.get("shed", 0) < wanted:
            status = console.ask("status")
            counts = {name: int(re.search(rf"\b{name}=(\d+)", status).group(1)) for name in ("ticks", "overruns", "shed")}
        squeals = "propensity=squeal" in console.ask("verdict")
        console.ask("stop")
        return counts["ticks"], counts["overruns"], counts["shed"], squeals


def prove(board, worst, mean):
    """True if the rate that holds three events a step is kept for ten seconds of squeal, and if a rate that cannot be kept is
    told of while main still answers."""
    speed_hz = 1e9 / 2**shift_of(board.clock_hz)
    rate_hz = int(SHARE * speed_hz / worst)
    ticks, overruns, shed, squeals = run(board, rate_hz, SECONDS * rate_hz)
    is_kept = overruns == 0 and shed == 0 and squeals
    print(f"{'ok' if is_kept else 'not ok'} {board.name}: {ticks / rate_hz:.1f} s of squeal at {rate_hz} Hz, "
          f"{speed_hz / 1e6:.3g} million instructions a second: {overruns} overruns")
    is_told = True
    for text, too_much in (("1.5 times that", rate_hz * 1.5), ("1.5 times what the mean allows", SHARE * 1.5 * speed_hz / mean)):
        substeps = math.ceil(too_much / TICK_HZ_MAX)  # a faster timer there is not
        tick_hz = int(too_much / substeps)
        ticks, overruns, shed, unused = run(board, tick_hz, 2 * tick_hz, substeps)
        is_told = is_told and (overruns > 0) == (shed > 0) and (text.startswith("1.5 times that") or overruns > 0)
        print(f"{'ok' if is_told else 'not ok'} {board.name}: {text}, {tick_hz} Hz, {substeps} steps a tick: {ticks} ticks, {overruns} overruns, "
              f"{shed} ticks shed, main answers")
    return is_kept and is_told
