#!/usr/bin/env python3
"""The console on the board, as a person and a script meet it: every parameter's round trip, refusals that change nothing,
garbage, a paste of 10,000 lines, a fault and the way out of it."""
import os
import random
import subprocess
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from firmware import Firmware, Tap, fields  # noqa: E402

tap = Tap()


def all_values(firmware):
    """symbol -> text of the value, from the list."""
    firmware.ask("list")
    return {line.split()[0]: line.split()[2] for line in firmware.body}


with Firmware() as firmware:
    before = all_values(firmware)
    tap.check(len(before) > 30 and "v0" in before, "list names the parameters", *before)

    wrong = []
    for symbol, value in before.items():
        answer = firmware.ask(f"set {symbol} {value}")
        if isinstance(answer, str) or answer.get(symbol) != value or firmware.ask(f"get {symbol}").get(symbol) != value:
            wrong.append(f"{symbol} {value}: {answer}")
    tap.check(not wrong, f"each of {len(before)} values is read back as it was printed", *wrong)

    firmware.ask("set v0 0.30000001192092896 N0 1e-40 alpha 0 N_max 16777217")
    got = [firmware.ask(f"get {symbol}")[symbol] for symbol in ("v0", "N0", "N_max")]
    tap.check([float(got[0]) == 0.3, 0 < float(got[1]) < 1.0001e-40, got[2] == "16777216"] == [True] * 3,
              "numbers are rounded to single precision once, also subnormal ones", *got)
    firmware.ask("defaults")

    firmware.ask("step 1000")
    state = firmware.ask("status")["hash"]
    for line, error, words in [
        ("set v0 nan", "bad-number", "-1000 .. 1000 m/s"), ("set m 1e-50", "out-of-range", "m=1e-50"),
        ("set m 0", "out-of-range", "1e-06"), ("set m -1", "out-of-range", "1000000"),
        ("set ke 1 k 1000", "out-of-scale", "k"), ("set spp 16 kt 3 k 3", "step-too-large", "0.4"),
        ("set spp 63", "out-of-range", "16"), ("set nonsense 1", "unknown-name", "nonsense"),
        ("set v0", "usage", ""), ("set v0 1 N0", "usage", ""), ("fly", "unknown-command", "fly"), ("step 0", "", ""),
        ("step 2000000000", "", ""), ("measure x", "", ""), ("preset fig99", "unknown-name", "fig99"),
        ("set method naive normal exact", "not-served", ""), ("set N0 0 v0 0 c 0.02 m 0.4", "no-scale", ""), ("stream csv nothing", "unknown-name", ""),
        ("set v0 1 v0", "usage", ""), ("set v0 1 v0 2", "usage", "v0"), ("set tick 0.5", "out-of-range", "1 .. 100000"),
        ("set tick 1000.5", "out-of-range", "whole"), ("stream csv every 0", "out-of-range", "1 .. 1000000000"),
        ("demo 9", "out-of-range", "1 .. 5"), ("set load ramp t1 5 t2 4", "out-of-range", "5"),
    ]:
        answer = firmware.ask(line)
        tap.check(isinstance(answer, str) and answer.startswith(f"error {error}") and words in answer,
                  f"refused by name: {line}", str(answer))
    tap.check(all_values(firmware) == before and firmware.ask("status")["hash"] == state,
              "no refusal has changed a parameter or the state")

    firmware.ask("run")
    answer = firmware.ask("set m 1")
    tap.check(isinstance(answer, str) and answer.startswith("error needs-restart"), "a restart parameter waits for a stop", str(answer))
    tap.check(isinstance(firmware.ask("set N0 2"), dict), "a live one does not")
    firmware.ask("stop")

    firmware.ask("defaults")
    firmware.send(bytes(random.Random(1).randrange(128, 256) for _ in range(3000)) + b"\r")
    garbage = firmware.answer()
    status = firmware.ask("status")
    tap.check(garbage.startswith("error") and int(status["garbage"]) >= 3000, "garbage is answered once and counted", garbage)
    firmware.send("get " + "v" * 300)
    tap.check(firmware.answer().startswith("error line-too-long"), "so is a line without end")
    tap.check(firmware.ask("get v0") == {"v0": "1", "unit": "m/s"}, "the next good line works")

with Firmware(limit_s=120) as firmware:
    firmware.ask("set substeps 16 tick 500 cn 0.2")  # undamped, so many changes of the load could throw the pad out
    firmware.ask("run")
    for number in range(10000):
        firmware.send(f"set N0 {1 + number % 4}" if number % 10 == 0 else "get N0")
    answers = [firmware.answer() for _ in range(10000)]
    expected = [str(1 + (number - number % 10) % 4) for number in range(10000)]
    tap.check([fields(answer).get("N0") for answer in answers] == expected,
              "a paste of 10,000 lines into a running plant: each answered, in order",
              *[answer for answer in answers if not answer.startswith("ok")][:3])
    firmware.ask("stop")
    status = firmware.ask("status")
    tap.check(status["uart_lost"] == "0" and status["rejected"] == "0", "none lost, none rejected", str(status))

with Firmware() as firmware:
    firmware.ask("set tick 10")
    stream = firmware.ask("stream csv x every 1")
    answer = firmware.ask("set substeps 64 tick 100000")
    tap.check(isinstance(stream, dict) and isinstance(answer, str) and answer.startswith("error line-overload"),
              "a pace that the stream's line cannot carry is refused", str(stream), str(answer))
    firmware.ask("step 3")
    tap.check([sample[0] for sample in firmware.samples] == ["1", "2", "3"] and
              all(len(sample) == 3 for sample in firmware.samples), "each sample begins with its step and time",
              str(firmware.samples))

with Firmware() as firmware:
    firmware.ask("preset fig7-ke5000")
    firmware.ask("set substeps 64 tick 100")
    firmware.ask("stream csv step,mode every 4096 force")
    answer = firmware.ask("step 100000")
    tap.check(isinstance(answer, str) and answer.startswith("error in-fault"), "a diverging plant ends a step in a fault", str(answer))
    tap.check(any("fault" in notice for notice in firmware.notices), "it says so at once", *firmware.notices)
    verdict, status = firmware.ask("verdict"), firmware.ask("status")
    tap.check(verdict["propensity"] == "squeal" and verdict["class"] == "diverging" and
              abs(float(verdict["t_v10"]) / 0.412073451 - 1) < 0.01, "and what it was: squeal, diverging", str(verdict))
    tap.check(status["state"] == "fault" and status["fault"] != "none", "status says so too", str(status))
    frozen = status["hash"]
    answers = [firmware.ask(line) for line in ("set alpha -0.001", "run")]
    tap.check(all(isinstance(answer, str) and answer.startswith("error in-fault") for answer in answers) and firmware.ask("status")["hash"] == frozen, "nothing moves it but a reset", *map(str, answers))
    firmware.ask("reset")
    status = firmware.ask("status")
    tap.check(status["state"] == "ready" and status["step"] == "0", "a reset leaves it", str(status))

for line, answer in [("run", b"ok run "), ("stream csv x every 10 force\rrun", b"ok run "), ("step 5000", b"ok step done=5000 ")]:
    try:
        host = subprocess.run([os.environ["HOST_IMAGE"]], input=b"echo off\r" + line.encode() + b"\r",
                              stdout=subprocess.PIPE, timeout=20)
        ended, said = host.returncode == 0, host.stdout.splitlines()
    except subprocess.TimeoutExpired:
        ended, said = False, []
    tap.check(ended and any(words.startswith(answer) for words in said), f"the host's process ends with its input: {line!r}",
              *map(str, said[-3:]))
tap.finish()
