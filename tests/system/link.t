#!/usr/bin/env python3
"""The link beside the console, a STEP that is sent twice, and the frames of PROTOCOL.md. Its bits are lockstep.t's."""
import os
import re
import struct
import sys
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from controller import FORCE, KEEP, REQUESTS, SOURCES, TYPES, Controller, unwire, wire  # noqa: E402
from firmware import Firmware, Tap  # noqa: E402
from pair import Pairs  # noqa: E402

CUT = 4
tap = Tap()
pairs = Pairs()
linked = pairs.linked

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
    document = page.read()
worked = re.findall(r"^    ([<>]) ((?:[0-9a-f]{2}(?:\*\d+)? ?)+)(\.\.\.)?", document, re.MULTILINE)


def told(words):
    """Bytes as the document writes them: 01*20 is twenty times 01."""
    return b"".join(bytes.fromhex(word[:2]) * int(word[3:] or 1) for word in words.split())


path = next(pairs.paths)
with Firmware("host", link=path):
    controller = Controller(path)
    wrong, count = [], 0
    for side, text, is_cut in worked:
        said = told(text)
        if side == ">":
            controller.send(said)
            count += 1
        else:
            controller.any_frame()
            heard = controller.raw[:len(said)] if is_cut else controller.raw
            if heard != said:
                wrong.append(f"{heard.hex(' ')} instead of {text}")
tap.check(count >= len(TYPES) and not wrong, f"{len(worked)} frames of the document are those on the line", *wrong)
image = document[document.index("The image,"):document.index("A frame of the detector:")]
sizes = re.findall(r"^\| (\d+) \| ", image, re.MULTILINE)
with linked("host") as (controller, _):
    run = controller.snapshot()
tap.check(sum(map(int, sizes)) == len(run), "the fields of the image are as long as it is", str(sizes))
asked = {unwire(told(text)[:-1])[0] for side, text, _ in worked if side == ">"}
tap.check(set(TYPES.values()) <= asked, "every type of request is among them", str(set(TYPES.values()) - asked))

pairs.close()
tap.finish()
