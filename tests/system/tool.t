#!/usr/bin/env python3
"""The host tool against a fake firmware: what it passes, what it must not pass, and how it says what went wrong."""
import csv
import json
import os
import signal
import shutil
import struct
import subprocess
import sys
import tempfile
import time

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.append(os.path.dirname(HERE))
from tap import Tap  # noqa: E402

TOOL = os.environ.get("TOOL", "build/tools/squeal")
FAKE = [sys.executable, os.path.join(HERE, "fake_firmware.py")]
LIMIT_S = 180

COLUMNS = ("case,m,c,v0,mus,alpha,ke,kt,k,cn,ntype,N0,N1,t1,t2,contact,mumin,x0,xd0,y0,yd0,x_20,v_20,xmax_20,xmin_20,"
           "vmax_20,vmin_20,stick_20,x_100,v_100,ntrans,nwin,xpp,stick,slipminus,f_up,slip_floquet_rate,t_v10,class")
ROWS = """\
sticks,0.3,0.01,1,0.3,-0.002,1,1,1,0,0,2,0,0,0,0,-1e+30,0,0,0,0,-0.34,-0.06,0.95,-0.56,1.2,-1.6,0.11,-0.3,0.1,300,40,1.23,0.118,0,0.29,-0.01,nan,stickslip-p1
steps,0.3,0.01,1,0.3,-0.002,1,1,1,0,1,1.5,5,41.3,0,2,-1e+30,0,0,0,0,0.23,-2.6,1.7,-1.2,2.1,-3.3,0.16,0.23,-2.6,300,40,2.07,0.43,0.07,0.29,-0.03,nan,stickslip-p1
brake,0.3,120,0.1,0.42,-0.06,1e8,4e7,7.5e6,219,2,0,1500,0,0.05,0,0.36,0,0,0,0,1.8e-06,0.0002,1.8e-06,0,0.0008,-0.0003,0,9e-06,0.0002,300,40,0,0,0,0,-50,nan,rest
sine,0.3,0.01,1,0.3,-0.002,1,1,1,0,3,2.5,0.4,0,0.174,1,-1e+30,0,0,0,0,-0.57,-0.66,1.2,-0.8,1.8,-2.1,0.15,-0.57,-0.66,300,40,2.01,0.15,0.12,0.29,-0.008,nan,locked-other
edge,0.3,0.01,1,0.3,-0.002,1,1,1,0,0,1,0,0,0,0,-1e+30,0,0,0,0,-0.16,-0.15,0.57,-0.28,0.9,-0.8,0,-0.15,-0.01,300,40,0.6,0,0,0.29,-0.0001,nan,beating
edge_slow,0.3,0.01,1,0.3,-0.002,1,1,1,0,0,1.1,0,0,0,0,-1e+30,0,0,0,0,-0.16,-0.15,0.57,-0.28,0.9,-0.8,0,-0.15,-0.01,300,40,0.6,0,0,0.29,-0.0001,nan,forced-p1
leaves,0.3,0.01,1,0.3,-0.1,1,1,1,0,0,1,0,0,0,0,-1e+30,3.5,0,0,0,14433,-138366,55687,-42753,130530,-138366,0,nan,nan,300,40,nan,nan,nan,nan,0.15,1.7476,diverging
still,0.3,0.01,0,0.3,-0.002,1,1,1,0,0,2,0,0,0,0,-1e+30,0,0,0,0,0,0,0,0,0,0,1,0,0,300,40,0,1,0,0,-0.01,nan,rest
"""





def tool(*arguments):
    return subprocess.run([TOOL, *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE, stdin=subprocess.DEVNULL,
                          universal_newlines=True, timeout=LIMIT_S)


def write(path, text):
    with open(path, "w", newline="") as file:
        file.write(text)
    return path


def is_running(pid):
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    return True


def golden_tests(tap, folder):
    cases = write(folder + "/cases.csv", COLUMNS + "\n" + ROWS)
    out = folder + "/out.csv"

    def golden(*fake, more=("--asymptotic",), table=cases, known=cases):
        return tool("golden", "--cases", table, "--out", out, "--limit", "3", *more, "--", *FAKE, "--cases", known, *fake)

    run = golden()
    tap.check(run.returncode == 0 and run.stdout.endswith("8 passed, 0 failed\n"), "equal answers pass", run)
    with open(out, newline="") as file:
        rows = list(csv.DictReader(file))
    wanted = [line.split(",")[0] for line in ROWS.splitlines()]
    tap.check([row["case"] for row in rows] == wanted, "the rows come out in the order of the table")
    tap.check(rows[0]["xpp"] == "1.23" and rows[0]["steps"] == str(340 * 64), "a row holds the answers as received")
    tap.check(all(rows[6][name] == "nan" for name in ("x_20", "stick_20", "x_100", "xpp", "f_up")) and
           (rows[6]["verdict"], rows[6]["class"], rows[6]["t_v10"]) == ("squeal", "diverging", "1.7476"),
           "a diverging row has a verdict and no measurements")

    run = golden(more=())
    tap.check(run.returncode == 0 and "xpp  " not in run.stdout, "without --asymptotic the attractor is not compared", run)
    with open(out, newline="") as file:
        tap.check(all(row["xpp"] == "nan" for row in csv.DictReader(file)), "and its columns are nan")

    swapped = write(folder + "/swapped.csv", "\r\n".join(
        ",".join(reversed(line.split(","))) for line in (COLUMNS + "\n" + ROWS).splitlines()) + "\r\n")
    run = golden(table=swapped)
    tap.check(run.returncode == 0 and "8 passed" in run.stdout, "columns in any order, lines ended by CR LF", run)

    # Each is beyond its tolerance by a little; its neighbour is within.
    for fields, bad in (("x=1.004", "sticks: x_20"), ("xmax=1.0011", "sticks: xmax_20"), ("xmin=1.002", "sticks: xmin_20"),
                        ("stick=1.06", "sticks: stick_20"), ("xpp=1.003", "sticks: xpp"), ("f_up=1.0002", "sticks: f_up"),
                        ("t_v10=1.02", "leaves: t_v10")):
        run = golden("--skew", fields)
        tap.check(run.returncode == 1 and bad in run.stdout, "too large an error of " + bad, run)
    for fields in ("xmax=1.0009", "stick=1.004", "xpp=1.001", "f_up=1.00005", "t_v10=1.005"):
        run = golden("--skew", fields)
        tap.check(run.returncode == 0, "an error within the tolerance: " + fields, run)
    run = golden("--skew", "xmax=1.0029")
    tap.check("brake: xmax_20" not in run.stdout and "sticks: xmax_20" in run.stdout, "a friction floor has its own tolerance", run)
    run = golden("--skew", "xmax=1.0029", more=("--spp", "128"))
    tap.check("brake: xmax_20" in run.stdout, "but not at 128 steps a period", run)
    run = golden("--skew", "xpp=1.015")
    tap.check("sine: xpp" not in run.stdout and "edge: xpp" not in run.stdout and "sticks: xpp" in run.stdout,
           "an aperiodic or marginal size is compared less strictly", run)

    run = golden("--say", "propensity=quiet")
    tap.check(run.returncode == 1 and "sticks: verdict is quiet, expected squeal" in run.stdout and
           "edge: verdict" not in run.stdout and "brake: verdict" not in run.stdout, "loud cases must be squeal", run)
    run = golden("--say", "propensity=squeal")
    tap.check(run.returncode == 1 and "brake: verdict is squeal" in run.stdout and "edge" not in run.stdout,
           "quiet cases must not be squeal", run)
    run = golden("--say", "propensity=unknown")
    tap.check("brake: verdict is unknown" in run.stdout and "sticks: verdict is unknown" in run.stdout, "unknown fails", run)
    run = golden("--say", "propensity=watch")
    tap.check("brake: verdict is watch" in run.stdout, "more than a tenth of the quiet cases as watch fails", run)
    run = golden("--say", "predicted=quiet")
    tap.check("sticks: predicted" in run.stdout and "steps: predicted" not in run.stdout and "sine: predicted" not in run.stdout,
           "a wrong prediction fails where the load settles", run)
    run = golden("--say", "saturations=2")
    tap.check("sticks: saturations" in run.stdout and "leaves: saturations" not in run.stdout, "saturation of a bounded case", run)
    run = golden("--say", "class=diverging")
    tap.check(run.returncode == 0, "the class of bounded cases is not judged", run)
    other = write(folder + "/other.csv", COLUMNS + "\n" + ROWS.replace("1.7476,diverging", "nan,stickslip-p1"))
    run = golden(known=other)
    tap.check("leaves: x_20 is 14433, expected nan" in run.stdout, "measurements after the divergence fail", run)

    run = golden("--refuse", "set load ramp")
    tap.check(run.returncode == 1 and "brake: error not-served" in run.stderr and "7 passed, 1 failed" in run.stdout,
           "a refused row is failed with its reason, the others go on", run)
    with open(out, newline="") as file:
        rows = list(csv.DictReader(file))
    tap.check(rows[2]["class"] == "refused" and rows[2]["x_20"] == "nan", "and is written as such")
    run = golden("--die", "set load ramp")
    tap.check(run.returncode == 1 and "ended with exit code 3" in run.stderr and "the kernel image is gone" in run.stderr and
           "7 passed, 1 failed" in run.stdout, "a firmware that dies at one case costs that case", run)
    run = golden("--die", "echo")
    tap.check(run.returncode == 1 and "0 passed, 8 failed" in run.stdout, "a firmware that dies at once", run)
    run = golden("--mute", "measure", more=("--limit", "1"))
    tap.check(run.returncode == 1 and "s after 'measure 20'" in run.stderr and "was silent for" in run.stderr, "a silent firmware", run)
    run = golden("--flood")
    tap.check(run.returncode == 0, "a firmware that talks while it is talked to", run)
    run = tool("golden", "--cases", cases, "--out", out, "--", "no-such-program-at-all")
    tap.check(run.returncode == 1 and "no-such-program-at-all: command not found" in run.stderr, "a missing command", run)

    run = tool("golden", "--cases", cases, "--out", "/dev/full", "--", *FAKE, "--cases", cases)
    tap.check(run.returncode == 1 and "/dev/full: No space left on device" in run.stderr and "passed" not in run.stdout,
           "a full disk", run)
    run = golden("--refuse", "set")
    tap.check(run.returncode == 1 and "no reference" not in run.stdout and
           "no number of any row could be compared" in run.stdout and run.stdout.endswith("\n0 passed, 8 failed\n"),
           "rows that are all refused leave nothing to compare", run)
    inputs = COLUMNS.split(",").index("x_20")
    bare = write(folder + "/bare.csv", "\n".join(
        ",".join(line.split(",")[:inputs]) for line in (COLUMNS + "\n" + ROWS).splitlines()) + "\n")
    run = golden(table=bare, more=())
    tap.check(run.returncode == 0 and "no reference columns: its rows only ran" in run.stdout and
           run.stdout.endswith("8 passed, 0 failed\n"), "a table of inputs alone only runs", run)
    run = golden("--refuse", "set m 0.3 c 0.01 ke 1 kt 1 k 1 cn 0 v0 1 alpha 0 contact bilateral spp 64 normal rk4 method naive",
                 more=("--method", "naive"))
    tap.check(run.returncode == 1 and "sticks: error not-served" in run.stderr, "the method goes to the firmware", run)
    run = tool("golden", "--cases", cases, "--out", folder + "/made", "--", *FAKE, "--cases", cases)
    tap.check(run.returncode == 0 and os.listdir(folder + "/made") == ["cases.csv"], "a folder to write to", run)
    run = tool("golden", "--cases", cases, "--out", folder + "/a/b", "--", *FAKE, "--cases", cases)
    tap.check(run.returncode == 1 and "/a/b/cases.csv: No such file or directory" in run.stderr, "a folder that cannot be", run)
    run = tool("golden", "--cases", write(folder + "/gap.csv", COLUMNS + "\n" + ROWS + "short,1,2\n"), "--out", out,
               "--", *FAKE)
    tap.check(run.returncode == 1 and "gap.csv:10: 3 cells where the header has 39" in run.stderr, "a ragged table", run)
    run = golden(table=write(folder + "/hole.csv", COLUMNS + "\n" + ROWS.replace("sticks,0.3", "sticks,")))
    tap.check(run.returncode == 1 and "sticks: no number in column m" in run.stderr, "an empty cell", run)
    run = tool("golden", "--cases", folder + "/none.csv", "--out", out, "--", *FAKE)
    tap.check(run.returncode == 1 and "none.csv: No such file" in run.stderr, "a missing table", run)
    for arguments in ((), ("sing",), ("golden", "--", "x"), ("golden", "--cases", cases, "--out", out),
                      ("golden", "--cases", cases, "--out", out, "--jobs", "0", "--", "x"),
                      ("golden", "--wrong", "--", "x")):
        run = tool(*arguments)
        tap.check(run.returncode == 2 and len(run.stderr.splitlines()) == 1, "usage: " + " ".join(arguments[:1] + arguments[3:]), run)
    run = tool("--help")
    tap.check(run.returncode == 0 and "examples:" in run.stdout, "help", run)


def signal_tests(tap, folder):
    cases = write(folder + "/cases.csv", COLUMNS + "\n" + ROWS)
    for number in (signal.SIGINT, signal.SIGTERM):
        pid_file = folder + "/pid%d" % number
        child = subprocess.Popen([TOOL, "golden", "--cases", cases, "--out", folder + "/out.csv", "--jobs", "1", "--",
                                  *FAKE, "--mute", "measure", "--pid-file", pid_file], stderr=subprocess.DEVNULL)
        for _ in range(100):
            if os.path.exists(pid_file) and os.path.getsize(pid_file) > 0:
                break
            time.sleep(0.05)
        with open(pid_file) as file:
            pid = int(file.read())
        child.send_signal(number)
        code = child.wait(LIMIT_S)
        tap.check(code == -number and not is_running(pid), "signal %d ends the firmware too" % number)


def sound_of(path):
    """Rate, points and frequency of a mono file of 16 bit."""
    with open(path, "rb") as file:
        data = file.read()
    rate, = struct.unpack("<I", data[24:28])
    points = struct.unpack("<%dh" % ((len(data) - 44) // 2), data[44:])
    ups = [i for i in range(len(points) // 2, len(points) - 1) if points[i] < 0 <= points[i + 1]]
    return rate, points, (len(ups) - 1) * rate / (ups[-1] - ups[0])


def read_until(file, text):
    """What a pipe or terminal says up to that, or to its end."""
    said = b""
    while text is None or text not in said:
        try:
            more = os.read(file, 1024)
        except OSError:
            more = b""
        if not more:
            break
        said += more
    return said


def map_tests(tap, out, story):
    def the_map(*fake, more=(), env={**os.environ, "PATH": out + "/nothing"}):
        return story(*fake, more=("--acts", "1", "--points", "6", *more), env=env)

    def record():
        with open(out + "/run.json") as file:
            return json.load(file)["map"]

    def table():
        with open(out + "/map.csv", newline="") as file:
            return list(csv.DictReader(file))

    def names():
        return [name for name in os.listdir(out) if name.startswith("map")]

    run = story(more=("--acts", "1", "--points", "0"))
    tap.check(run.returncode == 0 and "map:" not in run.stdout and not names() and record() is None, "no map where none is asked for",
           run)
    run = the_map(env=None)
    tap.check(run.returncode == 0, "a map", run)
    rows = table()
    tap.check(list(rows[0]) == "done,of,i,j,N1[N],alpha[s/m],propensity,class,period,amplitude[um],velocity[mm/s],frequency[Hz],"
           "growth[1/s],predicted,predicted_growth[1/s],end,periods,error".split(","), "map.csv has every field, with its unit")
    tap.check([int(row["done"]) for row in rows] == list(range(1, 37)) and
           [(row["i"], row["j"]) for row in rows[5:8]] == [("5", "0"), ("0", "1"), ("1", "1")], "and every point")
    tap.check(rows[5]["error"] == "out-of-scale" and rows[5]["propensity"] == "", "a refused point has its reason, and no more")
    tap.check("squeal               14 points, amplitude 8.12 to 8.83 um" in run.stdout and
           "watch                1 point," in run.stdout and "quiet                15 points" in run.stdout and
           "still growing        3 points" in run.stdout, "counts by verdict are told", run)
    tap.check("|alpha| N = c        right at 29 points, wrong at 0" in run.stdout and
           "prediction           right at 29 points, wrong at 0" in run.stdout and "a point\n" in run.stdout,
           "and how right the rules were", run)
    tap.check("refused              6\n" in run.stdout and "three 3\n" in run.stdout and "saturations" not in run.stdout,
           "and what should have been nothing", run)
    known = record()
    tap.check(known["complete"] and (known["points"], known["points_missing"], known["squeal"], known["refused"]) == (36, 0, 14, 6) and
           known["command"] == "scan N1 650 5400 6 alpha -0.12 -0.006 6 transient 1000" and known["axes"][1]["unit"] == "s/m" and
           known["parameters_si"]["c"] == 120 and known["counted_by_the_device"]["steps"] == 25600 * 36 and
           known["wall_s_a_point"] > 0, "run.json has the map", run)
    told = [int(line.split()[0]) for line in run.stdout.splitlines() if " of 36 points, " in line]
    tap.check(told == [4, 8, 11, 15, 18, 22, 26, 29, 33] and "\r" not in run.stdout + run.stderr,
           "without a terminal the progress is a line for every tenth", run)
    if shutil.which("gnuplot"):
        tap.check(all(os.path.getsize("%s/map.%s" % (out, kind)) > 10000 for kind in ("svg", "png")), "its picture", run)
        with open(out + "/map.svg", encoding="utf-8") as file:
            text = file.read()
        tap.check("\u03b1" in text and "[\u00b5m]" in text and "30 trials" not in text and "36 trials" in text and
               "board fake" in text, "says what it shows", run)

    master, slave = os.openpty()
    run = subprocess.Popen([TOOL, "demo", "--board", "fake", "--out", out, "--acts", "1", "--points", "6", "--", *FAKE, "--slow"],
                           stdout=subprocess.PIPE, stderr=slave, stdin=subprocess.DEVNULL, universal_newlines=True,
                           env={**os.environ, "PATH": out + "/nothing"})
    os.close(slave)
    shown = read_until(master, b"#")
    run.send_signal(signal.SIGINT)
    stdout = run.communicate(timeout=LIMIT_S)[0]
    shown = (shown + read_until(master, None)).decode()
    os.close(master)
    tap.check(shown.startswith("\r[") and " of 36 points, " in shown and " s left" in shown, "on a terminal it is a bar in place")
    known = record()
    cut = int(shown.split("the map was cut short: ")[1].split()[0]) if "cut short" in shown else 0
    tap.check(run.returncode == 1 and 0 < cut < 36 and "written" in stdout and " of 36 points, " not in stdout,
           "Ctrl-C ends the map in words, and the story after it")
    tap.check(len(table()) == cut == known["points"] and not known["complete"] and
           known["counted_by_the_device"]["trials"] == cut, "what had come by then is kept")

    pid_file = out + "/pid"
    run = subprocess.Popen([TOOL, "demo", "--board", "fake", "--out", out, "--acts", "1", "--points", "6", "--limit", "9", "--",
                            *FAKE, "--mute", "scan", "--pid-file", pid_file], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                           stdin=subprocess.DEVNULL)
    read_until(run.stdout.fileno(), b"each from its start")
    time.sleep(0.2)
    run.send_signal(signal.SIGINT)
    time.sleep(0.2)
    is_held = run.poll() is None
    run.send_signal(signal.SIGINT)
    run.communicate(timeout=LIMIT_S)
    with open(pid_file) as file:
        tap.check(is_held and run.returncode == -signal.SIGINT and not is_running(int(file.read())),
               "a second Ctrl-C does not wait for the device")

    run = the_map("--lose", "8")
    tap.check(run.returncode == 1 and "the map: 1 of 36 points never came" in run.stderr and len(table()) == 35 and
           record()["points_missing"] == 1, "a lost point is an error", run)
    run = the_map("--blur", "8")
    tap.check(run.returncode == 1 and "the map: 1 line is no point of it" in run.stderr and
           "1 of 36 points never came" in run.stderr, "a damaged one too", run)
    run = the_map("--say", "quiet=12")
    tap.check(run.returncode == 1 and "not those that the device counted" in run.stderr and not record()["complete"],
           "so are counts of the device that differ", run)
    run = the_map("--cut", "10")
    tap.check(run.returncode == 1 and "the map was cut short: 10 of 36 points" in run.stderr and len(table()) == 10,
           "a map that the device cuts short", run)
    run = the_map("--refuse", "scan")
    tap.check(run.returncode == 1 and "'scan N1 650 5400 6 alpha" in run.stderr and "was answered: error not-served" in run.stderr and
           record()["points"] == 0 and not names(), "a refused map", run)
    run = the_map("--die", "scan")
    tap.check(run.returncode == 1 and "the map: the firmware ended with exit code 3" in run.stderr, "a firmware that dies at it", run)
    run = the_map("--slow", more=("--limit", "3"))
    tap.check(run.returncode == 0, "the limit is for each point, not for the map", run)
    run = the_map("--mute", "scan", more=("--limit", "1"))
    tap.check(run.returncode == 1 and "the firmware was silent for 1 s" in run.stderr, "a firmware silent at it", run)


def run_tests(tap, folder):
    out = folder + "/run"

    def story(*fake, more=("--acts", "2,5", "--points", "0"), env=None):
        return subprocess.run([TOOL, "demo", "--board", "fake", "--out", out, "--limit", "20", *more, "--", *FAKE, *fake],
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, stdin=subprocess.DEVNULL,
                              universal_newlines=True, timeout=LIMIT_S, env=env)

    run = story()
    tap.check(run.returncode == 0, "a story told to the end", run)
    tap.check("act 2: a fake brake is applied" in run.stdout and "frequency            2907 Hz" in run.stdout,
           "prints the device's words and verdict", run)
    with open(out + "/state.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    second = [row for row in rows if row["act"] == "2"]
    tap.check(list(rows[0]) == "act,step,t[s],x[m],xd[m/s],y[m],yd[m/s],N[N],F[N],vr[m/s],mode,propensity".split(","), "state.csv has the act before the signals")
    tap.check([int(row["step"]) for row in second] == list(range(2, 2 * len(second) + 1, 2)), "and every second step of the act")
    fifth = [int(row["step"]) for row in rows if row["act"] == "5"]
    tap.check(fifth == list(range(4, 4 * len(fifth) + 1, 4)), "or as many as its picture needs")
    with open(out + "/run.json") as file:
        record = json.load(file)
    act = record["acts"][0]
    tap.check(record["firmware"]["build"] == "fake" and record["board"] == "fake" and record["emulator"] is None and
           record["seed"] is None, "run.json names firmware and board")
    tap.check(act["act"] == 2 and act["title"] == "a fake brake is applied", "the act's number and its title, once each")
    tap.check(act["parameters_si"]["ke"] == 1 and act["parameters_si"]["load"] == "constant" and
           act["groups"] == {"C": 0.018257, "Z2": 2, "eps": None, "mu": 0.3, "V0": 0.547},
           "parameters in SI and as groups")
    tap.check(act["verdict"]["propensity"] == "squeal" and act["complete"] and act["samples"] == len(second) and
           len(act["hash_before"]) == 8, "verdict, counters, hash")
    rate, points, frequency = sound_of(out + "/squeal.wav")
    tap.check(rate == 48000 and len(points) >= 24000 and abs(frequency / 2906.98 - 1) < 1e-3,
           "half a second of sound or more, at its physical pitch (%.1f Hz)" % frequency)
    tap.check(29400 < max(points) < 29600 and min(points) > -29600, "which fills its range and does not clip")
    if shutil.which("gnuplot"):
        names = ["phase-2", "phase-5", "stop-envelope"]
        tap.check(all(os.path.getsize("%s/%s.%s" % (out, name, kind)) > 10000 for name in names for kind in ("svg", "png")),
               "the pictures", run)
        tap.check("stop-envelope" in run.stdout, "are in the closing list", run)
    else:
        tap.check("no pictures" in run.stdout, "says that there are no pictures", run)

    bare = folder + "/bin"
    os.mkdir(bare)
    os.symlink(shutil.which("sh"), bare + "/sh")
    shutil.rmtree(out)
    run = story(env={"PATH": bare})
    tap.check(run.returncode == 0 and "no pictures: gnuplot is not installed" in run.stdout and
           sorted(os.listdir(out)) == ["run.json", "squeal.wav", "state.csv"], "without gnuplot all but the pictures", run)

    run = story("--emulated")
    with open(out + "/run.json") as file:
        tap.check(json.load(file)["emulator"].startswith("Python"), "an emulator is named by its own --version", run)
    run = story("--gap")
    with open(out + "/run.json") as file:
        tap.check(json.load(file)["acts"][0]["samples_missing"] == 5, "gaps are recorded", run)
    tap.check(run.returncode == 0 and "5 samples did not fit the line" in run.stdout, "lost and counted samples are told", run)
    run = story("--hide")
    tap.check(run.returncode == 1 and "act 2: 5 samples are missing, the device counted 0" in run.stderr,
           "samples lost unnoticed fail", run)
    run = story("--speechless")
    tap.check(run.returncode == 1 and "act 2 came without a verdict" in run.stderr, "an act without a verdict fails", run)
    run = story("--refuse", "demo 5")
    with open(out + "/run.json") as file:
        acts = json.load(file)["acts"]
    tap.check(run.returncode == 1 and "'demo 5' was answered: error not-served" in run.stderr and
           [act["complete"] for act in acts] == [True, False], "a refused act fails and is recorded as incomplete", run)
    run = story("--die", "demo 5")
    tap.check(run.returncode == 1 and "exit code 3 during 'demo 5': fake: the kernel image is gone" in run.stderr,
           "a firmware that dies", run)
    run = story("--mute", "demo", more=("--limit", "1", "--acts", "1"))
    tap.check(run.returncode == 1 and "s after 'demo 1'" in run.stderr and "was silent for" in run.stderr, "a silent firmware", run)

    os.remove(out + "/state.csv")
    os.symlink("/dev/full", out + "/state.csv")
    run = story()
    tap.check(run.returncode == 1 and "state.csv: No space left on device" in run.stderr, "a full disk", run)
    run = tool("demo", "--board", "fake", "--out", folder + "/a/b", "--", *FAKE)
    tap.check(run.returncode == 1 and run.stderr == "squeal: %s/a/b: No such file or directory\n" % folder,
           "a missing folder", run)
    os.remove(out + "/state.csv")
    map_tests(tap, out, story)
    with open("/dev/full", "w") as full:
        run = subprocess.run([TOOL, "--help"], stdout=full, stderr=subprocess.PIPE, universal_newlines=True)
    tap.check(run.returncode == 1 and "standard output: No space left on device" in run.stderr, "a full standard output")
    for acts in ("0", "6", "1,", "1;2", ""):
        tap.check(tool("demo", "--board", "b", "--out", out, "--acts", acts, "--", *FAKE).returncode == 2,
               "usage: --acts '%s'" % acts)
    for points in ("-1", "257", "many"):
        tap.check(tool("demo", "--board", "b", "--out", out, "--points", points, "--", *FAKE).returncode == 2,
               "usage: --points " + points)


def main():
    tap = Tap()
    with tempfile.TemporaryDirectory() as folder:
        golden_tests(tap, folder)
        signal_tests(tap, folder)
        run_tests(tap, folder)
    tap.finish()


main()
