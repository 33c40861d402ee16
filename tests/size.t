#!/usr/bin/env python3
"""Every board's image keeps to its budget of flash, RAM and stack, and each rule of tools/budget fails on what it is there to find."""
import os
import shlex
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "system"))
from firmware import COMMANDS, Tap  # noqa: E402

BUDGET = "tests/budget.txt"
COMPILE = "arm-none-eabi-gcc -mthumb -O1 -ffreestanding -nostdlib -fno-inline -fno-optimize-sibling-calls -Wl,-estartup_reset"
M3, M4F = "-mcpu=cortex-m3", "-mcpu=cortex-m4 -mfpu=fpv4-sp-d16 -mfloat-abi=hard"
PROGRAM = """
volatile float number;
void app_tick(void), startup_reset(void);
int last(int a), (*volatile pointer)(int);
%s
void app_tick(void) { %s }
void startup_reset(void) { %s }
void *vectors[] __attribute__((section(".vectors"))) = {0, startup_reset, app_tick, %s};
"""
LIMITS = "level startup_reset\nlevel app_tick\nboard small 1000 1000 %d\n"
tap = Tap()


def budget(path, *pairs):
    ran = subprocess.run(["tools/budget", path, *pairs], capture_output=True, text=True, check=False)
    return ran.returncode, ran.stdout, ran.stderr


images = {name: command[-1] for name, command in COMMANDS.items() if name != "board" and command[-1].endswith(".elf")}
code, table, complaints = budget(BUDGET, *(f"{name}={elf}" for name, elf in sorted(images.items())))
tap.check(code == 0 and all(name in table for name in images) and len(images) >= 5, "all boards keep to their budgets", *complaints.splitlines())
for row in table.splitlines():
    tap.note(row)
for name, elf in sorted(images.items()):
    ran = subprocess.run(["tools/check_symbols", elf], capture_output=True, text=True, check=False)
    tap.check(ran.returncode == 0, f"{name}: no forbidden symbol", ran.stdout, ran.stderr)

with tempfile.TemporaryDirectory() as folder:
    limits, source, elf = (os.path.join(folder, name) for name in ("budget", "a.c", "a.elf"))

    def look(rule, cpu, *parts, stack=400, extra=""):
        with open(source, "w", encoding="ascii") as text:
            text.write(PROGRAM % parts)
        with open(limits, "w", encoding="ascii") as text:
            text.write(LIMITS % stack + extra)
        subprocess.run([*shlex.split(COMPILE), *shlex.split(cpu), source, "-o", elf, "-lgcc"], check=True)
        code, table, complaints = budget(limits, f"small={elf}")
        return rule in complaints and code == 1 if rule else code == 0, table, complaints

    def red(name, rule, cpu, *parts, **options):
        holds, *told = look(rule, cpu, *parts, **options)
        tap.check(holds, name, *told)

    body = "int last(int a) { volatile int many[50]; many[a] = a; return many[0]; }"
    red("a small program passes", "", M3, body, "", "last(1);", "0")
    red("a stack that is too deep is told, with the way there", "small: the deepest way of main: startup_reset last", M3, body, "", "last(1);", "0", stack=200)
    red("a handler counts, and its frame: 36 bytes", "", M3, body, "", "last(1);", "0", stack=244)
    red("not a byte less", "small: stack 244 is over its budget of 243", M3, body, "", "last(1);", "0", stack=243)
    red("recursion", "recursion: last last", M3, "int last(int a) { return a ? last(a - 1) + a : 0; }", "", "last(1);", "0")
    call = "int last(int a) { return pointer(a) + 1; }"
    red("a call through a pointer", "last calls through a pointer", M3, call, "", "last(1);", "0")
    red("one that the budget resolves passes", "", M3, call, "", "last(1);", "0", extra="call last app_tick # ...")
    red("a frame of no fixed size", "last has no fixed frame", M3, "int last(int a) { volatile int many[a]; many[0] = a; return many[0]; }", "",
        "last(1);", "0")
    red("a handler of no level", "last is in no level", M3, body, "", "", "last")
    red("software floating point in the tick", "software floating point in the tick: __aeabi_fmul by app_tick", M3, "", "number *= number;", "", "0")
    red("but not with an FPU", "", M4F, "", "number *= number;", "", "0")
    code, _, complaints = budget(limits, f"other={elf}")
    tap.check(code == 1 and "other has no row" in complaints, "a board without a row", complaints)
tap.finish()
