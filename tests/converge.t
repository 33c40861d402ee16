#!/usr/bin/env python3
"""How the error falls with the step: fourth order for located events, whatever sticks; the floors of the arithmetics."""
import csv
import math
import os
import subprocess
import tempfile

from tap import Tap

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
PROGRAM = os.environ.get("CONVERGE") or os.path.join(ROOT, "build", "tests", "converge")
LIMIT_S = 120
tap = Tap()


def read(path):
    """errors[case][method][steps]"""
    with open(path, newline="") as file:
        rows = [row for row in csv.reader(file) if row]
    names, errors = rows[0][2:], {}
    for case, steps, *values in rows[1:]:
        for name, value in zip(names, values):
            errors.setdefault(case, {}).setdefault(name, {})[int(steps)] = float(value)
    return errors


def order(row, first, last):
    return math.log2(row[first] / row[last]) / math.log2(last / first)


with tempfile.TemporaryDirectory() as folder:
    done = subprocess.run([PROGRAM, "--out", folder], timeout=LIMIT_S, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    tap.check(done.returncode == 0, "the table is made", done.stdout[-500:])
    errors = read(os.path.join(folder, "converge.csv"))
    for case, of in errors.items():
        fine, naive, tanh = of["event-double"], of["naive-double"], of["tanh-double"]
        tap.check(3.8 < order(fine, 64, 1024) < 4.2, f"{case}: events located in double: fourth order", str(fine))
        tap.check(fine[4096] < 5e-11, f"{case}: down to 5e-11 and below", str(fine))
        for name in ("f32", "q27"):
            tap.check(abs(of[name][64] / fine[64] - 1) < 0.2, f"{case}: {name} at 64 steps errs as its method does", str(of[name]))
            tap.check(of[name][1024] < {"f32": 1e-5, "q27": 1e-4}[name], f"{case}: {name}: its floor", str(of[name]))
        tap.check(of["f32-exact"][64] < 1.1 * fine[64], f"{case}: normal exact is no worse", str(of["f32-exact"]))
        if case != "slip":
            tap.check(order(naive, 64, 4096) < 1.5 and naive[4096] > 1e-3, f"{case}: the raw sign is of first order", str(naive))
            tap.check(tanh[4096] > 5e-3, f"{case}: a smoothed sign has a floor", str(tanh))
    refused = subprocess.run([PROGRAM], timeout=LIMIT_S, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    tap.check(refused.returncode == 2 and "usage" in refused.stdout, "no folder: usage")
tap.finish()
