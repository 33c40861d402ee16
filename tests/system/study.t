#!/usr/bin/env python3
"""Maps, borders and shares made by the device: the same lines on the host and on the board in both arithmetics, beside a
plant that steps on as if nothing were."""
import os
import sys
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from firmware import Firmware, Tap, fields  # noqa: E402

LINES = [
    "scan N1 1000 5000 3 alpha -0.08 -0.03 2 transient 1000",
    "scan spp 16 128 4",
    "scan N1 3000 30000 2 log transient 50",
    "margin N1",
    "occurrence 6 seed 4",
]
tap = Tap()


def said(where, arith):
    """Everything that the studies print for the brake."""
    with Firmware(where, limit_s=120) as firmware:
        firmware.ask("preset brake")
        firmware.ask(f"set arith {arith}")
        heard = []
        for line in LINES:
            firmware.send(line)
            answer = firmware.answer()
            heard += firmware.body + [answer]
    return heard


for arith in ["f32", "q27"]:
    host, board = said("host", arith), said("board", arith)
    tap.check(host == board, f"{arith}: host and board print the same lines",
              *[f"{b} instead of {a}" for a, b in zip(host, board) if a != b][:3])
    points = [fields(line) for line in host if line.startswith("point ")]
    loud = [point["propensity"] for point in points[:6]]
    tap.check(loud == ["quiet", "squeal", "squeal", "quiet", "quiet", "squeal"],
              f"{arith}: the map has both sides of N |alpha| = c", *loud)
    margins = [fields(line) for line in host if line.startswith("margin ")]
    tap.check(len(margins) == 1 and abs(float(margins[0]["below"]) - 2000) < 10 and margins[0]["quiets"] == "down",
              f"{arith}: the brake's border lies at 2000 N within 0.5 %", *margins)
    tap.check(any("error=out-of-scale" in line for line in host), f"{arith}: a point beyond the scale is told")

# Beside a plant in free run, with its stream on: not a bit of it changes, and a stop ends the map alone.
with Firmware("board", limit_s=120) as board, Firmware("host", limit_s=120) as host:
    board.ask("preset fig5-n10")
    arith = board.ask("get arith")["arith"]
    board.ask("set tick 2000")
    board.ask("run")
    first = board.ask("scan N0 1 9 3 mu_s 0.2 0.3 2 transient 100")
    during = int(board.ask("status")["step"])
    board.send("scan N0 1 9 100 mu_s 0.2 0.3 100 whole")
    time.sleep(0.5)
    board.send("stop")
    cut, answered = board.answer(), board.answer()
    after = int(board.ask("status")["step"])
    later = int(board.ask("status")["step"])
    stopped = board.ask("stop")
    status = board.ask("status")
    tap.check(first["trials"] == "6" and during > 0, "a map is made beside a plant in free run", str(first))
    tap.check(cut.startswith("error stopped trials=") and answered.startswith("ok stop step="), "a stop ends the map",
              cut, answered)
    tap.check(later >= after > during, "and not the plant", after, later)
    host.ask("preset fig5-n10")
    host.ask(f"set arith {arith} substeps 64 tick 1000")
    truth = host.ask(f"step {stopped['step']}")
    tap.check(truth["hash"] == status["hash"], "whose bits are those of a plant without a map beside it",
              f"{status['hash']} instead of {truth['hash']} at {stopped['step']}")
tap.finish()
