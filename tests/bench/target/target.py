#!/usr/bin/env python3
"""Counts instructions of the firmware on emulated boards, compares them with what a textbook's code takes, says at which rates
the interrupt fits its period, and lets each board prove its own.

    target.py [--out FOLDER] [--budget FILE] [--quick]

Standard library only, and gnuplot for the picture. COMMANDS in the environment holds what make command prints, a line for
each board; the bench image stands beside the firmware's. --quick counts and compares with the budget, no more."""
import argparse
import collections
import csv
import os
import re
import subprocess
import sys

from proof import prove
from reference import displacement_after

SHIFT = 10  # of -icount while counting: an instruction takes 2^10 ns, many counts of any clock
OVERHEAD = {"textbook_step_double": ["equation_20_double"], "textbook_step_float": ["equation_20_float"]}
PERIODS, STEPS = 25, 64
CLOCKS_MHZ = (25, 168, 480)
SHARE = 15 / 16  # of a period; a longer tick counts as overrun
CORES_HZ = {"netduinoplus2": 168000000}  # whose timers run faster than the core under the emulator: its board.h
Row = collections.namedtuple("Row", "mean worst calls")


class Board:
    """What the bench image of one board has said."""

    def __init__(self, name, command):
        self.name = name
        self.command = command
        self.image = re.sub(r"squeal(\.elf)?$", r"bench\1", command[-1])
        self.rows, self.memory, self.places = {}, {}, {}
        slow = re.sub(r"shift=\d+", f"shift={SHIFT}", "\0".join(command[:-1] + [self.image])).split("\0")
        said = subprocess.run(slow, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, timeout=300, check=True, text=True)
        self.hear([line.split() for line in said.stdout.splitlines()])
        self.code = self.measure_code()

    def hear(self, lines):
        clock = next(int(words[1]) for words in lines if words[0] == "clock")
        per_instruction = clock * 2**SHIFT / 1e9
        for kind, *words in lines:
            if kind == "count":
                name, arith, part, calls, counts, worst = words
                self.rows[name, arith, part] = Row(int(counts) / int(calls) / per_instruction,
                                                   round(int(worst) / per_instruction), int(calls))
            elif kind == "memory":
                self.memory[words[0], words[1]] = (words[2], int(words[3]))
            elif kind == "place":
                self.places[words[0], words[1]] = float(words[2])
        if not lines or lines[-1] != ["end"]:
            sys.exit(f"{self.name}: the bench image has not come to its end")
        self.clock_hz = CORES_HZ.get(self.name, clock)

    def measure_code(self):
        """Bytes of each function that is counted, with all that it may call."""
        size, calls, now = {}, collections.defaultdict(set), None
        prefix = "arm-none-eabi-"
        for line in subprocess.run([prefix + "nm", "-S", self.image], stdout=subprocess.PIPE, check=True, text=True,
                                   timeout=60).stdout.splitlines():
            words = line.split()
            if len(words) == 4 and words[2] in "tTwW":
                size[words[3]] = int(words[1], 16)
        for line in subprocess.run([prefix + "objdump", "-d", "--no-show-raw-insn", self.image], stdout=subprocess.PIPE,
                                   check=True, text=True, timeout=60).stdout.splitlines():
            begin = re.match(r"[0-9a-f]+ <([^>+]+)>:", line)
            branch = re.search(r"\tb[a-z.]*\t.*<([^>+]+)>", line)
            if begin:
                now = begin.group(1)
            elif branch:
                calls[now].add(branch.group(1))
        code = {}
        for function, _ in self.memory.values():
            found, waiting = set(), [function] + OVERHEAD.get(function, [])
            while waiting:
                name = waiting.pop()
                if name not in found:
                    found.add(name)
                    waiting += calls[name]
            code[function] = sum(size.get(name, 0) for name in found)
        return code

    def own(self):
        """The arithmetic that the board starts with."""
        return "f32" if self.rows["step-slip", "f32", "all"].mean < 1000 else "q27"


def write_csv(path, boards):
    with open(path, "w", newline="") as file:
        table = csv.writer(file)
        table.writerow("board arith variant instructions_mean instructions_worst code_bytes stack_bytes".split())
        for board in boards:
            for (name, arith, part), row in board.rows.items():
                function, stack = board.memory[name, arith]
                table.writerow([board.name, arith, name if part == "all" else f"{name}/{part}", f"{row.mean:.1f}",
                                row.worst, board.code[function], stack])


def tell_counts(boards):
    print("instructions a call: mean, worst; bytes of code and of stack\n")
    for board in boards:
        for (name, arith, part), row in board.rows.items():
            function, stack = board.memory[name, arith]
            rest = f"{board.code[function]:7} {stack:6}" if part == "all" else ""
            label = name if part == "all" else {"1": "  one event", "2": "  two events", "3": "  three events"}.get(
                part, f"  no event, {part}")
            print(f"{board.name:14} {arith:6} {label:22} {row.mean:10.1f} {row.worst:8}  {rest}")
        print()


class Aims:
    """Ratios beside what they should be."""

    def __init__(self):
        self.missed = 0

    def tell(self, text, value, aim, at_least=True):
        is_met = value >= aim if at_least else value <= aim
        self.missed += not is_met
        sign = ">=" if at_least else "<="
        print(f"{text:66} {value:9.4g}   aim {sign} {aim:<6g} {'met' if is_met else 'missed'}")


def tell_ratios(boards):
    aims, reference = Aims(), displacement_after(PERIODS)
    print(f"x after {PERIODS} stick-slip periods: {reference:.9f} m by a reference of 2048 steps a period\n")
    for board in boards:
        arith = board.own()

        def mean(name, which, part="all"):
            return board.rows[name, which, part].mean

        def compare(name, aim_double, aim_float, limit):
            ours = mean(name, arith)
            aims.tell(f"{board.name}: naive-double / {name} {arith}", mean("naive-double", "double") / ours, aim_double)
            if aim_float:
                aims.tell(f"{board.name}: naive-float / {name} {arith}", mean("naive-float", "float") / ours, aim_float)
            if limit:
                aims.tell(f"{board.name}: instructions of {name} {arith}, mean", ours, limit, at_least=False)

        is_q27 = arith == "q27"
        compare("step-stickslip", 120 if is_q27 else 100, 55 if is_q27 else 2, None)
        compare("step-stickslip-exact", 150 if is_q27 else 120, None, 110 if is_q27 else 120)
        usual = mean("step-stickslip-exact", arith, "slip")
        aims.tell(f"{board.name}: step with one event / without, {arith}",
                  mean("step-stickslip-exact", arith, "1") / usual, 4, at_least=False)
        aims.tell(f"{board.name}: error of naive-double / step-stickslip-exact {arith}",
                  abs(board.places["naive-double", "double"] - reference) /
                  abs(board.places["step-stickslip-exact", arith] - reference), 3000)
        aims.tell(f"{board.name}: isr-total / step-stickslip-exact {arith}",
                  mean("isr-total", arith) / mean("step-stickslip-exact", arith), 2.2, at_least=False)
    print(f"\n{aims.missed} missed\n" if aims.missed else "\nall met\n")


def tell_interrupt(boards):
    print("where the interrupt's instructions go, mean\n")
    for board in boards:
        arith = board.own()
        means = [board.rows[name, arith, "all"].mean for name in
                 ("step-stickslip-exact", "detector", "sim-unhashed", "sim", "tick", "tick-sampled", "isr-total")]
        step, detector, unhashed, whole, tick, sampled, total = means
        for text, value in (("step", step), ("detector", detector),
                            ("load, domain check, counters", unhashed - step - detector), ("hash", whole - unhashed),
                            ("orders, inputs, credit, report", tick - whole), ("sample", sampled - tick),
                            ("entry, timer, clock, pin", total - sampled), ("together", total)):
            print(f"{board.name:14} {arith:6} {text:34} {value:8.1f}  {value / step:5.2f} of the step")
        print()


def interrupt_with_three_events(board):
    """The longest step seen with three events, and all around it, a frame's verdict included."""
    arith = board.own()
    rows = board.rows
    return (rows["step-events", arith, "3"].worst + rows["isr-total", arith, "all"].mean -
            rows["step-stickslip-exact", arith, "all"].mean + rows["detector", arith, "all"].worst -
            rows["detector", arith, "all"].mean)


def tell_rates(boards):
    print("highest tick rate, one step a tick, and the squeal that it follows in real time; an instruction a clock\n")
    print(f"{'':22} {'clock':>8}   {'three-event step':^34}   {'measured mean':^34}")
    print(f"{'':22} {'MHz':>8}   " + 2 * f"{'tick Hz':>10} {'Hz at 32':>11} {'at 64':>10}     ")
    for board in boards:
        worst, mean = interrupt_with_three_events(board), board.rows["isr-total", board.own(), "all"].mean
        for clock in CLOCKS_MHZ:
            rates = [SHARE * clock * 1e6 / count for count in (worst, mean)]
            cells = "   ".join(f"{rate:10.0f} {rate / 32:11.0f} {rate / 64:10.0f}" for rate in rates)
            print(f"{board.name:14} {board.own():6}  {clock:8}   {cells}")
    print()


def draw(out, boards):
    names = ["naive-double", "naive-float", "step-stickslip", "step-stickslip-exact", "detector", "isr-total"]
    with open(os.path.join(out, "target.dat"), "w") as file:
        for name in names:
            cells = []
            for board in boards:
                arith = {"naive-double": "double", "naive-float": "float"}.get(name, board.own())
                cells.append(f"{board.rows[name, arith, 'all'].mean:.1f}")
            file.write(" ".join([name] + cells) + "\n")
    columns = ", ".join(f"'target.dat' using {index + 2}:xtic(1) title '{board.name}, {board.own()}'"
                        for index, board in enumerate(boards))
    with open(os.path.join(out, "target.gp"), "w") as file:
        file.write("set terminal svg size 900,480\nset output 'target.svg'\nset style data histogram\n"
                   "set style fill solid 0.7\nset logscale y\nset grid y\nset xtics rotate by -15\n"
                   "set ylabel 'instructions a step, mean'\n"
                   f"set yrange [50:*]\nplot {columns}\n")
    try:
        subprocess.run(["gnuplot", "target.gp"], cwd=out, check=True, timeout=60)
    except FileNotFoundError:
        print("no gnuplot, no picture")


def check_budget(path, boards):
    """Lines of board, arith, variant, most instructions in the mean."""
    known, failures = {board.name: board for board in boards}, 0
    with open(path) as file:
        for line in file:
            words = line.split("#")[0].split()
            if not words or words[0] not in known:
                continue
            name, arith, variant, most = words
            mean = known[name].rows[variant, arith, "all"].mean
            is_within = mean <= float(most)
            failures += not is_within
            print(f"{'ok' if is_within else 'over'} {name} {arith} {variant}: {mean:.1f} of {most}")
    return failures


def main():
    here = os.path.dirname(os.path.abspath(__file__))
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--out", default="build/bench")
    parser.add_argument("--budget", default=os.path.join(here, "budget.txt"))
    parser.add_argument("--quick", action="store_true")
    options = parser.parse_args()
    commands = dict(line.split(": ", 1) for line in os.environ.get("COMMANDS", "").splitlines())
    os.makedirs(options.out, exist_ok=True)
    boards = [Board(name, command.split()) for name, command in sorted(commands.items()) if name != "host"]
    if not boards:
        sys.exit("no boards: make bench sets COMMANDS")
    write_csv(os.path.join(options.out, "target.csv"), boards)
    if not options.quick:
        tell_counts(boards)
        tell_ratios(boards)
        tell_interrupt(boards)
        tell_rates(boards)
        draw(options.out, boards)
    failures = check_budget(options.budget, boards)
    if not options.quick:
        for board in boards:
            failures += not prove(board, interrupt_with_three_events(board),
                                  board.rows["isr-total", board.own(), "all"].mean)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
