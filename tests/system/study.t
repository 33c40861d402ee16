#!/usr/bin/env python3
"""Maps, borders and shares made by the device: the same lines on the host and on the board in both arithmetics, beside a
plant that steps on as if nothing were; and the same numbers over the link, beside a controller."""
import math
import os
import shutil
import struct
import sys
import tempfile
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from controller import FORCE, NO_PARAMETER, SYMBOLS, VERDICT, Controller  # noqa: E402
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

# --- Over the link --------------------------------------------------------------------------------------------------
WORDS = {"propensity": "unknown quiet watch squeal".split(), "predicted": "unknown quiet watch squeal".split(),
         "end": "none whole squealed decayed diverged grew".split(), "quiets": "none down up any".split(),
         "band": "none groan squeal".split(), "now": "quiet squeal".split(), "error": {7: "out-of-scale"}}
folder = tempfile.mkdtemp(prefix="squeal-study-")
WHOLE, SPAN = 1, (100, 40, 0)


def is_said(name, value, said):
    """Is the link's number the console's word?"""
    if name in WORDS:
        return WORDS[name][value] == said
    if isinstance(value, int):
        return value == int(said)
    if said in (None, "none", "nan"):
        return math.isnan(value)
    heard = struct.unpack("<f", struct.pack("<f", float(said)))[0]
    return math.isclose(value, heard, rel_tol=1e-5 if name in ("below", "above") else 0.0)


def differences(told, line):
    """The fields of a frame that are not those of the console's line."""
    said = fields(line)
    keys = [name for name in told if name in said or name.startswith(("below", "above"))]
    return [f"{name}={told[name]} instead of {said.get(name)}" for name in keys if not is_said(name, told[name], said.get(name))]


def both(where):
    """The console's map and border, and the link's."""
    path = os.path.join(folder, where)
    with Firmware(where, limit_s=120, link=path) as firmware:
        controller = Controller(path, limit_s=120)
        firmware.ask("preset brake")
        firmware.ask("step 20000")
        firmware.send("scan N1 1000 30000 3 log alpha -0.08 -0.03 2 transient 100")
        lines, first, second = [firmware.answer()] + firmware.body, SYMBOLS.index("N1"), SYMBOLS.index("alpha")
        promised = controller.ask("SCAN", first, 1, 1000.0, 30000.0, 3, second, 0, -0.08, -0.03, 2, *SPAN)
        *points, end = controller.study_end()
        tap.check(promised == len(points) == 6 and [point["point"] for point in points] == list(range(6)),
                  f"{where}: a map comes by itself")
        wrong = [text for point, line in zip([end] + points, lines) for text in differences(point, line)]
        tap.check(not wrong and points[5]["error"] == 7 and fields(lines[3])["N1"] == f"{points[2]['first']:g}",
                  f"{where}: with the numbers of the console's", *wrong[:5])
        firmware.send("margin N1 within 2")
        lines = [firmware.answer()] + firmware.body
        tap.check(controller.ask("MARGIN", first, 2.0, 1600, 40, 0) == 1, f"{where}: one border is promised")
        border, end = controller.study_end()
        wrong = differences(end, lines[0]) + differences(border, lines[1])
        tap.check(not wrong and border["parameter"] == first and abs(border["below"] - 2000) < 10,
                  f"{where}: and is the console's", *wrong)
        word, verdict = firmware.ask("verdict"), dict(zip(VERDICT, controller.ask("VERDICT")))
        tap.check(not differences(verdict, " ".join(map("=".join, word.items()))), f"{where}: so is the verdict")
        tap.check(controller.ask("SELFTEST") == (9, 0, 0), f"{where}: the device's own tests pass")
        controller.ask("SCAN", first, 0, 1000.0, 3000.0, 100, NO_PARAMETER, 0, 0.0, 0.0, 0, 360, 40, WHOLE)
        busy = firmware.ask("scan N1 1 2 2"), controller.refusal("MARGIN", NO_PARAMETER, 2.0, 0, 8, 0).reason
        controller.ask("RUN")
        controller.ask("STOP")
        *points, end = controller.study_end()
        tap.check(busy[0].startswith("error busy ") and busy[1] == "busy", f"{where}: one study at a time", *busy)
        tap.check(end["reason"] == 17 and end["results"] == len(points) < 100 and controller.status()["state"] == 1,
                  f"{where}: a STOP ends the study, and not the plant", str(end))
        controller.ask("STOP")
        tap.check(controller.status()["state"] == 0, f"{where}: which the next one halts")
        controller.close()


def lockstep(where, has_study):
    """The hash where a controller gets in 300 turns, and how many sets were tried meanwhile."""
    path = os.path.join(folder, f"{where}-{has_study}")
    with Firmware(where, limit_s=120, link=path):
        controller = Controller(path, limit_s=120)
        controller.preset("brake")
        controller.set(arith=["f32", "q27"].index(arith))
        if has_study:
            controller.ask("SCAN", SYMBOLS.index("N1"), 0, 1000.0, 3000.0, 100, NO_PARAMETER, 0, 0.0, 0.0, 0, 0, 8, WHOLE)
        for turn in range(300):
            word = controller.step(7, FORCE, 2000.0 + turn)["hash"]
        controller.close()
        return word, len(controller.results)


for where in ("host", "board"):
    both(where)
truth = lockstep("host", False)[0]
for where in ("host", "board"):
    word, tried = lockstep(where, True)
    tap.check(word == truth and tried > 0, f"{where}: a controller's plant has the same bits beside a map", f"{tried} points")
shutil.rmtree(folder)
tap.finish()
