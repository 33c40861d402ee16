#!/usr/bin/env python3
"""A controller firmware stops a vehicle with the plant firmware's brake: with its law, and with the law switched off. Tells
the story, keeps every turn as CSV, draws it, and fails if the story did not happen.

    hil.py [--board BOARD] [--controller BOARD] [--speed M_PER_S] [--out FOLDER]

Standard library only, and gnuplot for the picture. COMMANDS in the environment: see rig.py; make hil sets it."""
import argparse
import os
import shutil
import subprocess
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from rig import COLUMNS, PHASES, PROPENSITIES, Rig, Silence  # noqa: E402

SQUEAL, QUIET = PROPENSITIES.index("squeal"), PROPENSITIES.index("quiet")
ACTION_S = 0.02         # from hearing to a release that shows in the brake force
KEPT, LESS = 0.5, 0.25  # least share of the torque that the law keeps; at most so much of the squeal without it
LINE_S = 60.0           # no line of the console takes longer


def episodes(stop):
    """Each squeal as (row of its onset, row of the release that answers it or None, row where it is quiet or None)."""
    found, rows, at = [], stop.rows, 0
    while at < len(rows):
        if rows[at]["propensity"] != SQUEAL:
            at += 1
            continue
        onset = rows[at]
        while at < len(rows) and rows[at]["propensity"] != QUIET:
            at += 1
        quiet = rows[at] if at < len(rows) else None
        acted = next((row for row in rows if row["turn"] > onset["turn"] and row["phase"] == PHASES.index("release")), None)
        found.append((onset, acted, quiet))
    return found


def bar(pascal):
    return f"{pascal / 1e5:.2f} bar"


def swing_um(stop):
    return 1e6 * max(row["amplitude_m"] for row in stop.rows)


def told(row, text):
    return row["t_s"], f"  {row['t_s']:7.4f} s  {text}"


def story(stop, has_law):
    """The stop in sentences, in the order of their times."""
    lines = []
    for onset, acted, quiet in episodes(stop):
        lines.append(told(onset, f"the brake squeals: {bar(onset['pressure_pa'])}, {onset['load_n']:.0f} N, "
                                 f"vehicle at {onset['speed_m_per_s'] * 3.6:.1f} km/h"))
        if quiet:
            lines.append(told(quiet, f"quiet again, after {1e3 * (quiet['t_s'] - onset['t_s']):.0f} ms"))
    if has_law:
        heard, low = False, {t_s: pressure for t_s, now, pressure in stop.phases if now == "dither"}
        for t_s, now, pressure in stop.phases:
            if now == "release":
                heard = True
                after = min((at for at in low if at > t_s), default=None)
                to = f" to {bar(low[after])}, and dithers there" if after else ""
                lines.append((t_s, f"  {t_s:7.4f} s  the controller backs off{to}"))
            elif now == "build" and heard:
                heard = False
                lines.append((t_s, f"  {t_s:7.4f} s  it builds up again from {bar(pressure)}, more carefully"))
    end = stop.rows[-1]
    lines.append(told(end, "the vehicle stands" if end["speed_m_per_s"] == 0.0 else "time is up"))
    return [line for _, line in sorted(lines, key=lambda line: line[0])]


def check(law, free):
    """What must have happened and did not, in words."""
    wrong = []

    def claim(holds, text):
        if not holds:
            wrong.append(text)

    for stop, name in ((law, "with the law"), (free, "without the law")):
        claim(stop.end.startswith("score"), f"{name}: {stop.end}")
        claim(len(stop.rows) > 0 and [row["turn"] for row in stop.rows] == list(range(1, len(stop.rows) + 1)),
              f"{name}: turns are missing")
        claim(all(row["flags"] == 0 for row in stop.rows), f"{name}: the plant faulted, clamped a demand or cut a turn")
        claim(stop.rows and stop.rows[-1]["speed_m_per_s"] == 0.0, f"{name}: the vehicle does not stand at the end")
        claim(episodes(stop), f"{name}: no squeal")
    if wrong:
        return wrong
    first = episodes(law)[0]
    claim(first[1] is not None and first[1]["t_s"] - first[0]["t_s"] <= ACTION_S, "the controller did not act on the squeal")
    claim(first[2] is not None, "it was not quiet again")
    claim(law.score("kept") >= KEPT, f"less than {100 * KEPT:.0f} % of the brake torque was kept")
    claim(law.score("squeal") <= LESS * free.score("squeal"), "the law did not avoid the squeal")
    return wrong


def write_csv(path, stop):
    with open(path, "w", encoding="ascii") as table:
        table.write(",".join(COLUMNS) + "\n")
        table.writelines(",".join(str(row[name]) for name in COLUMNS) + "\n" for row in stop.rows)


PLOT = """
reset
set encoding utf8
set terminal {terminal} size 1500,1200 font 'Helvetica,{font}' enhanced background 'white'
set output '{out}/hil.{kind}'
set datafile separator ','
set border 3 lc rgb '#606060'
set tics nomirror out
set grid lc rgb '#ececec' lt 1
set key at graph 1,1.14 right horizontal maxrows 1 samplen 1.5 width -1
set xrange [0:{end_s}]
set multiplot
"""
PANELS = """
set lmargin at screen {left}
set rmargin at screen {right}
set format x ''
unset xlabel
set title "{title}" offset 0,1.6
set tmargin at screen 0.91
set bmargin at screen 0.70
set yrange [0:{force_top}]
set ytics 1000
set ylabel '{force}'
plot '{csv}' every ::1 using 4:($6*{area}) with lines lw 2 lc rgb '#b0b0b0' title 'demanded', \\
  '' every ::1 using 4:($7*{area}) with lines lw 2.5 lc rgb '#1f4e79' title 'applied', \\
  {border} with lines lw 1.5 dt 2 lc rgb '#909090' title 'c/|α|'
unset title
set tmargin at screen 0.66
set bmargin at screen 0.49
set yrange [0:{speed_top}]
set ytics 0.5
set ylabel '{speed}'
plot '{csv}' every ::1 using 4:5 with lines lw 2.5 lc rgb '#b5651d' notitle
set tmargin at screen 0.45
set bmargin at screen 0.24
set yrange [0:{swing_top}]
set ytics {swing_tic}
set ylabel '{swing}'
plot '{csv}' every ::1 using 4:($10*1e6) with filledcurves y1=0 lc rgb '#1f4e79' notitle
set tmargin at screen 0.20
set bmargin at screen 0.07
set yrange [-0.2:3.2]
set ytics {names}
set ylabel ''
set format x '%g'
set xlabel 'time t  [s]'
plot '{csv}' every ::1 using 4:11 with steps lw 2.5 lc rgb '#a02020' notitle
"""


def draw(out, law, free, border_n):
    """The picture, as SVG and PNG; False if there is no gnuplot."""
    if not shutil.which("gnuplot"):
        return False
    rows = law.rows + free.rows
    swing = max(swing_um(law), swing_um(free))
    tic = next(tic for tic in (1, 2, 5, 10, 20, 50, 100, 1000) if swing / tic <= 5)
    top = {"end_s": 1.02 * max(row["t_s"] for row in rows), "area": law.opened["piston_area_m2"], "border": border_n,
           "force_top": 1.1 * max(row["demand_pa"] for row in rows) * law.opened["piston_area_m2"],
           "speed_top": 1.1 * max(row["speed_m_per_s"] for row in rows), "swing_top": 1.1 * swing, "swing_tic": tic,
           "names": "(" + ",".join(f"'{name}' {number}" for number, name in enumerate(PROPENSITIES)) + ")"}
    script = ""
    for kind, terminal, font in (("svg", "svg", 20), ("png", "pngcairo", 16)):
        script += PLOT.format(kind=kind, terminal=terminal, font=font, out=out, **top)
        script += PANELS.format(csv=f"{out}/stop-law.csv", title="with the law", left=0.09, right=0.52, force="brake force N  [N]",
                                speed="vehicle  [m/s]", swing="swing of the pad  [µm]", **top)
        script += PANELS.format(csv=f"{out}/stop-free.csv", title="law switched off", left=0.61, right=0.98, force="",
                                speed="", swing="", **top)
        script += "unset multiplot\n"
    subprocess.run(["gnuplot"], input=script.encode(), check=True, timeout=60)
    return True


def run(arguments):
    with Rig(arguments.board, arguments.controller, limit_s=LINE_S) as rig:
        law = rig.stop(f"stop {arguments.speed:g} law")
        free = rig.stop(f"stop {arguments.speed:g} free")
        border_n = float(rig.plant.ask("get c")["c"]) / -float(rig.plant.ask("get alpha")["alpha"])
    return law, free, border_n


def tell(arguments, law, free):
    opened = law.opened
    if opened:
        print(f"{arguments.board} is the brake, {arguments.controller} its controller; a turn is {opened['turn_steps']:.0f} model "
              f"steps, {1e3 * opened['turn_steps'] * opened['step_s']:.3f} ms")
    for stop, title, has_law in ((law, "the stop, with the law", True), (free, "the same stop, the law switched off", False)):
        print(f"\n{title}\n{'-' * len(title)}")
        if stop.rows:
            print("\n".join(story(stop, has_law)))
    if not (law.end.startswith("score") and free.end.startswith("score")):
        return
    print("\nscore               brake torque kept   time with squeal    largest swing   standstill after")
    for stop, name in ((law, "with the law"), (free, "law switched off")):
        time_s = stop.score("t_s")
        print(f"{name:<20}{100 * stop.score('kept'):5.1f} %             {100 * stop.score('squeal'):5.1f} %, "
              f"{stop.score('squeal') * time_s:5.3f} s    {swing_um(stop):5.1f} um        {time_s:.3f} s")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--board", default="mps2-an386")
    parser.add_argument("--controller", metavar="BOARD", help="default: that of the plant")
    parser.add_argument("--speed", type=float, default=2.0, metavar="M_PER_S", help="of the vehicle, at the beginning")
    parser.add_argument("--out", default="build/hil")
    arguments = parser.parse_args()
    arguments.controller = arguments.controller or arguments.board
    os.makedirs(arguments.out, exist_ok=True)
    try:
        law, free, border_n = run(arguments)
    except (Silence, OSError) as problem:
        sys.exit(f"hil: {problem}")
    tell(arguments, law, free)
    wrong = check(law, free)
    for stop, name in ((law, "law"), (free, "free")):
        write_csv(f"{arguments.out}/stop-{name}.csv", stop)
    if not wrong and not draw(arguments.out, law, free, border_n):
        print("\nwithout gnuplot there is no picture")
    print(f"\nin {arguments.out}: {', '.join(sorted(os.listdir(arguments.out)))}")
    for text in wrong:
        print(f"hil: {text}", file=sys.stderr)
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
