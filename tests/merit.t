#!/usr/bin/env python3
"""The detector's figures of merit on a few random cases, and that they can be bad: a truth that is turned round fails."""
import csv
import hashlib
import os
import subprocess
import tempfile

from tap import Tap

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
LIMIT_S = 120
COUNT, SEED = 60, 60
DIGEST = "5d6edd3e20f934a218794b2f7fb9a1fdc1010f603ee9a46efd10e65d3a112448"  # of the cases: the same on every machine
tap = Tap()


def run(*words):
    return subprocess.run(words, timeout=LIMIT_S, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)


def read(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def write(path, rows):
    with open(path, "w", newline="") as file:
        writer = csv.DictWriter(file, rows[0].keys(), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


class Bench:
    def __init__(self, folder):
        build = os.path.join(ROOT, "build", "tests")
        self.merit = os.environ.get("MERIT") or os.path.join(build, "merit")
        self.oracle = os.environ.get("ORACLE") or os.path.join(build, "oracle")
        self.folder = folder

    def path(self, name):
        return os.path.join(self.folder, name)

    def draw(self, name, number, seed):
        return run(self.merit, "cases", "--count", str(number), "--seed", str(seed), "--out", self.path(name))

    def check(self, rows, arith="f32"):
        write(self.path("table.csv"), rows)
        return run(self.merit, "check", "--truth", self.path("table.csv"), "--disagree", self.path("disagree.csv"),
                   "--arith", arith, "--jobs", "2")


def check_cases(bench):
    drawn = bench.draw("cases.csv", COUNT, SEED)
    tap.check(drawn.returncode == 0 and drawn.stdout.startswith("%d random cases of seed %d" % (COUNT, SEED)),
       "cases are drawn", drawn.stdout)
    with open(bench.path("cases.csv"), "rb") as file:
        digest = hashlib.sha256(file.read()).hexdigest()
    tap.check(digest == DIGEST, "a seed gives the same table everywhere", digest)
    bench.draw("other.csv", COUNT, SEED + 1)
    tap.check(read(bench.path("cases.csv"))[0] != read(bench.path("other.csv"))[0], "another seed another")
    kinds = [row["case"].split("-")[0] for row in read(bench.path("cases.csv"))]
    tap.check(all(kinds.count(kind) == COUNT // 5 for kind in set(kinds)) and len(set(kinds)) == 5, "five kinds in equal parts")


def check_figures(bench, truth):
    good = bench.check(truth, "f32 q27")
    tap.check(good.returncode == 0 and "FAILED" not in good.stdout, "in both arithmetics all figures are good", good.stdout)
    whole = sum(line.startswith("all ") for line in good.stdout.splitlines())
    tap.check(whole == 5, "each has its table", good.stdout)


def check_failures(bench, truth):
    loud = [row for row in truth if row["class"] == "stickslip-p1"]
    rest = [row for row in truth if row["class"] == "rest"]
    tap.check(len(loud) > 3 and len(rest) > 3, "there is squeal, and there is rest")
    bad = bench.check([dict(row, **{"class": "stickslip-p1"}) for row in rest] + loud)
    tap.check(bad.returncode == 1 and "FAILED: squeal was missed" in bad.stdout, "rest called stick-slip is missed squeal",
       bad.stdout)
    named = [(row["case"], row["why"]) for row in read(bench.path("disagree.csv"))]
    tap.check(all((row["case"], "miss") in named for row in rest), "each such row is written down")
    bad = bench.check([dict(row, **{"class": "rest"}) for row in loud] + rest)
    tap.check(bad.returncode == 1 and "FAILED: more than 0.5 % false alarms" in bad.stdout,
       "stick-slip called rest is a false alarm", bad.stdout)
    bad = bench.check([dict(row, **{"class": "stickslip-p2"}) for row in loud] + rest)
    tap.check(bad.returncode == 1 and "FAILED: fewer than 95 %" in bad.stdout, "another period is another class", bad.stdout)
    bad = bench.check([dict(row, alpha="nan") for row in loud])
    tap.check(bad.returncode == 1 and "FAILED: a set was refused" in bad.stdout, "a set that cannot be had is a failure",
       bad.stdout)
    for name, rows in (("class", [dict(loud[0], **{"class": "humming"})]), ("kind", [dict(loud[0], case="odd-1")])):
        bad = bench.check(rows)
        tap.check(bad.returncode == 2 and bad.stdout.startswith("merit: "), "an unknown %s is refused" % name, bad.stdout)


def main():
    with tempfile.TemporaryDirectory() as folder:
        bench = Bench(folder)
        check_cases(bench)
        solved = run(bench.oracle, "--cases", bench.path("cases.csv"), "--out", bench.path("truth.csv"), "--jobs", "2",
                     "--progress", "1")
        tap.check(solved.returncode == 0 and "min left" in solved.stdout, "the oracle solves them, and says how far it is",
           solved.stdout)
        truth = read(bench.path("truth.csv"))
        check_figures(bench, truth)
        check_failures(bench, truth)
    tap.finish()


if __name__ == "__main__":
    main()
