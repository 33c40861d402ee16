"""A firmware and a controller at its link, and what the scripts about the two share."""
import contextlib
import os
import random
import shutil
import socket
import tempfile

from controller import DISC, FORCE, KEEP, PRESSURE, PROFILE, VEHICLE, Controller
from firmware import Firmware

LIMIT_S = 120.0


def own_arithmetic():
    """The board's, which the host is to use as well."""
    with Firmware("board") as firmware:
        return ["f32", "q27"].index(firmware.ask("get arith")["arith"])


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class Pairs:
    """Pairs with one number format, each on a line of its own."""

    def __init__(self):
        self.arithmetic = own_arithmetic()
        self.folder = tempfile.mkdtemp(prefix="squeal-pair-")
        self.paths = (os.path.join(self.folder, str(number)) for number in range(1000))

    @contextlib.contextmanager
    def linked(self, where, line="unix", preset="brake", number_format=None, **values):
        """(controller, firmware) with the preset and these values in force, at step 0."""
        link = {"unix": lambda: next(self.paths), "tcp": lambda: f"tcp:{free_port()}", "pty": lambda: "pty"}[line]()
        with Firmware(where, limit_s=LIMIT_S, link=link) as firmware:
            controller = Controller(firmware.pty or link, LIMIT_S)
            controller.ask("HELLO", 1, 0)
            controller.preset(preset)
            controller.set(arith=self.arithmetic if number_format is None else number_format, **values)
            controller.ask("RESET")
            try:
                yield controller, firmware
            finally:
                controller.close()

    def close(self):
        shutil.rmtree(self.folder, ignore_errors=True)


def demand(dice: random.Random):
    """Random force and speed, or what they were, or back to the profiles."""
    load_kind, speed_kind = dice.choice([KEEP, KEEP, PROFILE, FORCE, PRESSURE]), dice.choice([KEEP, KEEP, PROFILE, DISC, VEHICLE])
    load = {FORCE: dice.uniform(-100, 13000), PRESSURE: dice.uniform(0, 4e6)}.get(load_kind, 0.0)
    speed = {DISC: dice.uniform(-0.1, 1), VEHICLE: dice.uniform(0, 3)}.get(speed_kind, 0.0)
    return load_kind, load, speed_kind, speed
