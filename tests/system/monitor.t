#!/usr/bin/env python3
"""The monitor in a terminal, on the host and on the board: what it shows, what its keys do, and how it ends."""
import os
import re
import signal
import subprocess
import sys
import tempfile
import time

os.environ["SQUEAL_REALTIME"] = "1"  # the host in its own time
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from firmware import Firmware, Tap  # noqa: E402
from terminal import Terminal  # noqa: E402

TOOL = os.environ.get("TOOL", "build/tools/squeal")
PICTURES = os.environ["PICTURES"]
BOARD = os.environ["BOARD"]
tap = Tap()
folder = tempfile.TemporaryDirectory(prefix="squeal-monitor-")
os.chdir(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))


def word(name):
    """The rows of a word in large letters."""
    drawn = subprocess.run([PICTURES, "word", name], stdout=subprocess.PIPE, check=True).stdout.decode()
    return [row.rstrip() for row in drawn.splitlines()]


def shows(name):
    """Does a screen show this word in large letters at its upper left?"""
    rows = word(name)

    def holds(text):
        lines = text.split("\n")
        return any(all(line[1:1 + len(row)] == row for line, row in zip(lines[top:], rows))
                   for top in (1, 2)) and len(lines) > len(rows)
    return holds


def number(text, pattern):
    found = re.search(pattern, text or "")
    return float(found.group(1)) if found else float("nan")


def monitor(*arguments, rows=24, cols=80, **variables):
    return Terminal([TOOL, "monitor", *arguments], rows, cols, **variables)


def live(where, path):
    """A firmware with its console in our hands and the monitor on its link."""
    console = Firmware(where, limit_s=60, link=path)
    return console, monitor("--port", f"unix:{path}", "--preset", "brake")


def seen_and_steered(where):
    console, screen = live(where, os.path.join(folder.name, where))
    with console, screen:
        text = screen.until(shows("SQUEAL"), 90)
        tap.check(text is not None, f"{where}: preset brake squeals in large letters", *screen.lines())
        text = screen.until(lambda text: 1950 < number(text, r"frequency +(\d+) Hz") < 2050 and
                            7.5 < number(text, r"amplitude +([\d.]+) µm") < 8.8 and
                            156 < number(text, r"level +([\d.]+) dB") < 158.5)
        tap.check(text is not None, f"{where}: frequency, amplitude and level are those of the brake", *screen.lines())
        tap.check("running" in screen.lines()[0] and "brake" in screen.lines()[0], "the state and the set")
        frames = screen.frames
        screen.pump(2.0)
        tap.note(f"{(screen.frames - frames) / 2:.1f} frames a second")
        tap.check(8 <= screen.frames - frames <= 40, "some 15 frames a second, however many samples")

        screen.send("nnn")
        tap.check(screen.until(lambda text: "N 2700 N" in text, 20) is not None, "n: less force, shown", *screen.lines())
        tap.check(console.ask("get N1")["N1"] == "2700", "and in the device's set")
        screen.send(b"\x1b[A\x1b[A")
        tap.check(screen.until(lambda text: "N 2900 N" in text, 20) is not None, "arrow up: more", *screen.lines())
        screen.send("VA")
        tap.check(screen.until(lambda text: "v0 0.105 m/s" in text and "alpha -0.058 s/m" in text, 20) is not None,
                  "V and A: disc speed and slope", *screen.lines())
        seen = (float(console.ask("get v0")["v0"]), float(console.ask("get alpha")["alpha"]))
        tap.check(abs(seen[0] - 0.105) < 1e-6 and abs(seen[1] + 0.058) < 1e-6, "in the device's set")
        screen.send("N" * 200)
        tap.check(screen.until(lambda text: re.search(r"N1 = 22900 N is refused: 0 \.\. 1\d{4} would do", text), 20) is not None,
                  "a refusal tells what would be accepted", *screen.lines())
        tap.check(console.ask("get N1")["N1"] == "2900", "and changes nothing")
        tap.check(isinstance(console.ask("set N1 1500"), dict) and
                  screen.until(lambda text: "N 1500 N" in text, 20) is not None, "what the console changes is shown")

        screen.send(" ")
        tap.check(screen.until(lambda text: "stopped" in text.split("\n")[0], 20) is not None, "space: stopped")
        tap.check(console.ask("status")["state"] == "ready", "so says the device")
        screen.until(lambda text: False, 8.0)  # messages go
        received = screen.received
        screen.pump(2.0)
        tap.check(screen.received == received, "a plant at rest costs no byte", f"{screen.received - received} bytes")
        screen.send("r")
        tap.check(screen.until(lambda text: re.search(r" step 0 ", text), 20) is not None, "r: back to step 0", *screen.lines())
        screen.send(" ")
        tap.check(screen.until(lambda text: "running" in text.split("\n")[0], 20) is not None, "space: running")

        for rows, cols in ((40, 120), (20, 72), (50, 160), (24, 80)):
            screen.resize(rows, cols)
            text = screen.until(lambda text: "space" in text.split("\n")[-1] and "running" in text.split("\n")[0] and
                                "spectrum" in text, 20)
            tap.check(text is not None, f"{cols} x {rows}: all of it", *screen.lines())
        screen.resize(10, 40)
        tap.check(screen.until(lambda text: "40 x 10, I need 72 x 20" in text, 20) is not None, "too small: it says so")
        screen.resize(24, 80)
        screen.send("h")
        tap.check(screen.until(lambda text: "keys ──" in text, 20) is not None, "h: help")
        screen.send("xp")
        tap.check(screen.until(lambda text: "presets: up" in text and "> brake" in text, 20) is not None, "p: presets", *screen.lines())
        screen.send(b"\x1b[A\r")
        tap.check(screen.until(shows("QUIET"), 90) is not None, "up, Enter: Table 1 is quiet, and says so", *screen.lines())
        tap.check("table1" in screen.lines()[0], "its name is shown")
        screen.send("-")
        tap.check(screen.until(lambda text: "4000 steps/s" in text, 20) is not None and
                  console.ask("get substeps")["substeps"] == "4", "-: half the pace")
        screen.send("2")
        tap.check(screen.until(lambda text: "brake" in text.split("\n")[0], 20) is not None, "2: the second preset")
        tap.check(not screen.unknown, "no sequence that our terminal does not know", *screen.unknown)
        screen.send("q")
        tap.check(screen.end() == 0 and screen.is_as_it_was(), "q: the terminal is as it was", f"exit {screen.code}", *screen.last_words())
        tap.check(console.ask("status")["state"] == "run", "and the plant goes on")


def endings():
    path = os.path.join(folder.name, "lost")
    console, screen = live("host", path)
    with console, screen:
        screen.until(lambda text: "running" in text, 30)
        os.killpg(console.process.pid, signal.SIGKILL)
        code = screen.end(20)
        after = screen.last_words()
        tap.check(code == 3 and screen.is_as_it_was(), "a device that is lost: the terminal is as it was", f"exit {code}")
        tap.check(len(after) == 1 and path in after[0], "one line names the port", *after)

    for number_, name in ((signal.SIGTERM, "SIGTERM"), (signal.SIGHUP, "SIGHUP"), (signal.SIGINT, "SIGINT")):
        with monitor("--port", "host") as screen:
            screen.until(lambda text: "running" in text, 30)
            os.kill(screen.pid, number_)
            tap.check(screen.end() == -number_ and screen.is_as_it_was(), f"{name}: the terminal is as it was, and it ends so",
                      f"exit {screen.code}")
    with monitor("--port", "host") as screen:
        screen.until(lambda text: "running" in text, 30)
        screen.send(b"\x03")
        tap.check(screen.end() == 0 and screen.is_as_it_was(), "Ctrl-C quits", f"exit {screen.code}")
    with monitor("--port", "host", "--seconds", "2") as screen:
        tap.check(screen.end(20) == 0 and screen.is_as_it_was(), "--seconds: it ends by itself")
    with monitor("--port", "host", "--preset", "none-such") as screen:
        tap.check(screen.end() == 4 and b"none-such" in screen.raw, "a preset that is none", screen.raw.decode())


def looks():
    with monitor("--port", "host", NO_COLOR="1") as screen:
        screen.until(shows("SQUEAL"), 60)
        tap.check(not any(re.search(r"(^|;)[39]", look) for look in screen.looks), "NO_COLOR: none", *screen.looks)
    with monitor("--port", "host", TERM="xterm") as screen:
        screen.until(shows("SQUEAL"), 60)
        tap.check("0;31" in screen.looks and not any("38" in look for look in screen.looks), "16 colours where there are no more")
    with monitor("--port", "host", "--ascii") as screen:
        text = screen.until(lambda text: "#######" in text and "um" in text, 60)
        tap.check(text is not None and text.isascii(), "--ascii: ASCII")
    with monitor("--port", "host", "--seconds", "3.5", TERM="dumb") as screen:
        screen.end(20)
        tap.check(b"\x1b" not in screen.raw and screen.raw.count(b"\n") == 3, "a dumb terminal gets a line a second",
                  screen.raw.decode())


def lines():
    began = time.monotonic()
    run = subprocess.run([TOOL, "monitor", "--port", "host", "--seconds", "6.5"], stdout=subprocess.PIPE,
                         stderr=subprocess.PIPE, stdin=subprocess.DEVNULL, timeout=60)
    shown = run.stdout.decode().splitlines()
    tap.check(run.returncode == 0 and len(shown) == 6 and 6 < time.monotonic() - began < 20, "without a terminal: a line a second",
              *shown, run.stderr.decode())
    tap.check(all(line.startswith("t ") for line in shown) and run.stdout.isascii(), "plain ones", *shown)
    tap.check(" squeal " in shown[-1] and re.search(r" (199\d|200\d) Hz ", shown[-1]) is not None, "the last one squeals", *shown)
    process = subprocess.Popen([TOOL, "monitor", "--port", f"qemu:{BOARD}" if BOARD != "host" else "host", "--lines"],
                               stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    first = process.stdout.readline()
    process.stdout.close()
    process.wait(30)
    tap.check(first.startswith(b"t ") and process.returncode in (0, 1), "it ends when nobody reads",
              f"exit {process.returncode}")
    process.stderr.close()


with folder:
    for board in os.environ.get("WHERE", f"host {BOARD}").split():
        seen_and_steered(board)
    endings()
    looks()
    lines()
tap.finish()
