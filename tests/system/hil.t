#!/usr/bin/env python3
"""A controller firmware and a plant firmware wired together: the same bits in any pair of boards and whatever stops one of
them for a while; the law keeps its promises; a plant that dies, or that refuses, is told."""
import os
import random
import sys
import time

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [HERE, os.path.join(HERE, "..", "hil")]
from firmware import Tap  # noqa: E402
import hil  # noqa: E402
from rig import PHASES, Rig  # noqa: E402

BOARD = os.environ["BOARD"]
STEPS = 20000
tap = Tap()


def is_safe(stop):
    """The law's last phase."""
    return [phase[1:] for phase in stop.phases[-1:]] == [("safe", 0.0)]


def sleepless(turn_count):
    """Stops either side for a while, at random, every so many turns."""
    dice, clock = random.Random(time.time()), {"next": 0, "stops": 0}

    def tamper(rig, stop):
        if len(stop.rows) < clock["next"]:
            return
        clock["next"] = len(stop.rows) + dice.randint(1, turn_count)
        clock["stops"] += 1
        child = dice.choice(rig.children)
        child.freeze(True)
        time.sleep(dice.choice([0.02, 0.05, 0.3]))
        child.freeze(False)

    return tamper, clock


# --- The same bits ---------------------------------------------------------------------------------------------------
with Rig(BOARD) as rig:
    tamper, clock = sleepless(40)
    first = rig.stop("stop 0.4 law", tamper)
    second = rig.stop("stop 0.4 law", tamper)
    # A board without an FPU starts in fixed point: the host is to do as the board does.
    arith = rig.plant.ask("get arith")["arith"]
with Rig("host") as rig:
    truth = rig.stop(f"stop 0.4 law {arith}")
tap.check(truth.end.startswith("score") and truth.rows[-1]["step"] >= STEPS and len(set(truth.hashes())) == len(truth.rows),
          f"two processes go {truth.rows[-1]['step']} steps in {len(truth.rows)} turns", truth.end)
for stop in (first, second):
    tap.check(stop.hashes() == truth.hashes() and stop.phases == truth.phases,
              "two boards wired together go through the same bits, though either stops now and then", stop.end,
              *[f"{a} instead of {b}" for a, b in zip(stop.hashes(), truth.hashes()) if a != b][:3])
tap.note(f"{clock['stops']} stops; {first.fields.get('repeated')} and {second.fields.get('repeated')} requests repeated")
tap.check(clock["stops"] > 5, "they did stop")

# --- What the law promises -------------------------------------------------------------------------------------------
with Rig("host") as rig:
    law = rig.stop("stop 2 law")
    free = rig.stop("stop 2 free")
    again = rig.stop("stop 2 law q27")
    odd = [rig.stop(order).end.split(":")[0] for order in ("go", "stop", "stop x law", "stop 2 law f64", "stop 2 law f32 now")]
wrong = hil.check(law, free)
tap.check(not wrong, "squeal, action, quiet, standstill", *wrong)
tap.check(not hil.check(again, free), "in fixed point too")
tap.check(bool(hil.check(free, free)) and bool(hil.check(law, law)), "a law that does nothing is found out, and so is one compared with itself")
tap.check(all(row["pressure_pa"] <= row["demand_pa"] * 1.00001 for row in law.rows), "never more than the driver asks for")
tap.check(all(row["pressure_pa"] == row["demand_pa"] for row in free.rows), "switched off, exactly that")
loud = max(row["amplitude_m"] for row in free.rows)
tap.check(max(row["amplitude_m"] for row in law.rows) < 0.2 * loud, "the pad swings less than a fifth of what it would")
acted = [row for row in law.rows if row["phase"] == PHASES.index("release")]
tap.check(acted and all(acted[0]["pressure_pa"] > row["pressure_pa"] for row in law.rows
                        if acted[0]["turn"] + 10 < row["turn"] < acted[0]["turn"] + 30), "it backs off and stays there for a while")
tap.check(odd == ["error not an order"] * 5, "what is no order is told so", str(odd))

# --- What goes wrong -------------------------------------------------------------------------------------------------
for where in ("host", BOARD):
    with Rig(where) as rig:
        def kill(rig, stop):
            if len(stop.rows) == 20 and rig.plant.process.returncode is None:
                rig.plant.process.kill()
                rig.plant.process.wait()
                rig.plant.pump = lambda wait_s: None
        lost = rig.stop("stop 2 law", kill)
    tap.check(lost.end == "lost step: no answer in 3.2 s" and is_safe(lost) and 20 <= len(lost.rows) < 200,
              f"{where}: the plant is killed: the controller says so and releases the brake", lost.end, str(lost.phases))

with Rig("host") as rig:
    def start(rig, stop):
        if len(stop.rows) == 100:
            rig.plant.send("run")
    refused = rig.stop("stop 2 law", start)
    rig.plant.ask("stop")
    load = rig.plant.ask("step 1")["N"]
tap.check(refused.end.startswith("refused step is-running ") and is_safe(refused),
          "somebody else starts the plant: the controller says why it stops", refused.end)
tap.check(load == "0", "and has released the brake", load)

tap.finish()
