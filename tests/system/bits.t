#!/usr/bin/env python3
"""The same bits on the host and on the board, in both arithmetics: more than a million steps with events, load, surface and
parameter changes, every state hashed, for 1, 7 and 64 steps a tick and across stops. Then what main sees of a running
plant is never torn."""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from bits import SCRIPT, differences, hashes, own_arithmetic  # noqa: E402
from firmware import COMMANDS, Firmware, Tap  # noqa: E402

# Steps a tick and cuts of the grants; the arithmetic that is not the board's own makes do with two of them.
RUNS = [("host", 1, 1), ("host", 7, 5), ("board", 64, 1), ("board", 7, 5), ("board", 1, 2)]
SMALLEST_NORMAL = 2.0 ** -126
tap = Tap()
default = own_arithmetic("board")
for arith in ["f32", "q27"]:
    # A board that starts in fixed point has no FPU: its floats are worth a fiftieth of the steps.
    share = 50 if arith == "f32" != default else 1
    truth = hashes("host", arith, 64, share=share)
    tap.check(len(truth) == len(SCRIPT) + 3, f"{arith}: the host goes through the script", *truth)
    tap.check(len({pair[1] for pair in truth[:len(SCRIPT)]}) == len({line for line, _ in SCRIPT}),
              f"{arith}: and its states differ wherever the lines do")
    for where, substeps, pieces in RUNS if arith == default else RUNS[1:3]:
        seen = hashes(where, arith, substeps, pieces, share)
        tap.check(seen == truth, f"{arith} on {where}: same bits with {substeps} steps a tick, grants cut in {pieces}",
                  *differences(seen, truth))

rest = hashes("host", "f32", 64, share=50)[-1]
tap.check(any(0.0 < abs(value) < SMALLEST_NORMAL for value in rest), "a release to rest ends in numbers below the normal ones", rest)

for where in sorted(set(COMMANDS) - {"board", "host", os.environ["BOARD"]}):
    own = own_arithmetic(where)
    for arith in ["f32", "q27"]:
        share = 50 if arith == "f32" != own else 5
        seen, truth = (hashes(place, arith, 64, share=share) for place in (where, "host"))
        tap.check(len(seen) == len(SCRIPT) + 3 and seen == truth, f"{arith} on {where}: same bits, a part of the steps",
                  *differences(seen, truth))


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
