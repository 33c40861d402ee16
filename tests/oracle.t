#!/usr/bin/env python3
"""The oracle against closed forms, golden rows, exact symmetries, and a naive integrator
whose step goes to zero."""
import csv
import glob
import math
import os
import subprocess
import tempfile

from tap import Tap

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
LIMIT_S = 60
PLANT = "m c v0 mus alpha ke kt k cn ntype N0 N1 t1 t2 contact mumin x0 xd0 y0 yd0".split()
SMOOTH = dict(m=.3, c=.01, v0=1., mus=.3, alpha=0., ke=1., kt=1., k=1., N0=1., mumin=-1e30)
GOLDEN = {  # table: rows, each for something that the others lack
    "paper.csv": "fig5_N1 fig5_N5 fig6_a0.1 fig7_ke5000_muclamp0 fig10a_N5_mu0.4",
    "options.csv": "soft_05 brake_05 equilibrium_2 step_down_contact1 brake_step_down_contact2 ramp_5.2 "
                   "fluctuating_load mu_floor disc_reversed rising_friction subharmonic_tongue normal_damping "
                   "brake_3000N",
}
COLUMNS = "x_20 v_20 y_20 xmax_20 xmin_20 vmax_20 vmin_20 stick_20".split()
tap = Tap()


def read(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def solve(oracle, folder, rows, *options):
    """Rows are dicts of numbers or text; what is absent is zero."""
    before, after = os.path.join(folder, "in.csv"), os.path.join(folder, "out.csv")
    with open(before, "w", newline="") as file:
        more = [name for name in ("ntrans", "nwin") if name in rows[0]]
        print(",".join(["case"] + PLANT + more), file=file)
        for i, row in enumerate(rows):
            values = [row.get("case", str(i))] + [row.get(name, 0) for name in PLANT + more]
            print(",".join(v if isinstance(v, str) else repr(v) for v in values), file=file)
    subprocess.run([oracle, "--cases", before, "--out", after, *options], check=True, timeout=LIMIT_S,
                   stderr=subprocess.PIPE)
    return read(after)


def period_of(plant):
    return 2 * math.pi * math.sqrt(plant["m"] / plant["ke"])


def closed_form(plant, t):
    """x at t for alpha = 0 and permanent slip from rest: x'' + 2 d x' + W2 x = mu N/m (1 - cos wn t)."""
    m, d, w = plant["m"], plant["c"] / (2 * plant["m"]), math.sqrt(plant["ke"] / plant["m"])
    square = (plant["k"] + plant["kt"]) / m
    force = plant["mus"] * plant["N0"] / m
    wide = (square - w * w) ** 2 + (2 * d * w) ** 2
    a, b = -force * (square - w * w) / wide, -force * 2 * d * w / wide  # a cos wn t + b sin wn t
    own = math.sqrt(square - d * d)
    p = -(force / square + a)
    q = (d * p - b * w) / own
    return force / square + a * math.cos(w * t) + b * math.sin(w * t) + \
        math.exp(-d * t) * (p * math.cos(own * t) + q * math.sin(own * t))


def check_closed_forms(oracle, folder):
    plants = [SMOOTH, dict(SMOOTH, ke=.5, c=.1), dict(SMOOTH, m=.25, ke=1e8, kt=4e7, k=7e6, c=60., N0=700., v0=2.)]
    for plant, row in zip(plants, solve(oracle, folder, plants, "--horizon", "100")):
        period = period_of(plant)
        for column, periods in (("x_20", 20), ("x_100", 100)):
            exact = closed_form(plant, periods * period)
            error = abs(float(row[column]) - exact) / float(row["xmax_20"])
            tap.check(error < 2e-9, "slip without slope, ke %g: %s has its closed form (%.1e)" % (plant["ke"], column, error))

    damped = dict(SMOOTH, N0=0., cn=.05, y0=1., x0=.1, mus=0.)  # free decay in both directions
    row = solve(oracle, folder, [damped], "--horizon", "20")[0]
    d, t = .05 / .6, 20 * period_of(damped)
    own = math.sqrt(1 / .3 - d * d)
    exact = math.exp(-d * t) * (math.cos(own * t) + d / own * math.sin(own * t))
    tap.check(abs(float(row["y_20"]) - exact) < 1e-8 * abs(exact), "y decays as its closed form says")

    stuck = dict(SMOOTH, v0=.001, y0=100., N0=100., xd0=.001)  # rides with the disc until k x = mu_s N would break it
    row = solve(oracle, folder, [stuck], "--horizon", "20")[0]
    error = abs(float(row["x_20"]) - .001 * 20 * period_of(stuck))
    tap.check(row["stick_20"] == "1" and error < 1e-9, "a stuck pad rides along")


def error_of(row, truth, column):
    """Against the largest value of its kind; shares as they are."""
    kind = {"x": ("xmax_20", "xmin_20"), "v": ("vmax_20", "vmin_20"), "y": ("ymax",), "s": ()}[column[0]]
    scale = max([abs(float(truth[name])) for name in kind] or [1.])
    return abs(float(row[column]) - float(truth[column])) / scale


def check_golden(oracle, folder):
    for table, names in GOLDEN.items():
        truth = {row["case"]: row for row in read(os.path.join(ROOT, "tests", "golden", table))}
        wanted = [truth[name] for name in names.split()]
        for row, old in zip(solve(oracle, folder, wanted, "--horizon", "20"), wanted):
            worst = max(error_of(row, old, column) for column in COLUMNS)
            tap.check(worst < 1e-7, "golden %s over 20 periods (%.1e)" % (old["case"], worst))


def check_attractors(oracle, folder):
    names = "fig5_N2 fig10a_N5_mu0.4 equilibrium_1 brake_1500N disc_reversed step_down_contact1".split()
    truth = {row["case"]: row for table in GOLDEN for row in read(os.path.join(ROOT, "tests", "golden", table))}
    wanted = [dict(truth[name], ntrans=1500, nwin=100) for name in names]
    for row, name in zip(solve(oracle, folder, wanted, "--jobs", "2"), names):
        old = truth[name]
        xpp, exact = float(row["xpp"]), float(old["xpp"])
        shares = max(abs(float(row[c]) - float(old[c])) for c in ("stick", "slipminus"))
        stretch = abs(float(row["lle"]) - float(old["lle"])) * float(row["T_n"])
        is_near = abs(xpp - exact) <= 1e-5 * exact + 1e-12 and shares < 1e-4 and stretch < 2e-3
        tap.check(row["class"] == old["class"] and is_near,
           "golden %s settles: %s, xpp %.9g" % (name, row["class"], xpp))


def check_symmetries(oracle, folder):
    base = dict(SMOOTH, alpha=-.02, N0=5., kt=.5, k=.5)
    mirrored = dict(base, v0=-1.)
    larger = dict(base, v0=2., N0=10., alpha=-.01)
    rows = [float(row["x_20"]) for row in solve(oracle, folder, [base, mirrored, larger], "--horizon", "20")]
    tap.check(abs(rows[0] + rows[1]) < 1e-9, "the mirrored disc mirrors the motion")
    tap.check(abs(2 * rows[0] - rows[2]) < 3e-9, "twice load and speed at the same N alpha: twice the motion")


def check_divergence(oracle, folder):
    row = solve(oracle, folder, [dict(SMOOTH, alpha=-.1, x0=3.5)])[0]
    is_dated = abs(float(row["t_v10"]) - 1.7443185) < 2e-6  # RK4 with steps of 2e-5 s
    tap.check(row["class"] == "diverging" and row["xpp"] == "nan" and is_dated, "divergence is seen and dated")


def check_naive_limit(oracle, folder):
    steps = (512, 4096, 32768)
    steep = dict(SMOOTH, alpha=-.002, N0=5.)
    released = dict(SMOOTH, alpha=-.002, ntype=1, N0=3., N1=1., t1=32.6937, contact=1)
    for name, plant in (("stick-slip", steep), ("load step, no pull", released)):
        truth = solve(oracle, folder, [plant], "--horizon", "20")[0]
        errors = []
        for n in steps:
            row = solve(oracle, folder, [plant], "--naive", str(n))[0]
            errors.append(max(error_of(row, truth, c) for c in ("x_20", "v_20", "xmax_20", "xmin_20", "vmin_20")))
        shrinks = all(b < a / 3 for a, b in zip(errors, errors[1:]))
        tap.check(shrinks and errors[-1] < 2e-3,
           "naive RK4 tends to the oracle, %s: %s" % (name, " ".join("%.1e" % e for e in errors)))


def check_refusals(oracle, folder):
    for name, row in (("m", dict(SMOOTH, m=-1.)), ("ntype", dict(SMOOTH, ntype=7)), ("N0", dict(SMOOTH, N0="lots"))):
        try:
            solve(oracle, folder, [row], "--horizon", "1", "--jobs", "2")
            tap.check(False, "a wrong %s is refused" % name)
        except subprocess.CalledProcessError:
            tap.check(True, "a wrong %s is refused" % name)


def main():
    with tempfile.TemporaryDirectory() as folder:
        oracle = os.environ.get("ORACLE")
        if not oracle:
            oracle = os.path.join(folder, "oracle")
            sources = sorted(glob.glob(os.path.join(ROOT, "tests", "oracle", "*.c")))
            options = ["-std=c99", "-O2", "-ffp-contract=off", "-D_POSIX_C_SOURCE=200809L"]
            subprocess.run([os.environ.get("CC", "cc"), *options, "-o", oracle, *sources, "-lm"], check=True,
                           timeout=LIMIT_S)
        for check in (check_closed_forms, check_golden, check_attractors, check_symmetries, check_divergence,
                      check_naive_limit, check_refusals):
            check(oracle, folder)
    tap.finish()


if __name__ == "__main__":
    main()
