#!/usr/bin/env python3
"""Stands in for the firmware behind its console protocol, so that the host tool can be tested against every answer and
every failure. It computes nothing: the answers for a case come from the table that --cases names, a demo streams a sine.

  --cases FILE        table whose rows it recognises by their parameters
  --skew KEY=FACTOR   multiplies a field of its answers
  --say KEY=TEXT      replaces a field of its answers
  --refuse TEXT       answers error to lines that start with TEXT
  --die TEXT          complains on stderr and exits 3 at lines that start with TEXT
  --mute TEXT         says nothing any more from a line that starts with TEXT on
  --flood             says a lot before it reads each line
  --gap               loses samples of a demo and counts them
  --hide              loses samples of a demo and does not count them
  --emulated          says that it runs in an emulator
  --speechless        ends a demo without a verdict
  --lose N            loses the N-th point of a scan on the way
  --blur N            damages it on the way
  --cut N             cuts a scan short after so many points
  --slow              takes its time for a point of a scan, and listens for a stop
"""
import argparse
import csv
import math
import os
import select
import sys

DEFAULTS = {
    "m": 0.3, "c": 0.01, "ke": 1.0, "kt": 1.0, "k": 1.0, "cn": 0.0, "mu_s": 0.3, "alpha": -0.002, "mu_floor": -1e30,
    "contact": "bilateral", "load": "constant", "N0": 1.0, "N1": 0.0, "t1": 0.0, "t2": 0.0, "fN": 0.0,
    "speed": "constant", "v0": 1.0, "v1": 0.0, "tv1": 0.0, "tv2": 0.0, "x0": 0.0, "xd0": 0.0, "y0": 0.0, "yd0": 0.0,
    "spp": "64", "arith": "f32", "normal": "rk4", "method": "event", "v_max": 0.0, "N_max": 0.0,
    "substeps": 1.0, "tick": 1000.0,
}
RESTART = {"m", "ke", "cn", "contact", "x0", "xd0", "y0", "yd0", "spp", "arith", "normal", "method", "v_max", "N_max"}
LOADS = ["constant", "step", "ramp", "sine"]
CONTACTS = ["bilateral", "no_pull", "lift"]
UNITS = {"t": "[s]", "x": "[m]", "xd": "[m/s]", "y": "[m]", "yd": "[m/s]", "N": "[N]", "F": "[N]", "vr": "[m/s]"}
DEMO_STEPS = 4000
DEMO_PERIOD_S = 3.44e-4


def row_set(row):
    """The parameters that a row of the table asks for."""
    load = LOADS[int(row["ntype"])]
    values = {"m": "m", "c": "c", "v0": "v0", "mu_s": "mus", "alpha": "alpha", "ke": "ke", "kt": "kt", "k": "k",
              "cn": "cn", "N0": "N0", "x0": "x0", "xd0": "xd0", "y0": "y0", "yd0": "yd0", "mu_floor": "mumin"}
    wanted = {symbol: float(row[column]) for symbol, column in values.items()}
    wanted.update(load=load, contact=CONTACTS[int(row["contact"])])
    if load != "constant":
        wanted.update(N1=float(row["N1"]), t1=float(row["t1"]))
    if load == "ramp":
        wanted.update(t2=float(row["t2"]))
    if load == "sine":
        wanted.update(fN=float(row["t2"]))
    return dict(DEFAULTS, **wanted)


class Refused(Exception):
    pass


class Firmware:
    def __init__(self, options):
        self.options = options
        self.values = dict(DEFAULTS)
        self.step = 0
        self.drops = 0
        self.every = 0
        self.signals = []
        self.echo = True
        self.rows = []
        if options.cases:
            with open(options.cases, newline="") as file:
                self.rows = list(csv.DictReader(file))

    def say(self, line):
        sys.stdout.write(line + "\r\n")
        sys.stdout.flush()

    def answer(self, command, **fields):
        for change in self.options.skew or []:
            key, factor = change.split("=")
            if key in fields and command != "status":
                fields[key] = "%.9g" % (float(fields[key]) * float(factor))
        for change in self.options.say or []:
            key, text = change.split("=")
            if key in fields:
                fields[key] = text
        self.say(" ".join(["ok " + command] + ["%s=%s" % pair for pair in fields.items()]))

    def row(self):
        for row in self.rows:
            wanted = row_set(row)
            if all(self.values[key] == wanted[key] for key in wanted
                   if key not in ("spp", "normal", "method", "arith", "substeps", "tick")):
                return row
        raise Refused("error usage no row of the table has these parameters")

    def spp(self):
        return int(self.values["spp"])

    def period(self, row):
        return 2 * math.pi * math.sqrt(float(row["m"]) / float(row["ke"]))

    def fault_check(self, row):
        if row["class"] == "diverging" and self.step / self.spp() * self.period(row) > float(row["t_v10"]):
            raise Refused("error in-fault the plant left its domain and is frozen: reset")

    def do_set(self, words):
        if len(words) < 2 or len(words) % 2:
            raise Refused("error usage set <symbol> <value>")
        new = dict(self.values)
        for symbol, text in zip(words[::2], words[1::2]):
            if symbol not in DEFAULTS:
                raise Refused("error unknown-name " + symbol)
            new[symbol] = text if isinstance(DEFAULTS[symbol], str) else float(text)
        if not new["m"] > 0:
            raise Refused("error out-of-range m 1e-06 .. 1e+06")
        self.values = new
        is_reset = any(symbol in RESTART for symbol in words[::2])
        self.step = 0 if is_reset else self.step
        self.answer("set", generation=7, reset="yes" if is_reset else "no")

    def do_measure(self, words):
        row = self.row()
        self.step += int(words[0]) * self.spp()
        self.fault_check(row)
        fields = {"periods": words[0], "step": self.step, "t": "%.9g" % (self.step / self.spp() * self.period(row))}
        if self.step == 20 * self.spp():
            names = {"x": "x_20", "xd": "v_20", "xmax": "xmax_20", "xmin": "xmin_20", "vmax": "vmax_20",
                     "vmin": "vmin_20", "stick": "stick_20"}
        elif self.step == 100 * self.spp():
            names = {"x": "x_100", "xd": "v_100"}
        else:
            names = {"xpp": "xpp", "stick": "stick", "f_up": "f_up"}
        for key in ("x", "xd", "xmax", "xmin", "xpp", "vmax", "vmin", "stick", "slipminus", "f_up"):
            fields[key] = row[names[key]] if key in names else "nan"
        self.answer("measure", **fields)

    def do_step(self, words):
        if self.rows:
            self.step += int(words[0])
            self.fault_check(self.row())
        else:
            self.stream_to(self.step + int(words[0]), 2)
        self.answer("step", done=words[0], step=self.step, hash="%08x" % self.step)

    def do_verdict(self, words):
        row = self.row()
        is_loud = row["class"] == "diverging" or row["class"].startswith("limitcycle") or \
            any(1e-6 < float(row[share]) < 1 - 1e-6 for share in ("stick", "slipminus"))
        self.answer("verdict", propensity="squeal" if is_loud else "quiet", **{"class": row["class"]}, period=1,
                    predicted="squeal" if is_loud else "quiet", t_v10=row["t_v10"])

    def do_status(self, words):
        self.answer("status", state="ready", step=self.step, overruns=0, caps=0, saturations=0, drops=self.drops,
                    spp=self.spp(), C=0.018257, Z2=2, eps="nan", mu=0.3, V0=0.547, hash="%08x" % (self.step * 2654435761 % 2 ** 32))

    def do_list(self, words):
        for symbol, value in self.values.items():
            self.say("- %s = %s 1 [0 .. 1] live  a help text" % (symbol, value))
        self.answer("list")

    def do_stream(self, words):
        if words[0] == "off":
            self.every = 0
            self.answer("stream", off="yes")
            return
        self.signals = words[1].split(",")
        self.every = int(words[words.index("every") + 1])
        if self.values["tick"] * self.values["substeps"] > 900 * self.every:
            raise Refused("error line-overload smallest=2")
        self.answer("stream", every=self.every, line_bytes=90, load="40%", smallest=2)
        self.say("#" + ",".join(name + UNITS.get(name, "") for name in self.signals))

    def sample(self, step, act):
        phase = 2 * math.pi * step / self.spp()
        omega = 2 * math.pi / DEMO_PERIOD_S
        speed = 0.1 * (1 - step / DEMO_STEPS) if act == 5 else 0.1
        amplitude = 8e-6 * min(1.0, step / 1000)
        velocity = amplitude * omega * math.cos(phase)
        return {"step": step, "t": "%.9g" % (step / self.spp() * DEMO_PERIOD_S), "x": "%.9g" % (amplitude * math.sin(phase)),
                "xd": "%.9g" % velocity, "y": 3e-5, "yd": 0, "N": 3000, "F": 1200, "vr": "%.9g" % (speed - velocity),
                "mode": 0, "propensity": 1 if step < 1000 else 3}

    def stream_to(self, end, act):
        while self.step < end:
            self.step += 1
            if self.every == 0 or self.step % self.every:
                continue
            if (self.options.gap or self.options.hide) and act == 2 and 300 <= self.step // self.every < 305:
                self.drops += 1 if self.options.gap else 0
                continue
            values = self.sample(self.step, act)
            self.say(",".join(str(values[name]) for name in self.signals))

    def do_demo(self, words):
        act = int(words[0])
        self.step = 0
        self.drops = 0
        self.say("- act %d: a fake brake is applied" % act)
        self.say("! propensity squeal")
        self.stream_to(DEMO_STEPS, act)
        if self.options.speechless:
            self.answer("demo", act=act)
            return
        self.say("- verdict propensity=%s class=limitcycle-stickslip-p1 period=1 amplitude_um=8.15 "
                 "velocity_mm_s_rms=101.3 level_db=160 acceleration_g=130 frequency_hz=2906.98 band=squeal audible=yes "
                 "stick=0.051 predicted=squeal sigma=10" % ("squeal" if act == 2 else "quiet"))
        self.answer("demo", act=act)

    def point(self, done, total, side, force, slope):
        """Squeals where |alpha| N > c, and grows beside that; above 5000 N the model cannot hold the set."""
        line = "- point done=%d of=%d i=%d j=%d N1=%.9g alpha=%.9g " % (done, total, (done - 1) % side, (done - 1) // side,
                                                                      force, slope)
        excess = -slope * force - self.values["c"]
        if force > 5000:
            return "refused", line + "error=out-of-scale"
        is_loud = excess > 0
        is_growing = 0 < excess < 50
        verdict = "watch" if 0 < excess < 9 else "squeal" if is_loud else "quiet"
        return verdict, line + (
            "propensity=%s class=%s period=%d amplitude_um=%.9g velocity_mm_s=%.9g frequency_hz=2000 growth_per_s=%s "
            "predicted=%s predicted_growth_per_s=%.9g end=%s periods=400" %
            (verdict, "growing" if is_growing else "limitcycle-stickslip-p1" if is_loud else "rest", is_loud,
             0.5 if is_growing else 8 + excess / 500 if is_loud else 0.001, 100 if is_loud else 0.01,
             "nan" if not is_loud else "%.9g" % excess, "squeal" if is_loud else "quiet", excess / 0.6,
             "whole" if is_growing else "squealed" if is_loud else "decayed"))

    def do_scan(self, words):
        (x_from, x_to), side = map(float, words[1:3]), int(words[3])
        y_from, y_to = map(float, words[5:7])
        share = [place / max(side - 1, 1) for place in range(side)]
        tally = dict.fromkeys(("trials", "unknown", "quiet", "watch", "squeal", "refused", "diverged"), 0)
        for done in range(1, side * side + 1):
            is_stopped = self.options.slow and bool(select.select([sys.stdin], [], [], 0.1)[0])
            if is_stopped or tally["trials"] == self.options.cut:
                counts = " ".join("%s=%d" % pair for pair in tally.items())
                raise Refused("error stopped %s: stopped before the end" % counts)
            verdict, line = self.point(done, side * side, side, x_from + (x_to - x_from) * share[(done - 1) % side],
                                       y_from + (y_to - y_from) * share[(done - 1) // side])
            tally["trials"] += 1
            tally[verdict] += 1
            if done == self.options.blur:
                line = line.replace("j=", "j=9")
            if done != self.options.lose:
                self.say(line)
        self.answer("scan", **tally, caps=3, saturations=0, steps=25600 * side * side)

    def do(self, line):
        name, *words = line.split()
        if name == "echo":
            self.echo = words[0] == "on"
            self.say("ok echo " + words[0])
        elif name == "id":
            self.answer("id", name="squeal", version="0.0", build="fake", board="fake", emulated="yes" if self.options.emulated else "no", method="event",
                        states=4, spp=self.spp())
        elif name in ("defaults", "reset", "preset"):
            self.values = dict(DEFAULTS) if name != "reset" else self.values
            if words == ["brake"]:
                self.values["c"] = 120.0
            self.step = 0
            self.answer(name, generation=1)
        elif name == "get":
            self.answer("get", **{words[0]: self.values[words[0]]}, unit="1")
        else:
            getattr(self, "do_" + name)(words)

    def run(self):
        is_mute = False
        self.say("squeal, a fake")
        for line in sys.stdin:
            line = line.strip()
            if self.echo:
                self.say(line)
            if self.options.flood:
                for step in range(20000):
                    self.say("%d,0.1,0.2,0.3" % step)
            if self.options.die and line.startswith(self.options.die):
                sys.stderr.write("fake: first complaint\nfake: the kernel image is gone\n")
                sys.exit(3)
            is_mute = is_mute or bool(self.options.mute) and line.startswith(self.options.mute)
            if is_mute:
                continue
            try:
                if self.options.refuse and line.startswith(self.options.refuse):
                    raise Refused("error not-served this combination of options is not served")
                self.do(line)
            except Refused as refused:
                self.say(str(refused))


def main():
    parser = argparse.ArgumentParser(allow_abbrev=False)
    for name in ("--cases", "--refuse", "--die", "--mute", "--pid-file"):
        parser.add_argument(name)
    for name in ("--skew", "--say"):
        parser.add_argument(name, action="append")
    for name in ("--lose", "--blur", "--cut"):
        parser.add_argument(name, type=int)
    for name in ("--slow", "--flood", "--gap", "--hide", "--speechless", "--emulated", "--version"):
        parser.add_argument(name, action="store_true")
    options = parser.parse_args()
    if options.version:
        print("fake firmware 1.0\nsecond line")
        return
    if options.pid_file:
        with open(options.pid_file, "w") as file:
            file.write(str(os.getpid()))
    Firmware(options).run()


main()
