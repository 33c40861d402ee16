#!/usr/bin/env python3
"""Does time matter? The same script of steps over every kind of line, slow and fast, with either end stopped for a while,
beside garbage, and in free run: the same bits each time. And a reader that stops takes samples from nobody but itself."""
import os
import pickle
import random
import select
import signal
import struct
import sys
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from controller import FORCE, KEEP, REQUESTS, SIGNALS, TYPES, wire  # noqa: E402
from firmware import Silence, Tap, is_emulated  # noqa: E402
from pair import LIMIT_S, Pairs, demand  # noqa: E402

STEPS = 20000
STEPS_MAX = 1000000  # of one request
PAUSE_S = 2.0
CLAMPED = 2
tap = Tap()
pairs = Pairs()
linked = pairs.linked


def go_on(goal, meanwhile, *with_what):
    """Does the one, at least once, until the other is reached, which must come in time."""
    until = time.monotonic() + LIMIT_S
    meanwhile(*with_what)
    while not goal():
        if time.monotonic() > until:
            raise Silence("the plant does not get there")
        meanwhile(*with_what)


boards = ("host", "board") if is_emulated("board") else ("host",)


def script(seed):
    """(steps, demand) of each turn."""
    dice, at, turns = random.Random(seed), 0, []
    while at < STEPS:
        count = min(dice.randint(1, 20), STEPS - at)
        turns.append((count, demand(dice)))
        at += count
    return turns


TURNS = script(1)


def lockstep(controller, delay_s=0.0, garbage=0, halfway=None):
    """Makes all turns. The replies as they were on the line, their states, and the longest turn with its pause in seconds."""
    clock, replies, states, longest_s = random.Random(time.time()), [], [], 0.0
    for turn, (count, wanted) in enumerate(TURNS):
        begun = time.monotonic()
        if halfway and turn == len(TURNS) // 2:
            halfway()
            delay_s = 3e-3  # or a fast plant is there before it can be stopped
        if garbage:
            controller.send(bytes(clock.randrange(256) for _ in range(garbage)) + b"\0")
        states.append(controller.step(count, *wanted))
        replies.append(controller.raw)
        if delay_s:
            time.sleep(clock.uniform(0, delay_s))
        longest_s = max(longest_s, time.monotonic() - begun)
    return replies, states, longest_s


def stopped(controller, firmware, is_controller):
    """The same with one of the two ends stopped in mid-run, the controller in a process of its own."""
    reader, writer = os.pipe()
    child = os.fork()
    if child == 0:
        try:
            result = lockstep(controller, halfway=lambda: os.write(writer, b"!"))
            with os.fdopen(writer, "wb") as pipe:
                pickle.dump(result, pipe)
        finally:
            os._exit(0)
    os.close(writer)
    with os.fdopen(reader, "rb") as pipe:
        try:
            if not select.select([pipe], [], [], LIMIT_S)[0] or pipe.read(1) != b"!":
                return [], [], 0.0
            victim = child if is_controller else firmware.process.pid
            os.kill(victim, signal.SIGSTOP)
            time.sleep(PAUSE_S)
            os.kill(victim, signal.SIGCONT)
            return pickle.load(pipe) if select.select([pipe], [], [], LIMIT_S)[0] else ([], [], 0.0)
        except EOFError:
            return [], [], 0.0
        finally:
            os.kill(child, signal.SIGKILL)
            os.waitpid(child, 0)


with linked("host", tick=20000.0) as (controller, _):
    truth, states, _ = lockstep(controller)
tap.check(states[-1]["step"] == STEPS and len({state["hash"] for state in states}) == len(TURNS) and
          any(state["flags"] == CLAMPED for state in states), f"the host goes {STEPS} steps in {len(TURNS)} turns")


def same(replies, claim, *notes):
    wrong = [turn for turn, (a, b) in enumerate(zip(replies, truth)) if a != b]
    tap.check(replies == truth, claim, f"{len(replies)} of {len(truth)} replies, first other one: {wrong[:1]}", *notes)


for where in boards:
    for line in ("unix", "tcp", "pty") if is_emulated(where) else ("unix",):
        with linked(where, line, tick=20000.0) as (controller, _):
            begun = time.monotonic()
            replies, _, _ = lockstep(controller)
            rate = len(replies) / (time.monotonic() - begun)
            same(replies, f"{where}, {line}: all replies are the same bytes")
            tap.note(f"{where}, {line}: {rate:.0f} turns a second")
    with linked(where, tick=20000.0) as (controller, _):
        same(lockstep(controller, delay_s=500e-6)[0], f"{where}: with pauses of up to 500 us as well")
    for is_controller, name in ((False, "firmware"), (True, "controller")):
        with linked(where, tick=20000.0) as (controller, firmware):
            replies, _, longest_s = stopped(controller, firmware, is_controller)
            same(replies, f"{where}: with the {name} stopped for 2 s in mid-run as well")
            tap.check(longest_s >= 0.9 * PAUSE_S, f"{where}: which a turn has felt", f"the longest took {longest_s} s")
    garbage = 40 if is_emulated(where) else 400
    with linked(where, tick=20000.0) as (controller, _):
        replies, _, _ = lockstep(controller, garbage=garbage)
        same(replies, f"{where}: garbage between the frames changes no bit")
        status = controller.status()
        tap.check(status["garbage"] > garbage * len(TURNS) * 0.9 and status["refused"] == 0,
                  f"{where}: it is counted, and gets silence", str(status))

# --- Free run: the same inputs ahead of time ------------------------------------------------------------------------
dice = random.Random(2)
INPUTS = sorted((at, *demand(dice)) for at in random.Random(3).sample(range(1, STEPS), 32))
INPUTS = [row if row[1] or row[3] else (row[0], FORCE, 2000.0, KEEP, 0.0) for row in INPUTS]


def silence(controller, firmware):
    time.sleep(0.3)


def stop_once(controller, firmware, done=set()):
    """Stops the firmware, once for each."""
    if firmware.process.pid not in done:
        done.add(firmware.process.pid)
        os.kill(firmware.process.pid, signal.SIGSTOP)
        time.sleep(PAUSE_S)
        os.kill(firmware.process.pid, signal.SIGCONT)


def flood(controller, firmware):
    """Garbage and valid requests, more of them than fit into the receiver's ring; all are answered, in their order."""
    asked = [("PING", (time.monotonic_ns(),)), ("STATUS", ()), ("DICTIONARY", (0, 1)), ("READ", (2, 0))] * 40
    for number, (name, fields) in enumerate(asked):
        controller.send(wire(TYPES[name], number, 0, struct.pack("<" + REQUESTS[name], *fields)) + os.urandom(30) + b"\0")
    for number, (name, _) in enumerate(asked):
        controller.answer(name, number)


def free_run(where, meanwhile):
    """Runs with the inputs on their way ahead; where a STOP met it, and the counters."""
    with linked(where, tick=1000.0, substeps=8.0) as (controller, firmware):
        for at, load_kind, load, speed_kind, speed in INPUTS:
            controller.ask("INPUT", at, load_kind, speed_kind, load, speed)
        controller.ask("RUN")
        go_on(lambda: controller.status()["step"] >= STEPS, meanwhile, controller, firmware)
        step = controller.ask("STOP")
        return step, controller.status()


def replay(step):
    """The same inputs by STEP, each at its own, to the given step."""
    with linked("host", tick=20000.0, substeps=64.0) as (controller, _):
        for at, *wanted in INPUTS:
            if at > controller.at:
                controller.step(at - controller.at)
            controller.step(1, *wanted)
        while step - controller.at > STEPS_MAX:  # a fast plant has gone far
            controller.step(STEPS_MAX)
        return controller.step(step - controller.at)["hash"]


for where in boards:
    for meanwhile, name in ((silence, "in silence"), (flood, "flooded with garbage and requests"),
                            (stop_once, "with a pause of 2 s")):
        step, status = free_run(where, meanwhile)
        tap.check(step >= STEPS and (status["late"], status["inputs"]) == (0, 32) and replay(step) == status["hash"],
                  f"{where}: free run {name} goes through the bits of lockstep", f"step {step} {status}")
        tap.check((meanwhile == flood) == (status["garbage"] > 1000) and status["refused"] == 0,
                  f"{where}: nothing was refused", str(status))

# --- A reader that stops --------------------------------------------------------------------------------------------
for where in boards:
    with linked(where, substeps=8.0, tick=1000.0) as (controller, _):
        every, _, size = controller.ask("STREAM", (1 << len(SIGNALS)) - 1, 1)
        controller.ask("RUN")
        go_on(lambda: controller.status()["offered"] * size >= 3e6, time.sleep, 1.0)
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
        tap.note(f"{where}: {status['offered'] * size / 1e6:.1f} MB offered, {len(steps)} samples of {size} bytes read, "
                 f"{status['dropped']} dropped")
        count = len(steps)
        controller.step(1000)
        tap.check([sample[1] for sample in controller.samples[count:]] ==
                  list(range(status["step"] + 1, status["step"] + 1001)) and
                  controller.status()["dropped"] == status["dropped"], f"{where}: who reads again gets every sample")
        tap.check(controller.ask("STREAM", 0, 0)[0] == 0 and
                  controller.refusal("STEP", 1, 9, 0, 0.0, 0.0, step=controller.at).reason == "bad-sequence",
                  f"{where}: afterwards it is as before")

pairs.close()
tap.finish()
