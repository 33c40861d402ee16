#!/usr/bin/env python3
"""Every board there is boots, says what it is, passes its own tests and makes the realistic brake squeal, with the host's bits."""
import os
import subprocess
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from firmware import COMMANDS, Firmware, Tap  # noqa: E402

CORES = {"mps2-an385": "cortex-m3", "mps2-an386": "cortex-m4f", "mps2-an500": "cortex-m7", "mps3-an547": "cortex-m55",
         "netduinoplus2": "cortex-m4f", "host": "posix"}
STEPS = 5000
SQUEAL_STEPS = 40000
tap = Tap()


def brake(firmware, arith):
    """The state's hash after so many steps, and in the board's own arithmetic what it says of it later."""
    own = firmware.ask("get arith")["arith"]
    firmware.ask("preset brake")
    firmware.ask(f"set arith {arith}")
    firmware.ask("set substeps 16 tick 1000")
    early = firmware.ask(f"step {STEPS}")
    if arith != own:
        return early["hash"], None
    return early["hash"], (firmware.ask(f"step {SQUEAL_STEPS - STEPS}")["hash"], firmware.ask("verdict"))


def truth_of(arith):
    with Firmware("host") as firmware:
        if arith == "q27":
            firmware.ask("set arith q27")
        return brake(firmware, arith)


truths = {arith: truth_of(arith) for arith in ("f32", "q27")}
for board in sorted(set(COMMANDS) - {"board"}):
    core = CORES.get(board)
    has_fpu = core != "cortex-m3"
    with Firmware(board, limit_s=120) as firmware:
        identity = firmware.ask("id")
        tap.check(identity["board"] == board and core in (None, identity["core"]) and identity["link"] == "yes" and
                  identity["fpu"] == ("yes" if has_fpu else "no") and identity["arith"] == ("f32" if has_fpu else "q27") and
                  identity["emulated"] == ("no" if board == "host" else "yes"), f"{board} says what it is", str(identity))
        tested = firmware.ask("selftest")
        tap.check(isinstance(tested, dict) and tested["failed"] == "0", f"{board} passes its own tests", str(tested), *firmware.body)
        for arith, (hash_early, later) in truths.items():
            seen, squeal = brake(firmware, arith)
            tap.check(seen == hash_early, f"{board}: the host's bits in {arith} at step {STEPS}", f"{seen} instead of {hash_early}")
            if squeal:
                tap.check(squeal == later and squeal[1]["propensity"] == "squeal", f"{board}: the brake squeals as on the host",
                          f"{squeal} instead of {later}")
            firmware.ask("defaults")
    where = "host" if board == "host" else f"qemu:{board}"
    told = subprocess.run([os.environ["TOOL"], "id", "--port", where], capture_output=True, text=True, timeout=60, check=False)
    wanted = f"{'with' if has_fpu else 'without'} FPU"
    tap.check(told.returncode == 0 and board in told.stdout and wanted in told.stdout, f"{board} says so on the link", told.stdout, told.stderr)
tap.finish()
