#!/usr/bin/env python3
"""The link beside the console, a STEP that is sent twice, and the frames of PROTOCOL.md. Its bits are lockstep.t's."""
import contextlib
import os
import re
import shutil
import struct
import sys
import tempfile
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from controller import FORCE, KEEP, REQUESTS, SOURCES, TYPES, Controller, unwire, wire  # noqa: E402
from firmware import Firmware, Tap  # noqa: E402

CUT = 4
tap = Tap()
folder = tempfile.mkdtemp(prefix="squeal-link-")
paths = (os.path.join(folder, str(number)) for number in range(1000))


@contextlib.contextmanager
def linked(where, preset="brake", **values):
    """(controller, firmware) with the preset and these values in force, at step 0."""
    path = next(paths)
    with Firmware(where, limit_s=120, link=path) as firmware:
        controller = Controller(path, limit_s=120)
        controller.ask("HELLO", 1, 0)
        controller.preset(preset)
        controller.set(arith=arith, **values)
        try:
            yield controller, firmware
        finally:
            controller.close()


def own_arithmetic():
    """The board's, which the host is to use as well."""
    with Firmware("board") as firmware:
        return ["f32", "q27"].index(firmware.ask("get arith")["arith"])


arith = own_arithmetic()

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

# --- The frames of the document -------------------------------------------------------------------------------------
with open(os.path.join(SOURCES, "protocol", "PROTOCOL.md"), encoding="utf-8") as page:
    worked = re.findall(r"^    ([<>]) ((?:[0-9a-f]{2} ?)+)(\.\.\.)?", page.read(), re.MULTILINE)
path = next(paths)
with Firmware("host", link=path):
    controller = Controller(path)
    wrong, count = [], 0
    for side, text, is_cut in worked:
        said = bytes.fromhex(text)
        if side == ">":
            controller.send(said)
            count += 1
        else:
            controller.any_frame()
            heard = controller.raw[:len(said)] if is_cut else controller.raw
            if heard != said:
                wrong.append(f"{heard.hex(' ')} instead of {text}")
tap.check(count >= len(TYPES) and not wrong, f"{len(worked)} frames of the document are those on the line", *wrong)
asked = {unwire(bytes.fromhex(text)[:-1])[0] for side, text, _ in worked if side == ">"}
tap.check(set(TYPES.values()) <= asked, "every type of request is among them", str(set(TYPES.values()) - asked))

shutil.rmtree(folder)
tap.finish()
