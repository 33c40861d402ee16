#!/usr/bin/env python3
"""The host tool over the link: every subcommand against a firmware process, some against the emulated board, and what it says
and leaves behind when something is wrong."""
import contextlib
import csv
import fcntl
import json
import math
import os
import re
import select
import shutil
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import threading
import time
import tty

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from controller import ERRORS, SYMBOLS, TYPES, Controller, unwire, wire  # noqa: E402
from firmware import Firmware, Tap  # noqa: E402

TOOL = os.path.abspath(os.environ.get("TOOL", "build/tools/squeal"))
BOARDS = os.path.join(os.path.dirname(TOOL), "boards")
BOARD = "host" if os.environ["BOARD"] == "host" else "qemu:" + os.environ["BOARD"]
LIMIT_S = 120
OK, FAILED, USAGE, PORT, REFUSED = range(5)
FAST = ("tick=20000", "substeps=64")
tap = Tap()
folder = tempfile.mkdtemp(prefix="squeal-tool-")
environment = {**os.environ, "TMPDIR": folder + "/tmp"}
environment.pop("SQUEAL_PORT", None)
os.mkdir(environment["TMPDIR"])


def tool(*arguments, env=None):
    return subprocess.run([TOOL, *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE, stdin=subprocess.DEVNULL,
                          universal_newlines=True, timeout=LIMIT_S, env={**environment, **(env or {})}, cwd=folder)


def check(run, code, wanted, claim):
    """The exit code, and what was said: a mistake in one line of standard error, anything else on standard output."""
    said = run.stdout if code == OK else run.stderr
    is_told = all(text in said for text in ([wanted] if isinstance(wanted, str) else wanted))
    is_brief = code == OK or len(run.stderr.splitlines()) == 1
    tap.check(run.returncode == code and is_told and is_brief, claim, f"exit {run.returncode}", *run.stdout.splitlines(),
              *run.stderr.splitlines())


def fields(run):
    """Lines of a name and a value."""
    return dict(line.split(None, 1) for line in run.stdout.splitlines() if len(line.split(None, 1)) == 2)


# --- Looking and steering --------------------------------------------------------------------------------------------
path = folder + "/link"
with Firmware("host", link=path) as firmware:
    port = ("--port", "unix:" + path)
    check(tool("id", *port), OK, ["board        host", "link         1."], "id")
    check(tool("list", *port), OK, ["m = 0.3 kg [1e-06 .. 1000000] restart  mass of the pad", "contact = bilateral [bilateral|"], "list")
    check(tool("list", "mu_", *port), OK, "mu_s = 0.3 [0 .. 10] live", "list by name")
    check(tool("list", "mass of", *port), OK, "m = 0.3 kg", "list by meaning")
    check(tool("list", "no such thing", *port), FAILED, "nothing in the list", "list of nothing")
    check(tool("list", "--signals", *port), OK, "displacement of the pad along the disc, m\n", "list of signals")
    check(tool("set", "N0=2.5", "contact=lift", "mu_s=0.45", *port), OK, "back at step 0", "set")
    check(tool("get", "N0", "contact", "mu_s", *port), OK, "N0 = 2.5 N\ncontact = lift\nmu_s = 0.45\n", "and get it back")
    tap.check(firmware.ask("get mu_s")["mu_s"] == "0.45", "the console has it too")
    check(tool("get", "--bare", "N0", *port), OK, "2.5\n", "get --bare")
    check(tool("set", "N0=3", "m=-1", *port), REFUSED, "m=-1: a number of 1e-06 .. 1000000 kg is wanted", "set out of range")
    check(tool("set", "N0=3", "contact=glue", *port), REFUSED, "contact=glue: one of bilateral|", "set of no choice")
    check(tool("set", "N0=3", "spp=64.5", *port), REFUSED, "spp=64.5: one of 16|32|", "set of what is no name")
    check(tool("set", "N0=3", "spp=16", "kt=10", *port), REFUSED, "step-too-large", "set that the model refuses")
    check(tool("set", "N0=3", "n1=1", *port), REFUSED, "no parameter is called 'n1'; there is N1", "set of an unknown name")
    controller = Controller(path)
    staged = controller.ask("READ", 1, SYMBOLS.index("N0"))[2]
    controller.close()
    tap.check(staged == 2.5, "nothing of a refused set stays staged", str(staged))
    check(tool("set", "N0", *port), USAGE, "'N0': NAME=VALUE is wanted", "set without a value")
    check(tool("get", "N0", *port), OK, "N0 = 2.5 N", "after all of which nothing has changed")
    check(tool("preset", *port), OK, "fig5-n10 ", "the presets")
    check(tool("preset", "brake", *port), OK, "in force", "a preset")
    check(tool("preset", "brakes", *port), REFUSED, "no preset is called 'brakes'; there is brake", "an unknown preset")

    run = tool("step", "3000", "--load", "2500", *port)
    check(run, OK, "N            2500.", "step with a force")
    tap.check(fields(run)["step"] == "3000" and fields(run)["hash"] == firmware.ask("status")["hash"], "leads where the console is")
    check(tool("step", "10", "--pressure", "1e9", *port), OK, "an input was held at a limit", "an input beyond the scale")
    check(tool("step", "1", "--load", "profile", "--v0", "0.05", *port), OK, "v0           0.0500", "back to the profile, another speed")
    check(tool("get", "--now", "step", "mode", "propensity", "hash", *port), OK,
          ["step = 3011\n", "mode = s", "propensity = "], "signals as they are now")
    check(tool("set", "m=0.4", "--live", *port), REFUSED, "needs-restart", "set --live refuses a reset")
    check(tool("set", "N1=2000", "--live", *port), OK, "the plant goes on", "and lets a live change through")
    check(tool("run", *port), OK, "runs from step 3011", "run")
    check(tool("step", "1", *port), REFUSED, "is-running", "no step while it runs")
    check(tool("status", *port), OK, "state           run", "status")
    check(tool("stop", *port), OK, "stands at step ", "stop")
    check(tool("reset", *port), OK, "back at step 0", "reset")
    status = fields(tool("status", *port))
    tap.check(status["state"] == "ready" and status["step"] == "0" and int(status["refused"]) > 0, "status counts", str(status))
    check(tool("get", "N1", env={"SQUEAL_PORT": "unix:" + path}), OK, "N1 = 2000 N", "SQUEAL_PORT stands in for --port")
    tool("set", "stale=0.001", "safe=0.002", "ramp=0.01", *port)
    check(tool("step", "1000", "--load", "1000", *port), OK, "in the safe state: step --start leaves it", "a controller that falls silent")
    check(tool("get", "--now", "input_state", *port), OK, "input_state = safe", "is told as a signal")
    check(tool("step", "1", "--load", "1000", *port), REFUSED, "safe-state", "and not heard any more")
    check(tool("step", "1", "--start", *port), OK, "propensity", "until it starts anew")
    check(tool("status", *port), OK, ["input_state     fresh", "times_safe      1"], "which status tells")
    tool("preset", "brake", *port)
    firmware.send("step 100000000")
    firmware.flush()
    while fields(tool("status", *port))["state"] != "run":
        pass
    check(tool("step", "1", *port), REFUSED, "busy", "no step while the console steps")
    check(tool("stop", *port), OK, "stands at", "stop ends it")
    firmware.answer()
    check(tool("preset", "fig7-ke5000", *port), OK, "in force", "a set that diverges")
    run = tool("step", "100000", *port)
    tap.check(run.returncode == FAILED and "left its domain and is frozen: reset" in run.stderr, "its fault is told", run.stderr)

# --- Studies -----------------------------------------------------------------------------------------------------------
path = folder + "/study"
with Firmware("host", link=path) as firmware:
    port = ("--port", "unix:" + path)
    tool("preset", "brake", *port)
    tool("step", "40000", *port)
    run = tool("verdict", *port)
    check(run, OK, ["propensity        squeal", "class             limitcycle-stickslip", "predicted         squeal"], "verdict")
    tap.check(f"amplitude         {firmware.ask('verdict')['amplitude_um']} um" in run.stdout, "is that of the console", run.stdout)
    before = fields(tool("status", *port))["hash"]
    run = tool("scan", "N1", "1000", "4000", "3", "alpha", "-0.12", "-0.03", "3", "log", "--out", "map.csv", *port)
    check(run, OK, ["9 trials: ", "map.csv: 9 points"], "scan")
    with open(folder + "/map.csv") as file:
        points = list(csv.DictReader(line for line in file if not line.startswith("#")))
    firmware.send("scan N1 1000 4000 3 alpha -0.12 -0.03 3 log")
    firmware.answer()
    wanted = [dict(word.split("=", 1) for word in line.split() if "=" in word) for line in firmware.body]
    tap.check([(point["i"], point["j"], point["N1[N]"], point["propensity"], point["amplitude[um]"], point["end"], point["periods"]) for point in points] ==
              [(point["i"], point["j"], point["N1"], point["propensity"], point["amplitude_um"], point["end"], point["periods"]) for point in wanted],
              "has the points of the console's", *map(str, points))
    check(tool("scan", "N1", "1000", "1e9", "2", "--out", "one.csv", *port), OK, "1 refused", "scan of what does not fit")
    tap.check(open(folder + "/one.csv").read().splitlines()[-1] == "1,0,1000000000" + 15 * "," + ",out-of-scale", "which is told in its place")
    run = tool("margin", "N1", *port)
    check(run, OK, ["N1 = 3000 N: squeal; below 1999.3", "less of it quiets"], "margin")
    check(tool("margin", "x0", *port), REFUSED, "not-served", "margin of what has no border")
    tap.check(fields(tool("status", *port))["hash"] == before, "all of which changes no bit of the plant")
    for words in (["N1", "1", "2"], ["N1", "1", "2", "0"], ["N1", "1", "2", "257"], ["N1", "1", "2", "3", "c", "1"],
                  ["N1", "1", "2", "3", "c", "1", "2", "3", "m", "1"]):
        check(tool("scan", *words, "--out", "x.csv", *port), USAGE, "squeal: ", "usage: scan " + " ".join(words))
    check(tool("scan", "N1", "1", "2", "3", "N1", "1", "2", "3", "--out", "x.csv", *port), REFUSED, "usage", "scan of one parameter twice")
    check(tool("scan", "x1", "1", "2", "3", "--out", "x.csv", *port), REFUSED, "no parameter is called 'x1'", "scan of none")
    run = subprocess.Popen([TOOL, "scan", "N1", "1000", "4000", "256", "alpha", "-0.12", "-0.03", "256", "--out", folder + "/cut.csv", *port],
                           stdout=subprocess.PIPE, stderr=subprocess.PIPE, universal_newlines=True, env=environment)
    while not os.path.exists(folder + "/cut.csv") or os.path.getsize(folder + "/cut.csv") < 4096:
        time.sleep(0.05)
    run.send_signal(signal.SIGINT)
    said = run.communicate(timeout=LIMIT_S)
    tap.check(run.returncode == FAILED and "stopped before its end" in said[1] and re.search(r"cut.csv: \d+ points", said[0]), "Ctrl-C ends a scan in words",
              str(said))
    os.remove(folder + "/cut.csv")

# --- Runs that can be made again ---------------------------------------------------------------------------------------
with open(folder + "/inputs.csv", "w") as file:
    file.write("step,N[N],vehicle[m/s]\n0,1000,\n500,2500,0.3\n1500,profile,\n1500,,profile\n")
run = tool("record", *FAST, "N1=3200", "--preset", "brake", "--steps", "4000", "--every", "4", "--signals", "xd,x,N,v0,propensity",
           "--inputs", "inputs.csv", "--out", "run.csv", "--wav", "--port", "host")
check(run, OK, ["run.csv: 1000 samples, each 4 steps, 0 missing", "run.json: 4000 steps", "run.wav: the pad's velocity"], "record")
with open(folder + "/run.csv") as file:
    lines = file.read().splitlines()
rows = list(csv.DictReader(line for line in lines if not line.startswith("#")))
tap.check(lines[0].startswith("# squeal record: ") and " N1=3200 " in lines[1] and "tick=20000" in lines[1], "its header tells the set")
tap.check([int(row["step"]) for row in rows] == list(range(4, 4001, 4)) and
          list(rows[0]) == "step,t[s],x[m],xd[m/s],N[N],propensity,v0[m/s]".split(","), "its rows")
loads = [float(row["N[N]"]) for row in rows]
tap.check(abs(loads[50] / 1000 - 1) < 1e-3 and abs(loads[250] / 2500 - 1) < 1e-3 and 0 < loads[380] < 1000, "the inputs took hold at their steps",
          str((loads[50], loads[250], loads[380])))
with open(folder + "/run.json") as file:
    record = json.load(file)
tap.check(record["set"]["N1"] == 3200 and record["set"]["load"] == "ramp" and record["steps"] == 4000 and len(record["inputs"]) == 4 and
          record["device"]["board"] == "host" and record["samples"]["missing"] == 0 and record["counters"]["inputs"] == 3, "run.json",
          str(record))
with open(folder + "/run.wav", "rb") as file:
    sound = file.read()
tap.check(sound[:4] == b"RIFF" and struct.unpack("<I", sound[24:28]) == (48000,) and
          (len(sound) - 44) // 2 == int((4000 - 4) * record["step_s"] * 48000), "run.wav has the plant's time")
with open(folder + "/table.csv", "w") as file:
    file.write("t[s],N[N]\n0,500\n0.005,3000\n0.005,2000\n0.02,2500.5\n")
check(tool("record", *FAST, "load=table", "lag=0.001", "speed=inertia", "J=0.5", "v0=1", "--preset", "brake", "--steps", "4000",
           "--load-table", "table.csv", "--out", "table-run.csv", "--port", "host"), OK, "table-run.json: 4000 steps", "record of a table")
with open(folder + "/table-run.json") as file:
    tables = json.load(file)
tap.check(tables["tables"] == {"load": [[0, 500], [0.005, 3000], [0.005, 2000], [0.02, 2500.5]], "speed": []}, "which keeps its points",
          str(tables["tables"]))
for where in ("host", BOARD):
    check(tool("replay", "table-run.json", "--port", where), OK, "the same bits: " + tables["hash"], f"and makes the same run on {where}")
with open(folder + "/table-other.json", "w") as file:
    file.write(open(folder + "/table-run.json").read().replace("2500.5", "2500"))
check(tool("replay", "table-other.json", "--port", "host"), FAILED, "differs", "but not with another point")
for text, wanted in (("t[s],N[N]\n1,2\n0,2\n", "bad.csv:3: a time not before"), ("t[s],N[N]\n1,-2\n", "bad.csv:2: a time not before"),
                     ("t[s],v0[m/s]\n1,2\n", "columns t[s] and N[N]"), ("t[s],N[N]\n" + "1,2\n" * 65, "at most 64 points")):
    with open(folder + "/bad.csv", "w") as file:
        file.write(text)
    check(tool("table", "load", "bad.csv", "--port", "host"), FAILED, wanted, f"a bad table: {wanted}")
check(tool("table", "load", "table.csv", "--port", "host"), OK, "in force as generation", "a table into force")
check(tool("table", "speed", "--port", "host"), OK, "t[s],v0[m/s]\n", "and one told")
check(tool("replay", "run.json", "--port", "host"), OK, "the same bits: " + record["hash"], "replay on the host")
check(tool("replay", "run.json", "--port", BOARD), OK, "the same bits: " + record["hash"], "and on the board")
for change, wanted in ((lambda text: text.replace('"N1": 3200', '"N1": 3201'), "differs"),
                       (lambda text: text.replace('"steps": 4000', '"steps": 3999'), "differs"),
                       (lambda text: text.replace('"force_n": 2500', '"force_n": 2501'), "differs"),
                       (lambda text: text.replace('"N1": 3200', '"N1": -1'), "N1=-1: a number of"),
                       (lambda text: text.replace('"N1"', '"NN"'), "has a parameter that the device lacks"),
                       (lambda text: text.replace('"squeal_record": 1', '"squeal_record": 2'), "of another version"),
                       (lambda text: text.replace('"hash"', '"cash"'), "missing or damaged"),
                       (lambda text: text[:-20], "no JSON, or cut short"), (lambda text: "{}", "no record of a run")):
    with open(folder + "/run.json") as old, open(folder + "/other.json", "w") as new:
        new.write(change(old.read()))
    check(tool("replay", "other.json", "--port", "host"), FAILED, wanted, f"a record that was changed: {wanted}")
check(tool("replay", "none.json", "--port", "host"), FAILED, "none.json: No such file", "no record")
check(tool("record", "--preset", "brake", "--seconds", "0.01", "--out", "short.csv", "--port", "host"), OK,
      "short.json: 1860 steps, 0.01000", "record by seconds")
check(tool("record", "--preset", "fig7-ke5000", "--steps", "100000", "--out", "fault.csv", "--port", "host"), FAILED,
      "left its domain: the record ends there", "record of a fault")
check(tool("replay", "fault.json", "--port", "host"), OK, "the same bits", "which can be made again as well")
check(tool("record", "--preset", "brake", "--steps", "10", "--out", "none/x.csv", "--port", "host"), FAILED,
      "none/x.csv: No such file", "no place to write")
os.symlink("/dev/full", folder + "/full.csv")
check(tool("record", "--preset", "brake", "--steps", "1000", "--out", "full.csv", "--port", "host"), FAILED, "full.csv: No space left", "a full disk")
for text, wanted in (("N[N]\n1\n", "no column step"), ("step,N[N]\n5,1\n4,1\n", ":3: a step not before the last one"),
                     ("step,N[N],p[Pa]\n5,1,1\n", ":2: "), ("step,N[N]\nx,1\n", ":2: ")):
    with open(folder + "/bad.csv", "w") as file:
        file.write(text)
    check(tool("record", "--steps", "10", "--inputs", "bad.csv", "--out", "x.csv", "--port", "host"), FAILED, wanted, f"a table of inputs: {wanted}")

# --- Pictures ----------------------------------------------------------------------------------------------------------
if shutil.which("gnuplot"):
    with open(folder + "/tone.csv", "w") as file:
        file.write("step,t[s],x[m],xd[m/s]\n")
        for i in range(4096):
            file.write("%d,%.9g,%.9g,%.9g\n" % (i, i / 1e4, 0.0, 0.02 + 0.003 * math.sin(2 * math.pi * 1250 * i / 1e4)))
    check(tool("plot", "spectrum", "tone.csv"), OK, "highest line 3 mm/s at 1250 Hz", "a tone has its amplitude and frequency")
    check(tool("plot", "spectrum", "tone.csv", "--to", "0.003"), FAILED, "a spectrum takes 64 samples or more", "too short for a spectrum")
    for kind in ("phase", "time"):
        signals = ("--signals", "x,xd") if kind == "time" else ()
        check(tool("plot", kind, "run.csv", *signals), OK, f"run-{kind}.svg\nrun-{kind}.png", f"plot {kind}")
        tap.check(os.path.getsize(f"{folder}/run-{kind}.svg") > 2000 and os.path.getsize(f"{folder}/run-{kind}.png") > 2000, "has its files")
    check(tool("plot", "map", "map.csv"), OK, "map-map.svg", "plot map")
    drawn = open(folder + "/map-map.svg").read()
    tap.check("N1  [N]" in drawn and "alpha  [s/m]" in drawn and "9 trials" in drawn, "has its axes")
    with open(folder + "/evil.csv", "w") as file:
        file.write("step,t[s],x[m'; system 'touch evil'; print '],xd[m/s]\n" + "".join(f"{i},{i},{i},{i}\n" for i in range(9)))
    tool("plot", "time", "evil.csv", "--signals", "x")
    tap.check(not os.path.exists(folder + "/evil"), "what a table says is no command to gnuplot")
    check(tool("plot", "map", "one.csv"), FAILED, "takes a scan of two parameters", "a scan of one parameter is no map")
    check(tool("plot", "map", "run.csv"), FAILED, "no table that scan has written", "nor is a run")
    check(tool("plot", "time", "run.csv", "--signals", "y"), FAILED, "no column y", "plot of what is not there")
    check(tool("plot", "time", "run.csv", "--signals", "propensity"), FAILED, "holds more than numbers", "plot of words")
    check(tool("plot", "phase", "run.csv", "--from", "99"), FAILED, "less than two samples", "plot of nothing")
check(tool("plot", "poem", "run.csv"), USAGE, "phase, time, spectrum or map", "plot of no kind")
check(tool("plot", "phase", "inputs.csv"), FAILED, "no column t", "plot of another table")

# --- Self-test ---------------------------------------------------------------------------------------------------------
for where in dict.fromkeys(["host", BOARD]):
    check(tool("selftest", "--port", where), OK, ["pass lockstep: ", "steps with inputs", "pass on the device: ticks", " 0 failed\n"], f"{where}: selftest")

# --- Ports -------------------------------------------------------------------------------------------------------------


@contextlib.contextmanager
def server(serve):
    """A socket whose peer is served by a thread: serve(connection, address of the port)."""
    where = tempfile.mktemp(dir=folder)
    listener = socket.socket(socket.AF_UNIX)
    listener.bind(where)
    listener.listen(1)

    def run():
        with contextlib.suppress(OSError):
            connection = listener.accept()[0]
            serve(connection)
            connection.close()
    thread = threading.Thread(target=run, daemon=True)
    thread.start()
    yield "unix:" + where
    listener.close()
    thread.join(LIMIT_S)


def frames(connection):
    """Requests as they come."""
    partial = b""
    while True:
        data = connection.recv(4096)
        if not data:
            return
        *pieces, partial = (partial + data).split(b"\0")
        for piece in filter(None, pieces):
            yield unwire(piece)


def hello(sequence, board=b"fake", major=1):
    text = struct.pack("<BBHHHBBBBH16s32s24s16s", major, 0, 4, 2, 5, 39, 15, 37, 0, 240, b"0", b"0", board, b"none")
    return wire(TYPES["HELLO"] | 0x80, sequence, 0, text)


def red(connection):
    for kind, sequence, _, _ in frames(connection):
        connection.sendall(hello(sequence, b"\x1b[31mred\x07"))


def newer(connection):
    for kind, sequence, _, _ in frames(connection):
        number = next(number for number, name in ERRORS.items() if name == "wrong-version")
        connection.sendall(wire(0xff, sequence, 0, struct.pack("<BBBIff", kind, number, 0, 2, 0, 0)))


def deaf(connection):
    """Hears the second time only."""
    for count, (kind, sequence, _, _) in enumerate(frames(connection)):
        if count:
            connection.sendall(hello(sequence))


def leaves(connection):
    for kind, sequence, _, _ in frames(connection):
        if kind != TYPES["HELLO"]:
            return
        connection.sendall(hello(sequence))


def mute(connection):
    for kind, sequence, _, _ in frames(connection):
        if kind == TYPES["HELLO"]:
            connection.sendall(hello(sequence))


def short(connection):
    for kind, sequence, _, _ in frames(connection):
        connection.sendall(hello(sequence) if kind == TYPES["HELLO"] else wire(kind | 0x80, sequence, 0, b"123"))


def stranger(connection):
    connection.sendall(b"login: " * 100)
    for _ in frames(connection):
        connection.sendall(b"incorrect\r\n")


with server(red) as where:
    check(tool("id", "--port", where), OK, r"board        \x1b[31mred\x07", "what the wire says is made fit for a terminal")
with server(newer) as where:
    check(tool("id", "--port", where), PORT, "speaks version 2 of the link, this tool 1", "another version")
with server(deaf) as where:
    check(tool("id", "--port", where), OK, "board        fake", "a request that got lost is sent again")
with server(leaves) as where:
    check(tool("status", "--port", where), PORT, where + ": the other end is gone", "a device that goes away")
with server(mute) as where:
    check(tool("status", "--port", where, "--limit", "0.5"), PORT, "no answer for 0.5 s", "a device that falls silent")
with server(short) as where:
    check(tool("status", "--port", where), PORT, "with 3 bytes instead of", "an answer of another length")
with server(stranger) as where:
    check(tool("id", "--port", where, "--limit", "0.5"), PORT, "no squeal answers there", "what is not ours")
with server(lambda connection: time.sleep(1)) as where:
    check(tool("id", "--port", where, "--limit", "0.3"), PORT, "not a byte came", "a port with nobody behind it")

check(tool("id", "--port", "qemu:nonesuch"), PORT, ["no such board; there are: ", " host", " qemu:mps2-an386"], "an unknown board lists the known ones")
check(tool("id", "--port", "/dev/ttyNONE7"), PORT, "no such device", "a serial line that is not there")
check(tool("id", "--port", "/dev/null"), PORT, "no serial line", "no serial line at all")
check(tool("id", "--port", "/dev/ttyS0:1234"), PORT, "no rate of 1234 baud; there are 9600 ", "a rate that is none")
check(tool("id", "--port", "unix:" + folder + "/none"), PORT, "no such socket; make console LINK=", "a socket that is not there")
check(tool("id", "--port", "tcp:127.0.0.1:1"), PORT, "Connection refused", "a closed TCP port")
check(tool("id", "--port", "tcp:nowhere"), PORT, "tcp:HOST:PORT is wanted", "half a TCP port")
check(tool("id", "--port", "carrier pigeon"), PORT, "no port has such a name; try host", "no port at all")
with open(folder + "/boards", "w") as file:
    file.write(f"gone: emulator {folder}/gone.elf\nmissing: no-such-emulator {TOOL}\nbroken: ls {folder}/none {TOOL}\n")
boards = {"SQUEAL_BOARDS": folder + "/boards"}
check(tool("id", "--port", "qemu:gone", env=boards), PORT, "its image is not built; make BOARD=gone builds it", "an image that is not built")
check(tool("id", "--port", "qemu:missing", env=boards), PORT, "no-such-emulator: command not found; make setup installs it", "an emulator that is not there")
check(tool("id", "--port", "qemu:broken", env=boards), PORT, ["the firmware ended with exit code 2: ", "none"], "a firmware that ends at once tells why")
check(tool("id", "--port", "host", env={"SQUEAL_BOARDS": folder + "/none"}), PORT, "no list of boards", "no list of boards")

# --- Terminals ---------------------------------------------------------------------------------------------------------


def relay(a, b, stop):
    """Bytes between two descriptors until told to stop."""
    while not stop.is_set():
        for end in select.select([a, b], [], [], 0.05)[0]:
            with contextlib.suppress(OSError):
                data = os.read(end, 4096)
                os.write(b if end == a else a, data)


@contextlib.contextmanager
def joined(fd):
    """A firmware behind a descriptor."""
    where = tempfile.mktemp(dir=folder)
    with Firmware("host", link=where):
        peer, stop = socket.socket(socket.AF_UNIX), threading.Event()
        until = time.monotonic() + 10
        while peer.connect_ex(where) != 0 and time.monotonic() < until:
            time.sleep(0.01)
        thread = threading.Thread(target=relay, args=(fd, peer.fileno(), stop), daemon=True)
        thread.start()
        yield
        stop.set()
        thread.join(LIMIT_S)
        peer.close()


ours, theirs = os.openpty()
name = os.ttyname(theirs)
with joined(ours):
    check(tool("id", "--port", name), OK, "board        host", "a serial line")
    check(tool("step", "1000", "--port", name + ":115200"), OK, "step         1000", "a serial line with its rate")
    fcntl.flock(theirs, fcntl.LOCK_EX)
    check(tool("id", "--port", name), PORT, "busy: another program has it", "a serial line that is in use")
    fcntl.flock(theirs, fcntl.LOCK_UN)

waiting = subprocess.Popen([TOOL, "id", "--port", "pty"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, universal_newlines=True, env=environment)
name = re.search(r"waiting for a program to open (/dev/pts/\d+)", waiting.stderr.readline())[1]
time.sleep(0.1)
is_waiting = waiting.poll() is None
other = os.open(name, os.O_RDWR | os.O_NOCTTY)
tty.setraw(other)
with joined(other):
    said = waiting.communicate(timeout=LIMIT_S)[0]
tap.check(is_waiting and waiting.returncode == OK and "board        host" in said, "pty waits for a program, and talks to it", said)

# --- Nothing is left behind --------------------------------------------------------------------------------------------


def children_of(pid):
    found = []
    for entry in filter(str.isdigit, os.listdir("/proc")):
        with contextlib.suppress(OSError), open(f"/proc/{entry}/stat") as file:
            if int(file.read().rsplit(")", 1)[1].split()[1]) == pid:
                found.append(int(entry))
    return found


def is_there(pid):
    return os.path.exists(f"/proc/{pid}")


for where in dict.fromkeys(["host", BOARD]):
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        run = subprocess.Popen([TOOL, "step", "1000000000", "--port", where], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, env=environment)
        started, until = [], time.monotonic() + LIMIT_S
        while not started and time.monotonic() < until:
            started = children_of(run.pid)
        time.sleep(0.2)
        run.send_signal(number)
        run.wait(LIMIT_S)
        tap.check(started and run.returncode == -number and not any(map(is_there, started)), f"{where}: signal {number} ends the firmware too",
                  f"{run.returncode} {started}")
run = subprocess.Popen([TOOL, "record", "--preset", "brake", "--steps", "1000000000", "--signals", "x", "--every", "1000", "--out", folder + "/cut.csv", "--port", "host"],
                       stdout=subprocess.PIPE, stderr=subprocess.PIPE, universal_newlines=True, env=environment)
while not os.path.exists(folder + "/cut.csv") or os.path.getsize(folder + "/cut.csv") < 4096:
    time.sleep(0.05)
started = children_of(run.pid)
run.send_signal(signal.SIGINT)
said = run.communicate(timeout=LIMIT_S)
tap.check(run.returncode == FAILED and "the record is that of a shorter run" in said[1] and not any(map(is_there, started)),
          "Ctrl-C ends a record in words", str(said))
with open(folder + "/cut.json") as file:
    tap.check(json.load(file)["steps"] % 1 == 0, "which is one, too")
tap.check(os.listdir(environment["TMPDIR"]) == [], "no folder of a link is left", str(os.listdir(environment["TMPDIR"])))

# --- The command line --------------------------------------------------------------------------------------------------
table = open(os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../tools/squeal/subcommands.def")).read()
names = re.findall(r"^SUBCOMMAND\((\w+),", table, re.MULTILINE)
run = tool("--help")
check(run, OK, [f"  {name} " for name in names] + ["ports:", "exit codes: "], "--help names every subcommand")
for name in names:
    wanted = re.search(rf"^SUBCOMMAND\({name},.*?(?=^SUBCOMMAND|\Z)", table, re.MULTILINE | re.DOTALL)[0]
    check(tool(name, "--help"), OK, re.findall(r'^OPTION\("([^"]+)"', wanted, re.MULTILINE) + re.findall(r'^EXAMPLE\("([^"]+)"', wanted, re.MULTILINE),
          f"{name} --help")
for arguments in (["get"], ["get", "N1"], ["get", "N1", "--sing"], ["get", "N1", "--port"], ["set", "--port", "host"], ["step", "--port", "host"],
                  ["step", "0", "--port", "host"], ["step", "x", "--port", "host"], ["step", "1", "2", "--port", "host"],
                  ["step", "1", "--load", "much", "--port", "host"], ["step", "1", "--load", "1", "--pressure", "1", "--port", "host"],
                  ["id", "--limit", "0", "--port", "host"], ["id", "me", "--port", "host"], ["id", "--port", "host", "--", "x"],
                  ["get", "--now=1", "x", "--port", "host"], ["record", "--steps", "1", "--port", "host"],
                  ["record", "--out", "x.csv", "--port", "host"], ["record", "--out", "x.txt", "--steps", "1", "--port", "host"],
                  ["record", "--out", "x.csv", "--steps", "1", "--seconds", "1", "--port", "host"],
                  ["record", "--out", "x.csv", "--steps", "1", "--signals", "x", "--wav", "--port", "host"], ["replay", "--port", "host"],
                  ["plot", "phase"], ["selftest", "twice", "--port", "host"]):
    check(tool(*arguments), USAGE, "squeal: ", "usage: " + " ".join(arguments))
check(tool("get", "N1", "--port=host"), OK, "N1 = ", "--port=host")


def completed(line):
    script = 'source "$1"; COMP_LINE=$2; COMP_POINT=${#2}; _squeal; printf "%s\\n" "${COMPREPLY[@]}"'
    page = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../tools/squeal/completion.bash")
    return subprocess.run(["bash", "-c", script, "bash", page, f"{TOOL} {line}"], stdout=subprocess.PIPE, universal_newlines=True).stdout.split()


tap.check(set(completed("")) == {*names, "--help"} and completed("rec") == ["record"], "completion of subcommands", str(completed("")))
tap.check(completed("record --se") == ["--seconds"] and completed("record x --seconds 3 --pres") == ["--preset", "--pressure"], "of options")
tap.check(completed("get N_m") == ["N_max"] and completed("set N_m") == ["N_max="] and completed("preset fig6-a0.1") == ["fig6-a0.1"], "of names")
tap.check(completed("id --port ho") == ["host"] and completed("id --port qemu:mps2-an38") == ["mps2-an385", "mps2-an386"], "of ports")

shutil.rmtree(folder)
tap.finish()
