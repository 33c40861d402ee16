#!/usr/bin/env python3
"""squeal paper, small: what it measures on the host, in fixed point and by the naive method; its files, its page, and what it
says when something is wrong."""
import csv
import html.parser
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import xml.dom.minidom

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from firmware import Tap  # noqa: E402

TREE = os.path.abspath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "../.."))
TOOL = os.path.abspath(os.environ.get("TOOL", "build/tools/squeal"))
REFERENCE = os.path.join(TREE, "tests/golden/paper.csv")
PAPER = os.path.join(TREE, "tools/squeal/paper")
LIMIT_S = 300
OK, FAILED, USAGE, PORT, REFUSED = range(5)
VERDICTS = {
    "friction-law": "in part",
    "normal-motion": "refuted",
    "analytic-solution": "refuted",
    "fig10a": "in part",
    "fig10b": "in part",
    "fig10-one-brake": "refuted",
    "stick-from-5n": "refuted",
    "size-force": "in part",
    "size-slope": "in part",
    "beyond-slope": "in part",
    "force-before-slope": "holds",
    "stiffer-smaller": "holds",
    "resonance": "in part",
    "resonance-squares": "refuted",
    "stable-below-c": "in part",
    "diverges-beyond-c": "in part",
    "each-stiffness": "holds",
    "fluctuation": "in part",
    "small-stiffness": "holds",
}
VOID = {"meta", "link", "br", "img", "path", "use"}
tap = Tap()
folder = tempfile.mkdtemp(prefix="squeal-paper-")
environment = {**os.environ, "TMPDIR": folder + "/tmp"}
environment.pop("SQUEAL_PORT", None)
os.mkdir(environment["TMPDIR"])


def paper(*arguments, where=folder, port="host", env=None):
    return subprocess.run([TOOL, "paper", "--reference", REFERENCE, "--port", port, *arguments], stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, stdin=subprocess.DEVNULL, universal_newlines=True, timeout=LIMIT_S, cwd=where,
                          env={**environment, **(env or {})})


def table(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def read(path):
    with open(path, "rb") as file:
        return file.read()


def listed(name, macro):
    """The first argument of each row of a table."""
    with open(os.path.join(PAPER, name)) as file:
        return re.findall(rf'^{macro}\("([^"]+)"', file.read(), re.MULTILINE)


class Page(html.parser.HTMLParser):
    """What a page refers to, what it names, and what is left open."""

    def __init__(self, text):
        super().__init__()
        self.ids, self.references, self.tags, self.open, self.crossed = [], [], set(), [], []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        self.handle_startendtag(tag, attributes)
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag, attributes):
        self.tags.add(tag)
        for name, value in attributes:
            self.ids += [value] if name == "id" else []
            self.references += [value] if name in ("href", "src", "xlink:href", "data") else []

    def handle_endtag(self, tag):
        # A cell or row ends with the next one.
        while self.open and self.open[-1] != tag and self.open[-1] in ("td", "tr", "th", "li", "p"):
            self.open.pop()
        if self.open and self.open[-1] == tag:
            self.open.pop()
        elif tag not in VOID:
            self.crossed.append(tag)


# --- The numbers and the claims --------------------------------------------------------------------------------------
first, second = folder + "/first", folder + "/second"
os.mkdir(first)
os.mkdir(second)
run = paper("--small", "--out", "out", where=first)
out = first + "/out"
tap.check(run.returncode == OK and "not judged" in run.stdout and "OFF" not in run.stdout, "everything agrees", run)
claims, numbers = table(out + "/claims.csv"), table(out + "/numbers.csv")
tap.check([claim["id"] for claim in claims] == listed("claims.def", "CLAIM"), "each claim is there once", str(claims))
said = {claim["id"]: claim["verdict"] for claim in claims}
tap.check(said == VERDICTS, "with the verdict that is known", *(f"{name}: {said.get(name)}, known as {VERDICTS.get(name)}"
                                                                for name in {*said, *VERDICTS} if said.get(name) != VERDICTS.get(name)))
tap.check(all(claim["measured"] and claim["paper"] and os.path.exists(f"{out}/{claim['evidence']}.svg") for claim in claims),
          "with what was measured, and a picture of it", str(claims))
with open(os.path.join(TREE, "src/model/MODEL.md")) as file:
    documented = dict(re.findall(r"^\| `([a-z0-9-]+)` \| .* \| (holds|in part|refuted) \|$", file.read(), re.MULTILINE))
tap.check(documented == VERDICTS, "MODEL.md has the same", *sorted(documented.items() ^ VERDICTS.items()))
verdicts = [number["verdict"] for number in numbers]
tap.check(verdicts.count("agrees") >= 70 and "OFF" not in verdicts, "numbers agree with the reference", str(len(verdicts)))
tap.check({number["experiment"] for number in numbers} == set(listed("experiments.def", "EXPERIMENT")), "of every experiment")

# --- Files -------------------------------------------------------------------------------------------------------------
names = {name[:-4] for name in os.listdir(out) if name.endswith(".svg")}
bad = []
for name in names:
    try:
        root = xml.dom.minidom.parseString(read(f"{out}/{name}.svg")).documentElement
        bad += [] if root.tagName == "svg" and len(root.getElementsByTagName("path")) > 3 else [name + ".svg"]
    except Exception as error:  # whatever the parser has against it
        bad.append(f"{name}.svg: {error}")
    picture = read(f"{out}/{name}.png")
    bad += [] if picture.startswith(b"\x89PNG") and len(picture) > 10000 else [name + ".png"]
    data = [line for line in read(f"{out}/{name}.csv").decode().splitlines() if not line.startswith("#")]
    widths = {line.count(",") for line in data}
    bad += [] if len(data) > 3 and len(widths) == 1 else [name + ".csv"]
tap.check(len(names) >= 10 and not bad, "pictures can be read, and have their data beside them", *bad)

# --- The page ----------------------------------------------------------------------------------------------------------
text = read(out + "/index.html").decode()
page = Page(text)
outer = [name for name in page.references if not name.startswith("#") and not os.path.exists(f"{out}/{name}")]
tap.check(not outer and not {"script", "link", "img", "iframe", "object"} & page.tags and "@import" not in text and
          not re.search(r"url\((?!#)", text), "the page needs nothing from elsewhere", *outer)
tap.check(not page.crossed and page.open == [], "its tags are closed", str(page.crossed[:5]), str(page.open))
missing = {name[1:] for name in page.references if name.startswith("#")} - set(page.ids)
doubled = {name for name in page.ids if page.ids.count(name) > 1}
tap.check(not missing and not doubled, "its links lead somewhere, and to one place", str(missing), str(doubled))
tap.check(names <= set(page.ids) and {f"claim-{name}" for name in VERDICTS} <= set(page.ids), "it has every picture and claim")

# --- However it is run -------------------------------------------------------------------------------------------------
run = paper("--small", "--out", "out", "--jobs", "1", where=second)
differing = [name for name in sorted({*os.listdir(out), *os.listdir(second + "/out")})
             if not os.path.exists(f"{second}/out/{name}") or read(f"{out}/{name}") != read(f"{second}/out/{name}")]
tap.check(run.returncode == OK and not differing, "the same files, one experiment at a time", run, *differing)

run = paper("--small", "--out", "fixed", "--arith", "q27", "--only", "fig5,friction,force,floquet")
tap.check(run.returncode == OK and " OFF" not in run.stdout, "everything agrees in fixed point", run)
tap.check("#fig5" in read(folder + "/fixed/index.html").decode() and "fig8" not in read(folder + "/fixed/index.html").decode(),
          "what is not wanted is not on the page")

run = paper("--small", "--out", "naive", "--method", "naive", "--only", "fig5,fig8,fig9,force")
off = re.findall(r"^OFF (\w+): ", run.stdout, re.MULTILINE)
shown = read(folder + "/naive/index.html").decode()
tap.check(run.returncode == FAILED and len(off) >= 15 and set(off) == {"fig5", "fig8", "fig9", "force"}, "the naive method is found out", run)
tap.check(shown.count("class=off") == len(off) == [number["verdict"] for number in table(folder + "/naive/numbers.csv")].count("OFF"),
          "in page and table as well")

# --- When something is wrong -------------------------------------------------------------------------------------------
with open(folder + "/file", "w") as file:
    file.write("not a folder\n")
for arguments, code, word in ((["--only", "fig99", "--out", "x"], USAGE, "no experiment 'fig99'; there are "),
                              ([], USAGE, "--out is missing"), (["--out", "x", "me"], USAGE, ""),
                              (["--out", "x", "--jobs", "0"], USAGE, "--jobs"),
                              (["--out", "file"], FAILED, "file"), (["--out", "no/such/place"], FAILED, "no/such/place"),
                              (["--out", "x", "--reference", "nowhere.csv"], FAILED, "nowhere.csv"),
                              (["--out", "x", "--reference", "file"], FAILED, "")):
    run = paper(*arguments)
    tap.check(run.returncode == code and word in run.stderr and len(run.stderr.splitlines()) == 1 and not os.path.exists(folder + "/x/claims.csv"),
              "refused: " + " ".join(arguments), run)
run = paper("--out", "x", port="qemu:none")
tap.check(run.returncode == PORT and "none" in run.stderr, "a port that is not there", run)
run = paper("--out", "x", "--jobs", "2", port="/dev/ttyUSB99")
tap.check(run.returncode == USAGE and "one device" in run.stderr, "two jobs on one line", run)
run = paper("--out", "x", "--small", "--only", "fig5", "--spp", "17")
tap.check(run.returncode == FAILED and "FAILED fig5: " in run.stdout and "16|32|64" in run.stdout, "what the device refuses", run)
with open(REFERENCE) as file:
    rows = file.read().splitlines()
with open(folder + "/short.csv", "w") as file:
    file.write("\n".join(row for row in rows if not row.startswith("fig5_N2,")) + "\n")
run = paper("--out", "x", "--small", "--only", "fig5", "--reference", folder + "/short.csv")
tap.check(run.returncode == FAILED and "fig5_N2" in run.stdout, "a case that the reference lacks", run)

# The firmware ends in the midst of it.
with open(folder + "/boards", "w") as file:
    command = [line for line in read(os.path.join(os.path.dirname(TOOL), "boards")).decode().splitlines() if line.startswith("host: ")][0]
    file.write("host: timeout 0.4 " + command[len("host: "):] + "\n")
run = paper("--out", "lost", "--only", "fig6,analytic", "--limit", "2", env={"SQUEAL_BOARDS": folder + "/boards"})
tap.check(run.returncode == FAILED and "FAILED fig6: host: " in run.stdout and "Failed: host: " in read(folder + "/lost/index.html").decode(),
          "a firmware that ends too soon", run)


def begun(*arguments):
    """A run under way, in a session of its own."""
    run = subprocess.Popen([TOOL, "paper", "--reference", REFERENCE, "--port", "host", "--out", "cut", *arguments],
                           stdout=subprocess.PIPE, stderr=subprocess.PIPE, stdin=subprocess.DEVNULL, universal_newlines=True,
                           cwd=folder, env=environment, start_new_session=True)
    time.sleep(1.5)
    return run


run = begun("--only", "fig6")
for child in subprocess.run(["ps", "-o", "pid=", "--ppid", str(run.pid)], stdout=subprocess.PIPE, universal_newlines=True).stdout.split():
    os.kill(int(child), signal.SIGKILL)
output = run.communicate(timeout=LIMIT_S)[0]
tap.check(run.returncode == FAILED and "FAILED fig6: its process was ended by signal 9" in output, "an experiment that is killed", output)

run = begun()
run.send_signal(signal.SIGINT)
run.communicate(timeout=LIMIT_S)
ended_s = time.monotonic()
left = ["?"]
while left and time.monotonic() - ended_s < 10:  # gnuplot ends when it has no more to read
    states = subprocess.run(["ps", "-o", "stat=,pid=,args=", "-s", str(run.pid)], stdout=subprocess.PIPE, universal_newlines=True).stdout
    left = [line for line in states.splitlines() if not line.startswith("Z")]
    time.sleep(0.1)
tap.check(run.returncode == -signal.SIGINT and not left, "Ctrl-C ends all of it", str(run.returncode), *left)
tap.check(os.listdir(environment["TMPDIR"]) == [], "nothing is left behind", str(os.listdir(environment["TMPDIR"])))

shutil.rmtree(folder)
tap.finish()
