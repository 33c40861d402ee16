"""A brake controller under test, on a plant that squeals: run by `pytest`, or without it by `python3 example_test.py`.

PORT names the plant: the firmware as a process of this machine by default, qemu:mps2-an386, or a board at /dev/ttyUSB0.
"""
import os
import unittest

import squeal


def back_off(force_n, state):
    """The controller under test: takes a tenth of the brake force away as long as the brake squeals."""
    return 0.9 * force_n if state.propensity == "squeal" else force_n


class BackOff(unittest.TestCase):
    def setUp(self):
        self.plant = squeal.connect(os.environ.get("PORT", "host"))
        self.addCleanup(self.plant.close)
        self.plant.preset("brake")
        self.plant.set(substeps=8)  # steps a tick: faster than one by one, and the same bits

    def brake(self, controller, force_n=3000.0, turns=24):
        """Closes the loop, a turn every 2048 steps (11 ms, 32 periods of the pad): force and state after the last."""
        for _ in range(turns):
            state = self.plant.step(2048, N=force_n)
            force_n = controller(force_n, state)
        return force_n, state

    def test_squeals_if_nobody_reacts(self):
        _, state = self.brake(lambda force_n, state: force_n)
        self.assertEqual(state.propensity, "squeal")

    def test_is_quiet_and_still_brakes(self):
        force_n, state = self.brake(back_off)
        self.assertEqual(state.propensity, "quiet")
        self.assertGreater(force_n, 1000.0)


if __name__ == "__main__":
    unittest.main()
