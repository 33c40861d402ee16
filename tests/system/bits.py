#!/usr/bin/env python3
"""The same bits on every board and on the host: a script of more than a million steps with events, load, surface and parameter
changes, the contact that lifts, stops, restarts, and a release to rest. The firmware hashes every state.

As a program it goes through all of it in both arithmetics on all boards, two at a time, prints "board arith steps hash" for
each and exits with 1 if any two differ. Standard library only; COMMANDS in the environment: see firmware.py."""
import concurrent.futures
import os
import sys
import zlib

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from firmware import COMMANDS, Firmware, Silence  # noqa: E402

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
    ("reset", 30000),
    ("defaults", 1),
    ("set contact lift load step N0 3 N1 1 t1 32.7 normal exact", 100000),
    ("defaults", 1),
    ("set load sine N0 3 N1 1 fN 0.1743 contact no_pull speed ramp v0 1 v1 -1 tv1 20 tv2 400", 100000),
    ("set rough 0.02 runout 0.3 R 0.7 seed 5", 40000),
    ("set speed constant v0 -0.4 seed 16777215 cn 0.02 spp 128", 60000),
    ("preset stop", 1),
    ("table load 0 500 0.02 3000 0.02 2000 0.06 2500", 1),
    ("table speed 0.01 1.5 0.2 -0.5", 1),
    ("set load table lag 0.004 dither 200 f_dither 1700 speed table v_lag 0.01", 40000),
    ("set load pulses t1 0.2 rise 0.001 hold 0.004 every 0.0071 N_off 100 N_high 2900 v_dither 0.1 fv_dither 333", 30000),
    ("set speed inertia J 0.05 v_dither 0", 40000),
    # The force goes, and pad and disc with it, down to the smallest numbers that a float has.
    ("defaults", 1),
    ("set c 0.3 cn 0.3 x0 0.1 load step N0 3 N1 0 t1 10", 5000),
]


# Steps of a line that are too few to take a part of them.
WHOLE = 5000


def hashes(where, arith, substeps, pieces=1, share=1, limit_s=120):
    """(step, hash) after each line of the script, the grant being cut into pieces with a stop between them, then what else must
    be equal. share takes a part of the steps."""
    seen = []
    with Firmware(where, limit_s=limit_s) as firmware:
        for line, steps in SCRIPT:
            steps = steps // share if steps > WHOLE else steps
            changes_plant = line.startswith(("preset", "defaults"))
            if isinstance(firmware.ask(line), str) or changes_plant and isinstance(firmware.ask(f"set arith {arith}"), str):
                return [f"refused: {line}"]
            firmware.ask(f"set substeps {substeps} tick {9600 // substeps}")
            first = steps - steps // pieces * (pieces - 1)
            for grant in [first] + [steps // pieces] * (pieces - 1 if steps >= pieces else 0):
                done = firmware.ask(f"step {grant}")
                firmware.ask("stop")
            seen.append((done["step"], done["hash"]))
        status = firmware.ask("status")
    return seen + [status["caps"], status["saturations"], [float(done[name]) for name in ("x", "xd", "y", "yd")]]


def differences(seen, truth):
    """The first of them, in words."""
    return [f"{line}: {a} instead of {b}" for (line, _), a, b in zip(SCRIPT, seen, truth) if a != b][:3]


def own_arithmetic(where):
    """The one that the board starts with."""
    with Firmware(where) as firmware:
        return firmware.ask("get arith")["arith"]


def go(where, arith):
    try:
        return hashes(where, arith, 64, pieces=2, limit_s=600)
    except Silence as silence:
        return [str(silence)]


def main():
    boards = sorted(set(COMMANDS) - {"board", "host"})
    truths, failed = {}, False
    print("board arith steps hash", flush=True)

    def tell(where, arith, seen):
        nonlocal failed
        truth = truths.setdefault(arith, seen)
        is_whole = len(seen) == len(SCRIPT) + 3
        hash_of_all = f"{zlib.crc32(repr(seen).encode()):08x}" if is_whole else "-"
        print(where, arith, sum(steps for _, steps in SCRIPT) if is_whole else 0, hash_of_all, flush=True)
        if seen != truth or not is_whole:
            failed = True
            print("\n".join(differences(seen, truth) or seen[-1:]), file=sys.stderr, flush=True)

    for arith in ("f32", "q27"):
        tell("host", arith, go("host", arith))
    with concurrent.futures.ThreadPoolExecutor(max_workers=2) as pool:
        jobs = {pool.submit(go, where, arith): (where, arith) for arith in ("f32", "q27") for where in boards}
        for job in concurrent.futures.as_completed(jobs):
            tell(*jobs[job], job.result())
    return failed


if __name__ == "__main__":
    sys.exit(main())
