#!/usr/bin/env python3
"""tools/python/squeal.py: each method on the host, a few on the board; lines that lose, double and garble; ports where
nobody answers; the example."""
import math
import os
import random
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import threading
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from bridge import Bridge, listener  # noqa: E402
from controller import PRESETS, SIGNALS, SOURCES, SYMBOLS, squeal  # noqa: E402
from firmware import Firmware, Tap  # noqa: E402

TREE = os.path.join(SOURCES, "..")
FOLDER = os.path.join(TREE, "tools", "python")
PRINTABLE = re.compile(r"[ -~]+")
BOARD = os.environ["BOARD"]
tap = Tap()
folder = tempfile.mkdtemp(prefix="squeal-python-")
link = os.path.join(folder, "link")


def refusal(error, function, *arguments, **named):
    """The error that the call raises, or a text that says that it raised none."""
    try:
        return f"returned {function(*arguments, **named)}"
    except error as raised:
        return raised


def is_refused(refused, text):
    return isinstance(refused, squeal.Refused) and str(refused) == text


# --- The client says what the document says -------------------------------------------------------------------------
with open(os.path.join(SOURCES, "protocol", "PROTOCOL.md"), encoding="utf-8") as page:
    page = page.read()
messages = {row[1]: (int(row[0], 16), int(row[2]), int(row[3]))
            for row in re.findall(r"^\| `(0x\w\w)` \| (\w+) \| (\d+) \| (\d+) \|", page, re.MULTILINE)}
known = {name: (row.code, struct.calcsize("<" + row.asks), struct.calcsize("<" + row.tells))
         for name, row in squeal.REQUESTS.items()}
tap.check(len(known) >= 22 and known.items() <= messages.items(), "types and lengths are those of the document",
          str(known.items() - messages.items()))
errors = re.findall(r"^\| `(\d+)` \| ([a-z-]+) \| ", page[page.index("## Errors"):], re.MULTILINE)
tap.check([str(number) for number in range(len(errors))] == [number for number, _ in errors] and
          tuple(name for _, name in errors)[:len(squeal.ERRORS)] == squeal.ERRORS, "so are the names of the errors")

# --- Each method ----------------------------------------------------------------------------------------------------
with Firmware("host", link=link) as firmware, squeal.connect(f"unix:{link}") as plant:
    tap.check(plant.hello.board == "host" and plant.hello.major == 1 and not plant.hello.is_emulated and
              plant.hello.payload == 240, "hello", str(plant.hello))
    tap.check(0.0 < plant.ping() < 5.0, "ping")
    force, steps_per_period = plant.parameters["N0"], plant.parameters["spp"]
    tap.check(list(plant.parameters) == SYMBOLS and force[:7] == ("N0", "N", "real", 1.0, 0.0, 1e9, "live") and
              "brake force" in force.help and steps_per_period.default == "64" and "1024" in steps_per_period.choices,
              "parameters", str(force), str(steps_per_period))
    tap.check(list(plant.signals) == SIGNALS and plant.signals["xd"].unit == "m/s" and plant.signals["hash"].type == "bits",
              "signals", str(plant.signals["xd"]))
    tap.check(list(plant.presets) == PRESETS and "2 kHz" in plant.presets["brake"].help, "presets")

    plant.preset("brake")
    before = plant.status()
    tap.check(plant.get("N1") == 3000.0 and before.step == 0 and before.state == "ready", "preset", str(before))
    done = plant.set(N1=2500, v0=0.1, spp=128)
    tap.check(done.was_reset and done.crc == plant.status().crc and
              [plant.get(name) for name in ("N1", "v0", "spp", "substeps")] == [2500.0, 0.1, "128", 1], "set and get", str(done))
    refused = refusal(squeal.Refused, plant.set, N1=2000, m=-1)
    tap.check(is_refused(refused, "STAGE refused: out-of-range: m, accepted 1e-06 .. 1000000 kg") and
              (refused.reason, refused.parameter, refused.low, refused.high) == ("out-of-range", "m", 1e-6, 1e6) and
              plant.get("N1") == 2500.0, "all or none", str(refused))
    tap.check(plant.set({"N1": 3000}).crc != done.crc and plant.status().crc == plant.set().crc, "nothing stays staged")
    for wanted, text in (({"N_1": 1}, "no parameter is called 'N_1': N1"), ({"arith": "f64"}, "one of f32, q27"),
                         ({"spp": 100}, "spp is not '100' but one of 16, 32"), ({"N1": "much"}, "N1 is not 'much' but a number")):
        refused = refusal(squeal.UnknownName, plant.set, wanted)
        tap.check(text in str(refused), f"set {wanted}", str(refused))
    tap.check("brake?" in str(refusal(squeal.UnknownName, plant.preset, "brakes")), "a preset that is not there")

    state = plant.step(640)
    tap.check(state.step == 640 and state.hash == plant.status().hash == int(firmware.ask("status")["hash"], 16) and
              (state.mode, state.propensity, state.class_, state.period) == ("slip+", "unknown", "unsettled", 0) and
              not (state.fault or state.clamped or state.cut) and
              all(plant.read(name) == getattr(state, name) for name in ("x", "xd", "y", "yd", "N", "F", "v0", "mode", "hash")),
              "step, read", str(state), str(firmware.ask("status")))
    state = plant.step(1, pressure=1e6, vehicle=0.31)
    tap.check(abs(state.N - 2290) < 1 and abs(state.v0 - 0.11) < 1e-6, "a pressure and a vehicle's speed", str(state))
    tap.check(abs(plant.step(1).v0 - 0.11) < 1e-6 and abs(plant.step(1, v0="profile").v0 - 0.1) < 1e-6, "held, and given back")
    tap.check(plant.step(1, N=1e9).clamped and plant.input(N=1e9) and not plant.input(at=700, N=1000), "a force held at its limit")
    tap.check(plant.step(56).N > 2e3 and abs(plant.step(1).N - 1000) < 1, "an input for a step to come")
    tap.check("not both" in str(refusal(ValueError, plant.step, 1, N=1, pressure=1)), "force or pressure")
    tap.check("STEP: " in str(refusal(ValueError, plant.step, -1)) and plant.step(1).step == 702, "steps are whole and forward")
    refused = refusal(squeal.Refused, plant.step, 0)
    tap.check(is_refused(refused, "STEP refused: out-of-range: n, accepted 1 .. 1000000"), "no step at all", str(refused))
    refused = refusal(squeal.Refused, plant.set, ke=2e8)
    tap.check(is_refused(refused, "COMMIT refused: needs-restart: ke") and plant.set(ke=2e8, may_reset=True).was_reset and
              plant.step(1).step == 1, "a restart must be asked for", str(refused))

    firmware.send("stop")
    threading.Timer(0.3, firmware.flush).start()
    state = plant.step(1000000)
    tap.check(state.cut and state.step < 1000001 and firmware.answer() == f"ok stop step={state.step}",
              "a stop on the console", str(state))
    plant.preset("fig7-ke5000")
    state = plant.step(100000)
    refused = refusal(squeal.Refused, plant.step, 1)
    tap.check(state.fault and state.step < 100000 and is_refused(refused, "STEP refused: in-fault"), "a fault", str(state), str(refused))
    tap.check(plant.reset() == 0 and plant.status().state == "ready" and plant.step(1).step == 1, "reset")

    # Samples.
    plant.preset("brake")
    with plant.stream(["xd", "x", "hash", "propensity", "x", "step"], every=16) as samples:
        state = plant.step(1600)
        seen = list(samples)
        tap.check([sample.step for sample in seen] == list(range(16, 1601, 16)) and samples.lost == 0 and
                  seen[-1] == (1600, state.xd, state.x, state.hash, state.propensity), "a stream in lockstep", str(seen[-1:]))
        plant.step(10)
        tap.check(not list(samples) and plant.step(6) and [sample.step for sample in samples] == [1616], "goes on")
    tap.check(plant.step(100) and not list(samples) and plant.status().samples_offered == 101, "until it ends")
    samples, count = plant.stream(["t"], every=8), 0
    began = plant.run()
    for sample in samples:
        count += 1
        if count == 1000:
            stopped = plant.stop()
    status = plant.status()
    unseen = status.samples_dropped - samples.lost
    tap.check(began < stopped == status.step and status.state == "ready" and count == status.samples_sent and
              count + samples.lost + unseen == (stopped - began) // 8 and stopped - 8 < sample.step + 8 * unseen <= stopped,
              "a stream in free run ends with it", f"{began} {stopped} {count} + {samples.lost} + {unseen}", str(sample))
    samples.end()
    plant.run()
    refused = refusal(squeal.Refused, plant.step, 1)
    tap.check(is_refused(refused, "STEP refused: is-running") and plant.reset() == 0 and plant.step(1).step == 1, "not both", str(refused))


# --- Verdict, self-test, studies ------------------------------------------------------------------------------------
with Firmware("host", link=link) as firmware, squeal.connect(f"unix:{link}") as plant:
    plant.preset("brake")
    verdict = plant.verdict()
    tap.check((verdict.propensity, verdict.class_, verdict.predicted) == ("unknown", "unsettled", "squeal") and
              math.isnan(verdict.frequency_hz), "no verdict yet", str(verdict))
    plant.step(38400)
    verdict, said = plant.verdict(), firmware.ask("verdict")
    tap.check((verdict.propensity, verdict.band, verdict.audible, verdict.bistable) == ("squeal", "squeal", True, False) and
              f"{verdict.class_}-p{verdict.period}" == said["class"] and
              all(abs(getattr(verdict, name) / float(said[name]) - 1) < 1e-7 for name in
                  ("amplitude_um", "frequency_hz", "velocity_mm_s_rms", "level_db", "stick", "predicted_growth_per_s", "sigma")),
              "the verdict is the console's", str(verdict), str(said))
    tap.check(plant.selftest() == (9, ()), "the firmware's own tests pass")

    study = plant.scan(squeal.Axis("N1", 1000, 30000, 3, log=True), squeal.Axis("arith", "f32", "q27", 2), transient=100)
    points, state = [], None
    for point in study:
        points.append(point)
        state = plant.step(1)
    tap.check([point.values for point in points] == [(force, arith) for arith in ("f32", "q27") for force in (1000.0, 5477.225, 30000.0)] and
              [(point.error, point.propensity, point.loud) for point in points] ==
              [("ok", "quiet", False), ("ok", "squeal", True), ("out-of-scale", "unknown", False)] * 2 and
              (points[0].end, points[1].class_, state.step) == ("decayed", "limitcycle-stickslip", 38406),
              "a map, and steps between its points", *map(str, points))
    tap.check(study.promised == 6 and study.tally[:4] == ("ok", 6, 6, 0) and (study.tally.loud, study.tally.refused) == (2, 2),
              "its tally", str(study.tally))
    border, = plant.margin("N1", within=2)
    tap.check((border.name, border.value, border.now, border.quiets) == ("N1", 3000.0, "squeal", "down") and
              1998 < border.below_quiet <= border.below <= border.below_squeal < 2001 and math.isnan(border.above) and
              border.above_searched == 6000, "a border", str(border))
    tally = plant.occurrence(20, seed=1, N=0.2)
    tap.check(tally.trials == 20 and tally.share == struct.unpack("f", struct.pack("f", tally.loud / 20))[0] and
              0 < tally.low < tally.share < tally.high < 1, "an occurrence", str(tally))
    for refused, text in ((refusal(squeal.Refused, plant.margin, "t2"), "MARGIN refused: not-served: name"),
                          (refusal(squeal.Refused, plant.scan, squeal.Axis("N1", 1, 2, 0)),
                           "SCAN refused: out-of-range: points, accepted 1 .. 256")):
        tap.check(is_refused(refused, text), text, str(refused))
    tap.check("one axis or two" in str(refusal(ValueError, plant.scan)), "a map of nothing")
    plant.run()
    study = plant.scan(squeal.Axis("N1", 1000, 3000, 256), whole=True)
    first = next(study)
    refused = refusal(squeal.Refused, plant.margin)
    study.stop()
    rest = list(study)
    tap.check(first.values == (1000.0,) and is_refused(refused, "MARGIN refused: busy") and study.tally.reason == "stopped" and
              study.tally.results == 1 + len(rest) < 256 and plant.status().state == "run",
              "one study at a time; its stop is not the plant's", str(study.tally), str(refused))
    study = plant.scan(squeal.Axis("N1", 1000, 3000, 256), whole=True)
    tap.check(plant.stop() == plant.status().step and plant.status().state == "ready" and list(study) == list(study) and
              study.tally.reason == "stopped", "the plant's stop is the study's as well")


# --- A run to go on with, a controller that falls silent ------------------------------------------------------------
with Firmware("host", link=link), squeal.connect(f"unix:{link}") as plant, squeal.connect("host") as other:
    plant.preset("brake")
    plant.step(5000, N=2500)
    run, truth = plant.snapshot(), [plant.step(100), plant.step(200, N=1000)]
    again = plant.restore(run), [plant.step(100), plant.step(200, N=1000)]
    tap.check(again == (5000, truth) == (other.restore(run), [other.step(100), other.step(200, N=1000)]),
              f"{len(run)} bytes are a run, here and elsewhere", str(truth), str(again))
    tap.check(plant.restore(run) == 5000 and plant.snapshot() == run, "the same bytes again")
    refused = refusal(squeal.Refused, plant.restore, run[:500] + b"?" + run[501:])
    tap.check(refused.reason == "wrong-crc" and plant.step(100) == truth[0], "a broken one is refused", str(refused))
    refused = refusal(squeal.Refused, plant.restore, run[:-1])
    tap.check(is_refused(refused, f"RESTORE refused: wrong-layout: size, expected {len(run)}"), "so is a short one", str(refused))
    plant.run()
    refused = refusal(squeal.Refused, plant.snapshot)
    tap.check(is_refused(refused, "SNAPSHOT refused: is-running") and plant.stop() > 5100, "only of a plant that stands", str(refused))

    plant.preset("brake")
    plant.set(stale=1e-3, safe=2e-3, ramp=1e-3)
    step_s = plant.status().step_s
    seen = [plant.step(1, N=2000)] + [plant.step(round(1e-3 / step_s)) for _ in range(4)]
    tap.check([(state.stale, state.safe) for state in seen] == [(False, False), (True, False)] + 3 * [(False, True)] and
              abs(seen[2].N - 2000) < 20 and seen[3].N == 0 and plant.status().input_state == plant.read("input_state") == "safe" and
              plant.status().times_safe == 1, "a controller that falls silent", *map(str, seen))
    refused = refusal(squeal.Refused, plant.step, 1, N=2000)
    state = plant.step(1, start=True)
    tap.check(is_refused(refused, "STEP refused: safe-state") and not state.safe and plant.step(1, N=2000).N > 1900 and
              plant.status().input_state == "fresh", "only a start leads back", str(refused), str(state))


# --- A line that loses, doubles, delays and garbles -----------------------------------------------------------------
def drive(plant, turns=200):
    """The same in every run: (step, hash) after each turn."""
    dice = random.Random(1)
    plant.preset("brake")
    return [plant.step(dice.randint(1, 50), N=dice.uniform(0, 3000))[:2] for _ in range(turns)]


class Trouble:
    """What happens to the pieces of a way: each of these to one in five, drawn anew each time."""

    def __init__(self, seed, *kinds):
        self.dice, self.kinds, self.count = random.Random(seed), kinds, 0

    def __call__(self, piece):
        if len(piece) < 2 or self.dice.random() > 0.2:
            return piece
        self.count += 1
        return getattr(self, self.dice.choice(self.kinds))(piece)

    def lose(self, piece):
        return b""

    def double(self, piece):
        return piece + piece

    def garble(self, piece):
        at = self.dice.randrange(len(piece))
        return piece[:at] + bytes([piece[at] ^ 1 << self.dice.randrange(8)]) + piece[at + 1:]

    def noise(self, piece):
        return bytes(self.dice.randrange(256) for _ in range(self.dice.randrange(600))) + b"\0" + piece


with Firmware("host", link=link), squeal.connect(f"unix:{link}") as plant:
    truth = drive(plant)
for way, *kinds in (("to_client", "lose"), ("to_plant", "lose"), ("to_client", "double", "garble", "noise"),
                    ("to_plant", "double", "garble", "noise")):
    with Firmware("host", link=link), Bridge(link, folder) as bridge, squeal.connect(bridge.port, timeout_s=0.05) as plant:
        trouble = Trouble(2, *kinds)
        setattr(bridge, way, trouble)
        seen = drive(plant)
        setattr(bridge, way, lambda piece: piece)
        status = plant.status()
        tap.check(seen == truth and trouble.count > 20 and status.step == truth[-1][0] and status.inputs_taken == len(truth),
                  f"a line that can {', '.join(kinds)}, {way.replace('_', ' ')}: the same bits, no step twice",
                  f"{trouble.count} times", str(status))

with Firmware("host", link=link), Bridge(link, folder) as bridge, squeal.connect(bridge.port, timeout_s=0.2) as plant:
    plant.step(1)
    late = []
    bridge.to_client = lambda piece: (late or (late.append(1), time.sleep(0.5))) and piece
    refused = refusal(squeal.Refused, plant.step, 0)
    tap.check(refused.was_repeated and refused.reason == "out-of-range" and [plant.step(1).step, plant.step(1).step] == [2, 3],
              "the second refusal of a STEP that was sent twice is not taken for the next one's")

    bridge.to_client = lambda piece: b""
    plant._link.patience_s = 0.5
    silence = refusal(squeal.NoAnswer, plant.step, 5)
    bridge.to_client = lambda piece: piece
    plant._link.patience_s = 10.0
    tap.check("STEP was sent 2 times and no reply came" in str(silence) and plant.status().step == 8 and
              plant.step(1).step == 9, "after silence the plant is where it is, and goes on", str(silence))

with Firmware("host", link=link), Bridge(link, folder) as bridge, squeal.connect(bridge.port, timeout_s=0.1) as plant:
    plant.preset("brake")
    lost = [] if plant.parameters else None
    bridge.to_client = lambda piece: piece if lost else lost.append(piece) or b""
    study = plant.scan(squeal.Axis("N1", 1000, 3000, 5))
    tap.check([point.values[0] for point in study] == [1000, 1500, 2000, 2500, 3000] and lost,
              "the answer to a study's beginning is lost, but not the study", str(study.tally))
    bridge.to_client = Trouble(3, "lose")
    runs = [(plant.restore(plant.snapshot()), plant.step(10).step)[1] for _ in range(3)]
    tap.check(runs == [10, 20, 30] and bridge.to_client.count > 10, "pieces of a run are lost, but not the run", str(runs))

for kind in ("tcp", "pty"):
    with Firmware("host", link=link), Bridge(link, folder, kind) as bridge, squeal.connect(bridge.port) as plant:
        tap.check(drive(plant) == truth, f"{kind}: the same bits")
        if kind == "pty":
            error = refusal(squeal.NoAnswer, squeal.connect, bridge.port[4:])
            tap.check("busy; another program has it" in str(error), "a serial line is for one", str(error))

with Firmware("host", link=link), Bridge(link, folder) as bridge, squeal.connect(bridge.port) as plant:
    def swallow(piece):
        """No sample of the steps 11 to 20, and none of 1001 to 80000."""
        frame = squeal.decode(piece[:-1])
        return b"" if frame.kind == 0x40 and (10 < frame.step <= 20 or 1000 < frame.step <= 80000) else piece

    bridge.to_client = swallow
    samples = plant.stream(["x"])
    plant.step(90000)
    seen = [(sample.step, samples.lost) for sample in samples]
    tap.check(seen == [(step, 0) for step in range(1, 11)] + [(step, 10) for step in range(21, 1001)] +
              [(step, 79010) for step in range(80001, 90001)], "samples that are lost are counted, beyond 65536 as well",
              str(seen[:12]), str(seen[-1:]))

# --- Where nobody answers -------------------------------------------------------------------------------------------
empty = os.path.join(folder, "empty")
os.mkdir(empty)
for port, words, named in (
        (f"unix:{folder}/none", "No such file or directory; is the firmware running", {}),
        ("tcp:127.0.0.1:1", "Connection refused; is the firmware", {}),
        ("tcp:127.0.0.1", "no port number; write tcp:HOST:PORT", {}),
        ("/dev/squeal-is-not-here", "No such file or directory; is it plugged in? ls /dev/ttyUSB*", {}),
        ("/dev/null", "Inappropriate ioctl for device; name a serial line", {}),
        ("serial", "no port has such a name; give host, qemu:BOARD", {}),
        ("\x1b[2J", r"no answer at \x1b[2J: no port has such a name", {}),
        ("qemu:abacus", "there is no board 'abacus'; the boards are: host", {}),
        ("host", f"no source tree at {empty}; give build= or SQUEAL_BUILD", {"build": empty})):
    error = refusal(squeal.NoAnswer, squeal.connect, port, **named)
    tap.check(words in str(error) and PRINTABLE.fullmatch(str(error)) and len(str(error)) < 250,
              f"{port.encode('unicode_escape').decode()}: {words}", str(error))

for said, words in ((b"", "not a byte came back; is another program connected there?"),
                    (b"ok id name=squeal\r\n", "text came back; this is the console: the link is the other UART"),
                    (b"\x80\xfe\x13\0\x91", "bytes that are no frames came back; is it the link's UART")):
    with listener(folder, lambda piece: said) as port:
        error = refusal(squeal.NoAnswer, squeal.connect, port, timeout_s=0.1, patience_s=0.5)
        tap.check(words in str(error) and PRINTABLE.fullmatch(str(error)), words, str(error))
with Firmware("host", link=link) as firmware, squeal.connect(f"unix:{link}") as plant:
    firmware.process.kill()
    error = refusal(squeal.NoAnswer, plant.step, 1)
    tap.check("connect anew" in str(error) and PRINTABLE.fullmatch(str(error)), "a firmware that ends", str(error))


# --- A device that is another ---------------------------------------------------------------------------------------
def device(*payloads):
    """Answers requests with these payloads in turn: bytes for a reply, a number for ERROR with this reason. Frames are sent
    as they are, before the payload that follows them."""
    answers = list(payloads)

    def speak(piece):
        asked, told = squeal.decode(piece), answers.pop(0)
        if isinstance(told, squeal.Frame):
            return squeal.encode(told) + speak(piece)
        if isinstance(told, bytes):
            return squeal.encode(asked._replace(kind=asked.kind + 0x80, payload=told))
        return squeal.encode(asked._replace(kind=0xff, payload=struct.pack("<BBBIff", asked.kind, told, 255, 2, 0, 0)))
    return speak


greeting = struct.pack("<BBHHHBBBBH16s32s24s16s", 1, 7, 9, 9, 9, 1, 1, 1, 255, 240, b"\x1b[2J\x07\xe4", b"b" * 32, b"", b"c")
row = struct.pack("<BBBHBBfff24s48s149s", 0, 0, 1, 0, 200, 77, 1, 0, 2, b"\x9b31m", b"a|b\n", b"help")
with listener(folder, device(greeting, row, 250)) as port, squeal.connect(port) as plant:
    tap.check(plant.hello.version == r"\x1b[2J\x07\xe4" and plant.hello.minor == 7 and list(plant.parameters) == [r"\x9b31m"] and
              plant.parameters[r"\x9b31m"][1:3] == (r"a|b\x0a", "#200"), "text from the wire cannot reach a terminal as it is",
              str(plant.hello), str(plant.parameters))
    refused = refusal(squeal.Refused, plant.stop)
    tap.check(is_refused(refused, "STOP refused: #250"), "an error of which nobody has heard has a number", str(refused))
with listener(folder, device(23)) as port:
    refused = refusal(squeal.Refused, squeal.connect, port)
    tap.check(is_refused(refused, "HELLO refused: wrong-version, expected 2"), "another major version", str(refused))
with listener(folder, device(greeting, b"short")) as port, squeal.connect(port) as plant:
    error = refusal(squeal.Error, plant.status)
    tap.check("the reply to STATUS has 5 bytes instead of 134" in str(error), "a reply of another length", str(error))

status = struct.pack("<BQIIIff24IBII", 1, 2**33 + 5, *[0] * 32)
row = struct.pack("<BBBHBBfff24s48s149s", 1, 0, 1, 0, 0, 2, 0, 0, 0, b"x", b"m", b"")
samples = [squeal.Frame(0x40, number, step, b"\0\0\xc0\x3f") for number, step in enumerate((7, 2**32 - 1, 0, 1))]
stood, begun = struct.pack("<Q", 2**33 + 5), struct.pack("<IBI", 0, 1, 0)
with listener(folder, device(greeting, row, status, b"\0" * 10, *samples[:2], stood, b"\0" * 4, samples[3], begun)) as port:
    with squeal.connect(port) as plant:
        stream = plant.stream(["x"])
        plant.stop()
        seen = [sample.step for sample in stream]
        plant.set()
        tap.check([*seen, *(sample.step for sample in stream)] == [2**33 + 7, 2**33 - 1, 1] and stream.lost == 1,
                  "a step counter of more than 32 bits", str(seen), str(stream.lost))

# --- What is started is ended ---------------------------------------------------------------------------------------
CHILDREN = f"/proc/self/task/{os.getpid()}/children"
for port in ["host"] if BOARD == "host" else ["host", f"qemu:{BOARD}"]:
    with squeal.connect(port) as plant:
        plant.preset("brake")
        plant.set(arith="f32", tick=20000)
        tap.check(drive(plant, 20) != [] and plant.hello.board == port.split(":")[-1], f"{port}: started", str(plant.hello))
        with open(CHILDREN, encoding="ascii") as children:
            tap.check(len(children.read().split()) == 1, f"{port}: one process")
    with open(CHILDREN, encoding="ascii") as children:
        tap.check(children.read() == "" and "closed" in str(refusal(squeal.Error, plant.stop)), f"{port}: and ended")
script = """\
import os, squeal
plant = squeal.connect("host")
print(open(f"/proc/self/task/{os.getpid()}/children").read())
"""
left = subprocess.run([sys.executable, "-c", script], env={**os.environ, "PYTHONPATH": FOLDER}, capture_output=True,
                      text=True, check=False, timeout=60)
tap.check(left.returncode == 0 and left.stdout.strip().isdigit() and not os.path.exists(f"/proc/{left.stdout.strip()}"),
          "so is one that nobody has closed", left.stdout + left.stderr)


# --- The example ----------------------------------------------------------------------------------------------------
def example(text, **named):
    """Runs a copy of the example with this text; (exit code, its last line)."""
    with open(os.path.join(folder, "example_test.py"), "w", encoding="utf-8") as copy:
        copy.write(text)
    environment = {**os.environ, "PYTHONPATH": FOLDER, "PYTHONDONTWRITEBYTECODE": "1", **named}
    run = subprocess.run([sys.executable, copy.name], env=environment, capture_output=True, text=True, check=False, timeout=300)
    return run.returncode, run.stderr.strip().splitlines()[-1]


with open(os.path.join(FOLDER, "example_test.py"), encoding="utf-8") as file:
    text = file.read()
tap.check(example(text) == (0, "OK"), "the example passes", str(example(text)))
bad = text.replace("0.9 * force_n if", "1.0 * force_n if")
tap.check(bad != text and example(bad) == (1, "FAILED (failures=1)"), "and fails with a controller that does not react",
          str(example(bad)))

shutil.rmtree(folder)
tap.finish()
