#!/usr/bin/env python3
"""A controller that falls silent, and a run that moves from board to board."""
import os
import random
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from controller import FORCE, KEEP, STARTS, Refused  # noqa: E402
from firmware import COMMANDS, Tap  # noqa: E402
from pair import Pairs, demand  # noqa: E402

STALE, SAFE = 8, 16
tap = Tap()
pairs = Pairs()
linked = pairs.linked

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
                  refusal == "safe-state" and controller.at > 0,
                  f"{where}: in free run the wall's time counts; after a RUN an input is taken again", f"{seen} {refusal}")

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
            with linked(target, preset="table1", number_format=1 - arithmetic, tick=20000.0) as (controller, _):
                controller.restore(run)
                tap.check(controller.snapshot() == run and go_on(controller, 6) == truth,
                          f"{name} from {where} to {target}: byte for byte the same image, and the same run")

pairs.close()
tap.finish()
