#!/usr/bin/env python3
"""The link on the host and on the board: the same bits in lockstep, in free run, beside garbage, after a pause; a STEP that
is sent twice; a reader that stops; a controller that falls silent; a run that moves from board to board; and the frames of
PROTOCOL.md."""
import contextlib
import os
import random
import re
import shutil
import signal
import socket
import struct
import sys
import tempfile
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from controller import (DISC, FORCE, KEEP, PIECE, PRESSURE, PROFILE, SAMPLE, SOURCES, STARTS, TYPES, VEHICLE,  # noqa: E402
                        Controller, SYMBOLS, SIGNALS, REQUESTS, Refused, unwire, wire)
from firmware import COMMANDS, Firmware, Tap  # noqa: E402

STEPS = 20000
FAULT, CLAMPED, CUT, STALE, SAFE = 1, 2, 4, 8, 16
tap = Tap()
folder = tempfile.mkdtemp(prefix="squeal-link-")
paths = (os.path.join(folder, str(number)) for number in range(1000))


@contextlib.contextmanager
def linked(where, preset="brake", number_format=None, **values):
    """(controller, firmware) with the preset and these values in force, at step 0."""
    path = next(paths)
    with Firmware(where, limit_s=120, link=path) as firmware:
        controller = Controller(path, limit_s=120)
        controller.ask("HELLO", 1, 0)
        controller.preset(preset)
        controller.set(arith=arith if number_format is None else number_format, **values)
        try:
            yield controller, firmware
        finally:
            controller.close()


def own_arithmetic():
    """The board's, which the host is to use as well."""
    with Firmware("board") as firmware:
        return ["f32", "q27"].index(firmware.ask("get arith")["arith"])


arith = own_arithmetic()


def demand(dice):
    """Random force and speed, or what they were, or back to the profiles."""
    load_kind, speed_kind = dice.choice([KEEP, KEEP, PROFILE, FORCE, PRESSURE]), dice.choice([KEEP, KEEP, PROFILE, DISC, VEHICLE])
    load = {FORCE: dice.uniform(-100, 13000), PRESSURE: dice.uniform(0, 4e6)}.get(load_kind, 0.0)
    speed = {DISC: dice.uniform(-0.1, 1), VEHICLE: dice.uniform(0, 3)}.get(speed_kind, 0.0)
    return load_kind, load, speed_kind, speed


def lockstep(where, seed, delays, garbage=0):
    """Where a script of random grants and inputs leads: (step, hash) after each turn, and the counters."""
    dice, clock, seen = random.Random(seed), random.Random(time.time()), []
    with linked(where, tick=20000.0) as (controller, _):
        controller.ask("RESET")
        while controller.at < STEPS:
            count = min(dice.randint(1, 20), STEPS - controller.at)
            if garbage:
                noise = bytes(clock.randrange(256) for _ in range(garbage))
                controller.send(noise[:garbage // 2] + b"\0")
            state = controller.step(count, *demand(dice))
            if garbage:
                controller.send(noise[garbage // 2:] + b"\0")
            seen.append((state["step"], state["hash"], state["flags"]))
            if delays:
                time.sleep(clock.uniform(0, 500e-6))
        return seen, controller.status()


truth, _ = lockstep("host", 1, delays=False)
tap.check(truth[-1][0] == STEPS and len({word for _, word, _ in truth}) == len(truth) and any(flags == CLAMPED for *_, flags in truth),
          f"the host goes {STEPS} steps in {len(truth)} turns")
for where in ("host", "board"):
    seen, _ = lockstep(where, 1, delays=True)
    tap.check(seen == truth, f"{where}: the same bits in lockstep, with random inputs and delays of up to 500 us",
              *[f"{a} instead of {b}" for a, b in zip(seen, truth) if a != b][:3])
for where, garbage in (("host", 400), ("board", 40)):
    seen, status = lockstep(where, 1, delays=False, garbage=garbage)
    tap.check(seen == truth, f"{where}: garbage between the frames changes no bit")
    tap.check(status["garbage"] > garbage * len(truth) * 0.9 and status["refused"] == 0,
              f"{where}: it is counted, and gets silence", str(status))

# --- Free run: the same inputs ahead of time, one pause of two seconds ----------------------------------------------
dice = random.Random(2)
INPUTS = sorted((at, *demand(dice)) for at in random.Random(3).sample(range(1, STEPS), 32))
INPUTS = [row if row[1] or row[3] else (row[0], FORCE, 2000.0, KEEP, 0.0) for row in INPUTS]


def free_run(where, pause_s=0.0):
    """Runs with the inputs on their way ahead; (step, hash) where a STOP met it."""
    with linked(where, tick=1000.0, substeps=8.0) as (controller, firmware):
        controller.ask("RESET")
        for at, load_kind, load, speed_kind, speed in INPUTS:
            controller.ask("INPUT", at, load_kind, speed_kind, load, speed)
        controller.ask("RUN")
        while controller.status()["step"] < STEPS:
            if pause_s and controller.at > STEPS // 4:
                os.kill(firmware.process.pid, signal.SIGSTOP)
                time.sleep(pause_s)
                os.kill(firmware.process.pid, signal.SIGCONT)
                pause_s = 0.0
        step = controller.ask("STOP")
        status = controller.status()
        return step, status["hash"], status["late"], status["inputs"]


def replay(where, step):
    """The same inputs by STEP, each at its own, to the given step."""
    with linked(where, tick=20000.0, substeps=64.0) as (controller, _):
        controller.ask("RESET")
        for at, *wanted in INPUTS:
            if at > controller.at:
                controller.step(at - controller.at)
            controller.step(1, *wanted)
        return controller.step(step - controller.at)["hash"]


for where, pause_s in (("host", 0.0), ("board", 0.0), ("board", 2.0)):
    step, word, late, inputs = free_run(where, pause_s)
    tap.check(step >= STEPS and (late, inputs) == (0, 32) and replay("host", step) == word,
              f"{where}: free run{' with a pause of 2 s' if pause_s else ''} and lockstep go through the same bits",
              f"step {step} late {late} inputs {inputs}")

# --- Twice the same ------------------------------------------------------------------------------------------------
with linked("board", tick=20000.0) as (controller, firmware):
    payload = struct.pack("<" + REQUESTS["STEP"], 100, FORCE, KEEP, 2000.0, 0.0)
    controller.send(wire(TYPES["STEP"], 7, 0, payload) * 3)
    replies = [(controller.frame(), controller.raw)[1] for _ in range(3)]
    tap.check(len(set(replies)) == 1 and controller.status()["step"] == 100 and controller.status()["inputs"] == 1,
              "a STEP that comes three times is made once, and answered with the same bytes each time")

    # The other line.
    controller.at, controller.step_sequence = 100, 7
    controller.send(wire(TYPES["STEP"], 8, 100, struct.pack("<" + REQUESTS["STEP"], 1000000, KEEP, KEEP, 0.0, 0.0)))
    time.sleep(0.2)
    answer = firmware.ask("stop")
    flags = controller.answer("STEP", 8)[-1]
    tap.check(flags == CUT and int(answer["step"]) == controller.at < 1000000, "a stop on the console ends a long STEP",
              str(answer), f"flags {flags}")
    firmware.send("step 100000000")
    firmware.send("get N0")
    firmware.flush()
    while controller.status()["state"] != 1:
        pass
    tap.check(controller.refusal("STEP", 1, 0, 0, 0.0, 0.0, sequence=9, step=controller.at).reason == "busy",
              "while the console steps the link does not")
    step = controller.ask("STOP")
    tap.check(firmware.answer().startswith(f"error stopped step={step}:") and firmware.answer().startswith("ok get N0"),
              "a STOP on the link ends the console's step")

# --- A reader that stops --------------------------------------------------------------------------------------------
for where in ("host", "board"):
    with linked(where, substeps=8.0, tick=1000.0) as (controller, firmware):
        every, _, size = controller.ask("STREAM", (1 << len(SIGNALS)) - 1, 1)
        controller.ask("RUN")
        time.sleep(3.0)
        controller.ask("STOP")
        status = controller.status()
        steps = [sample[1] for sample in controller.samples]
        numbers = [sample[0] for sample in controller.samples]
        gaps = sum(b - a - 1 for a, b in zip([0] + steps, steps + [status["step"] + 1]))
        tap.check(status["dropped"] > 0 and status["offered"] == status["step"] == status["sent"] + status["dropped"] and
                  status["waiting"] == 0 and len(steps) == status["sent"],
                  f"{where}: a reader stops: what was offered is sent or dropped, exactly", str(status))
        tap.check(gaps == status["dropped"] and all(number == (step - 1) & 0xffff for number, step in zip(numbers, steps)),
                  f"{where}: and each gap shows in the numbers", f"{gaps} in gaps")
        tap.check(controller.ask("STREAM", 0, 0)[0] == 0 and controller.refusal("STEP", 1, 9, 0, 0.0, 0.0, step=status["step"]).index == 1,
                  f"{where}: afterwards it is as before")
        tap.note(f"{where}: {len(steps)} samples of {size} bytes read, {status['dropped']} dropped")

# --- A controller that falls silent ---------------------------------------------------------------------------------
STEP_S = 7.79e-6  # of the brake


def silences(where):
    """(step, hash, flags, propensity), or the reason of a refusal, for each turn of a controller that comes and goes."""
    dice, seen = random.Random(4), []
    with linked(where, tick=20000.0, stale=50 * STEP_S, safe=150 * STEP_S, ramp=100 * STEP_S) as (controller, _):
        for turn in range(1500):
            is_silent = turn // 40 % 3 == 2
            kind = KEEP if is_silent or dice.random() < 0.5 else FORCE | (STARTS if dice.random() < 0.1 else 0)
            try:
                state = controller.step(dice.randint(1, 25), kind, dice.uniform(1000, 4000))
                seen.append((state["step"], state["hash"], state["flags"], state["propensity"]))
            except Refused as refused:
                controller.step_sequence -= 1
                seen.append(refused.reason)
        return seen, controller.status()


truth, status = silences("host")
flags = [row[2] for row in truth if row != "safe-state"]
tap.check({0, STALE, SAFE} == set(flags) and "safe-state" in truth and status["times_safe"] > 5 and
          all(row[3] == 0 for row in truth if row != "safe-state" and row[2]),
          f"a controller that comes and goes: {status['times_stale']} times stale, {status['times_safe']} times safe, "
          "and no verdict then")
tap.check(all(truth[at + 1] == "safe-state" or truth[at + 1][2] == SAFE or at + 1 in starts
              for starts in [{i for i, row in enumerate(truth) if row != "safe-state" and row[2] == 0}]
              for at, row in enumerate(truth[:-1]) if row == "safe-state"),
          "after a refusal it is safe, or has been started")
seen, _ = silences("board")
tap.check(seen == truth, "board: the same", *[f"{a} instead of {b}" for a, b in zip(seen, truth) if a != b][:3])

for where in ("host", "board"):
    with linked(where, tick=1000.0, substeps=8.0, stale=0.2, safe=0.4, ramp=0.2) as (controller, _):
        controller.ask("RUN")
        controller.ask("INPUT", 0, FORCE, KEEP, 2000.0, 0.0)
        states = [controller.status()]
        while states[-1]["input_state"] != 3:
            states.append(controller.status())
        seen = [(state["input_state"], state["ticks"]) for state in states]  # a slow reader may miss one
        refusal = controller.refusal("INPUT", 0, FORCE, KEEP, 2000.0, 0.0).reason
        controller.ask("RUN")
        controller.ask("INPUT", 0, FORCE, KEEP, 2000.0, 0.0)
        tap.check(all(ticks >= {1: 0, 2: 200, 3: 400}[state] for state, ticks in seen) and seen == sorted(seen) and
                  refusal == "safe-state" and controller.status()["input_state"] < 3,
                  f"{where}: in free run the wall's time counts, and a RUN leads back", f"{seen} {refusal}")

# --- A run on another board -----------------------------------------------------------------------------------------


def go_on(controller, seed):
    dice, seen = random.Random(seed), []
    for _ in range(60):
        seen.append(tuple(controller.step(dice.randint(1, 40), *demand(dice)).values()))
    return seen, {key: controller.status()[key] for key in ("hash", "set_crc", "events", "inputs", "input_state")}


for arithmetic, name in enumerate(("f32", "q27")):
    for where in ("host", "board"):
        with linked(where, number_format=arithmetic, tick=20000.0, stale=100 * STEP_S) as (controller, _):
            go_on(controller, 5)
            controller.ask("INPUT", controller.at + 777, FORCE, KEEP, 3300.0, 0.0)
            run, at = controller.snapshot(), controller.at
            truth = go_on(controller, 6)
            controller.restore(run)
            tap.check(controller.at == at and go_on(controller, 6) == truth,
                      f"{name} on {where}: put back at step {at}, the run is the same again")
            broken = bytearray(run)
            broken[1000] ^= 1
            try:
                controller.restore(bytes(broken))
                reason = "none"
            except Refused as refused:
                reason = refused.reason
            tap.check(reason == "wrong-crc" and controller.status()["hash"] == truth[1]["hash"],
                      f"{name} on {where}: a broken one is refused, and nothing changes", reason)
        for target in sorted(set(COMMANDS) - {"board"}):
            with linked(target, "table1", number_format=1 - arithmetic, tick=20000.0) as (controller, _):
                controller.restore(run)
                tap.check(controller.snapshot() == run and go_on(controller, 6) == truth,
                          f"{name} from {where} to {target}: byte for byte the same image, and the same run")

# --- What a turn takes ----------------------------------------------------------------------------------------------
for where in ("host", "board"):
    with linked(where, tick=20000.0) as (controller, _):
        begun = time.monotonic()
        for _ in range(1000):
            controller.step(1, FORCE, 2000.0)
        tap.note(f"{where}: {1000 / (time.monotonic() - begun):.0f} turns of one step a second")

# --- The frames of the document -------------------------------------------------------------------------------------
with open(os.path.join(SOURCES, "protocol", "PROTOCOL.md"), encoding="utf-8") as page:
    document = page.read()
worked = re.findall(r"^    ([<>]) ((?:[0-9a-f]{2}(?:\*\d+)? ?)+)(\.\.\.)?", document, re.MULTILINE)


def told(words):
    """Bytes as the document writes them: 01*20 is twenty times 01."""
    return b"".join(bytes.fromhex(word[:2]) * int(word[3:] or 1) for word in words.split())


path = next(paths)
with Firmware("host", link=path):
    controller = Controller(path)
    wrong, count = [], 0
    for side, text, is_cut in worked:
        said = told(text)
        if side == ">":
            controller.send(said)
            count += 1
        else:
            controller.any_frame()
            heard = controller.raw[:len(said)] if is_cut else controller.raw
            if heard != said:
                wrong.append(f"{heard.hex(' ')} instead of {text}")
tap.check(count >= len(TYPES) and not wrong, f"{len(worked)} frames of the document are those on the line", *wrong)
image = document[document.index("The image,"):document.index("A frame of the detector:")]
sizes = re.findall(r"^\| (\d+) \| ", image, re.MULTILINE)
tap.check(sum(map(int, sizes)) == len(run), "the fields of the image are as long as it is", str(sizes))
asked = {unwire(told(text)[:-1])[0] for side, text, _ in worked if side == ">"}
tap.check(set(TYPES.values()) <= asked, "every type of request is among them", str(set(TYPES.values()) - asked))

shutil.rmtree(folder)
tap.finish()
