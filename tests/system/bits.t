#!/usr/bin/env python3
"""The same bits on the host and on the board, in both arithmetics: more than a million steps with events, load, surface and
parameter changes, every state hashed, for 1, 7 and 64 steps a tick and across stops. Then what main sees of a running
plant is never torn."""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from firmware import COMMANDS, Firmware, Tap  # noqa: E402

# What is done to the plant between grants of steps: live changes, and a restart with another model.
SCRIPT = [
    ("preset fig5-n10", 200000),
    ("set alpha -0.02 N0 12", 100000),
    ("set v0 0.7", 100000),
    ("set k 1.3 mu_s 0.28 c 0.02", 100000),
    ("set mu_floor 0.05", 100000),
    ("set spp 128 alpha -0.01", 50000),
    ("set spp 1024 normal exact cn 0.03", 50000),
    ("preset brake", 100000),
    ("set N1 6000", 60000),
    ("set v0 0.3", 40000),
    ("defaults", 1),
    ("set contact lift load step N0 3 N1 1 t1 32.7 normal exact", 100000),
    ("defaults", 1),
    ("set load sine N0 3 N1 1 fN 0.1743 contact no_pull speed ramp v0 1 v1 -1 tv1 20 tv2 400", 100000),
    ("set rough 0.02 runout 0.3 R 0.7 seed 5", 40000),
    ("set speed constant v0 -0.4 seed 16777215 cn 0.02 spp 128", 60000),
    ("preset brake", 1),
    ("table load 0 500 0.02 3000 0.02 2000 0.06 2500", 1),
    ("table speed 0.01 1.5 0.2 -0.5", 1),
    ("set load table lag 0.004 dither 200 f_dither 1700 speed table v_lag 0.01", 40000),
    ("set load pulses t1 0.2 rise 0.001 hold 0.004 every 0.0071 N_off 100 N_high 2900 v_dither 0.1 fv_dither 333", 30000),
    ("set speed inertia J 0.05 v_dither 0", 40000),
]


def hashes(where, arith, substeps, pieces=1, share=1):
    """Hash after each line of the script, the grant being cut into pieces. share takes a part of the steps."""
    seen = []
    with Firmware(where, limit_s=120) as firmware:
        for line, steps in SCRIPT:
            steps = max(steps // share, 1)
            resets = line.startswith(("preset", "defaults"))
            if isinstance(firmware.ask(line), str) or resets and isinstance(firmware.ask(f"set arith {arith}"), str):
                return [f"refused: {line}"]
            firmware.ask(f"set substeps {substeps} tick {9600 // substeps}")
            first = steps - steps // pieces * (pieces - 1)
            for grant in [first] + [steps // pieces] * (pieces - 1 if steps >= pieces else 0):
                done = firmware.ask(f"step {grant}")
            seen.append((done["step"], done["hash"]))
        status = firmware.ask("status")
    return seen + [status["caps"], status["saturations"]]


# Steps a tick and cuts of the grants; the arithmetic that is not the board's own makes do with two of them.
RUNS = [("host", 1, 1), ("host", 7, 5), ("board", 64, 1), ("board", 7, 5), ("board", 1, 2)]
tap = Tap()


def own_arithmetic(where):
    """The one that the board starts with."""
    with Firmware(where) as firmware:
        return firmware.ask("get arith")["arith"]


default = own_arithmetic("board")
for arith in ["f32", "q27"]:
    # A board that starts in fixed point has no FPU: its floats are worth a fiftieth of the steps.
    share = 50 if arith == "f32" != default else 1
    truth = hashes("host", arith, 64, share=share)
    tap.check(len(truth) == len(SCRIPT) + 2, f"{arith}: the host goes through the script", *truth)
    tap.check(len({pair[1] for pair in truth[:len(SCRIPT)]}) == len(SCRIPT) - 1,
              f"{arith}: and its states differ wherever the lines do")
    for where, substeps, pieces in RUNS if arith == default else RUNS[1:3]:
        seen = hashes(where, arith, substeps, pieces, share)
        tap.check(seen == truth, f"{arith} on {where}: same bits with {substeps} steps a tick, grants cut in {pieces}",
                  *[f"{line}: {a} instead of {b}" for (line, _), a, b in zip(SCRIPT, seen, truth) if a != b][:3])

for where in sorted(set(COMMANDS) - {"board", "host", os.environ["BOARD"]}):
    own = own_arithmetic(where)
    for arith in ["f32", "q27"]:
        share = 50 if arith == "f32" != own else 5
        seen, truth = (hashes(place, arith, 64, share=share) for place in (where, "host"))
        tap.check(len(seen) == len(SCRIPT) + 2 and seen == truth, f"{arith} on {where}: same bits, a part of the steps",
                  *[f"{line}: {a} instead of {b}" for (line, _), a, b in zip(SCRIPT, seen, truth) if a != b][:3])


def running_pairs(extra):
    """(step, hash) as status and the stream show them while the tick pre-empts main."""
    with Firmware("board", extra, limit_s=120) as firmware:
        firmware.ask("preset fig5-n10")
        firmware.ask(f"set arith {default}")
        firmware.ask("set substeps 1 tick 5000")
        firmware.ask("stream csv step,hash every 23 force")
        firmware.ask("run")
        pairs, streamed = [], []
        for _ in range(150):
            status = firmware.ask("status")
            pairs.append((int(status["step"]), status["hash"]))
            streamed += firmware.samples
        firmware.ask("stop")
        streamed += firmware.samples
        status = firmware.ask("status")
        selftest = firmware.ask("selftest")
    pairs += [(int(step), word) for step, _, word in streamed]
    return pairs, len(streamed), status, selftest


def true_hashes(steps):
    """The host's hash at each of the given steps."""
    found, at = {}, 0
    with Firmware("host", limit_s=120) as firmware:
        firmware.ask("preset fig5-n10")
        firmware.ask(f"set arith {default}")
        firmware.ask("set substeps 64 tick 1000")
        for step in sorted(set(steps) - {0}):
            found[step] = firmware.ask(f"step {step - at}")["hash"]
            at = step
    return found


for name, extra in [("counted instructions", ()), ("single steps", ("-singlestep",))]:
    pairs, streamed, status, selftest = running_pairs(extra)
    truth = true_hashes([step for step, _ in pairs])
    torn = [pair for pair in pairs if pair[0] and truth[pair[0]] != pair[1]]
    tap.check(not torn, f"{name}: none of {len(pairs)} views of a running plant is torn", *torn[:5])
    tap.check(streamed > 50, f"{name}: the stream ran meanwhile", f"{streamed} samples")
    tap.check(isinstance(selftest, dict), f"{name}: the device's own tests pass, ticks against its clock among them",
              str(selftest))
# More work than the period holds: main must go on answering, and the counters must say what happened.
with Firmware("board", limit_s=30) as firmware:
    firmware.ask("preset fig5-n10")
    firmware.ask("set substeps 64 tick 100000")
    firmware.ask("run")
    steps = [int(firmware.ask("status")["step"]) for _ in range(20)]
    stopped = firmware.ask("stop")
    status = firmware.ask("status")
    tap.check(isinstance(stopped, dict) and int(status["overruns"]) > 0 and int(status["shed"]) > int(status["overruns"]),
              "an overrun is counted and shed, and main goes on", str(status))
    tap.check(steps == sorted(steps) and steps[-1] > steps[0], "the plant too", *steps)
    tap.check(isinstance(firmware.ask("selftest"), dict), "and no tick counts as lost by the timer")
tap.finish()
