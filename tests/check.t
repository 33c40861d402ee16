#!/bin/sh
# The checks of the tree pass, and each of them fails on what it is there to find.
root=$(pwd)
. "$(dirname "$0")/tap.sh"

red() { # name, text that the complaint must hold, then the command that must fail
    name=$1
    text=$2
    shift 2
    ok "$name" quietly sh -c 'text=$1; shift; out=$("$@" 2>&1) && exit 1; echo "$out"; case $out in *"$text"*) ;; *) exit 1 ;; esac' \
        - "$text" "$@"
}

plant() { # file, its lines: a tree with one source and nothing else
    rm -rf "$work/tree"
    mkdir -p "$work/tree/src/base" "$work/tree/hal" "$work/tree/boards" "$work/tree/$(dirname "$1")"
    echo '#include <stdint.h>' >"$work/tree/src/base/clean.h"
    printf '%b\n' "$2" >"$work/tree/$1"
}

layers() { # name, file, its lines, complaint
    plant "$2" "$3"
    red "layers: $1" "$4" "$root/tools/check_layers" "$work/tree"
}

ok 'tables in documents are those of the code' quietly tools/gen_tables --check
ok 'layers hold' quietly tools/check_layers
layers 'an include against the arrow' src/model/a.c '#include "sim/b.h"' 'src/model/a.c:1: include against the arrow: sim/b.h'
layers 'the hal below app' src/protocol/a.c '#include "hal_uart.h"' 'not for this layer: hal_uart.h'
layers 'a board in app' src/app/a.c '#include "cortex_m/nvic.h"' 'not for this layer: cortex_m/nvic.h'
layers 'a layer in a board' boards/a.c '#include "sim/sim.h"' 'hal and boards may include base only: sim/sim.h'
layers 'a C library' src/sim/a.c '#include <string.h>' 'not a freestanding header: string.h'
layers 'a relative path' src/sim/a.c '#include "../model/a.h"' 'relative include'
layers 'volatile' src/sim/a.c '/* volatile\n * */ int a;\nvolatile int b;' 'src/sim/a.c:3: volatile or assembly'
layers 'assembly' src/base/a.c '__asm__("nop");' 'volatile or assembly'
plant src/sim/a.c '/* a volatile\n thing */ #include "base/clean.h"\n#include "model/a.h"\n#include <stdint.h>\nint not_volatile; // "asm"'
ok 'layers: what is allowed passes' quietly "$root/tools/check_layers" "$work/tree"
red 'layers: a missing tree' 'no src' "$root/tools/check_layers" "$work"

ok 'every field of a run is in its snapshot' quietly tools/check_snapshot
forget() { # name, file, a line to plant after another, complaint
    rm -rf "$work/tree"
    mkdir -p "$work/tree"
    cp -r src "$work/tree"
    sed -i "/$3/a\\    $4" "$work/tree/src/$2"
    red "snapshot: $1" "$5" "$root/tools/check_snapshot" "$work/tree"
}
forget 'a forgotten field' sim/detector.h '^    uint32_t evidence;' 'bool is_new;' 'struct detector: is_new is not in the snapshot'
forget 'one of two in a line' sim/measure.h '^    int32_t level;' 'int32_t x1, x_new[3]; \/* why *\/' 'struct measure: x_new is not in the snapshot'
forget 'one that another struct has' sim/sim.h '^    uint32_t caps;' 'uint32_t crossings;' 'struct sim_counters: crossings is not in the snapshot'
forget 'another struct' sim/sim.h '^    struct watch watch;' 'struct handoff measure;' 'struct handoff is not known here'
rm "$work/tree/src/sim/snapshot_walk.c"
red 'snapshot: a missing file' 'no src/sim/snapshot_walk.c' "$root/tools/check_snapshot" "$work/tree"
rm -rf "$work/tree"

symbols() { # name, source text, complaint
    printf '%b\n' "$2" >"$work/a.c"
    arm-none-eabi-gcc $cpu -mthumb -O1 -ffreestanding -c "$work/a.c" -o "$work/a.o" || exit 1
    red "symbols: $1" "$3" tools/check_symbols "$work/a.o"
}

case $IMAGE in
*.elf)
    ok 'no forbidden symbol in the firmware' quietly tools/check_symbols "$IMAGE"
    ok 'nor in the controller' quietly tools/check_symbols "$CONTROLLER"
    ;;
esac
cpu='-mcpu=cortex-m4 -mfpu=fpv4-sp-d16 -mfloat-abi=hard'
symbols 'software double' 'float f(float x) { return x * 0.1; }' 'double precision: __aeabi_d2f __aeabi_dmul __aeabi_f2d'
symbols '64-bit division' 'unsigned long long f(unsigned long long a, unsigned long long b) { return a / b; }' '64-bit division: __aeabi_uldivmod'
symbols 'allocation and output' 'void *malloc(unsigned); int printf(const char *, ...);\nvoid *f(int n) { printf("%d", n); return malloc(n); }' 'C library: malloc printf'
cpu='-mcpu=cortex-m7 -mfpu=fpv5-d16 -mfloat-abi=hard'
symbols 'hardware double' 'double f(double x) { return x * x; }' 'double precision: '
red 'symbols: a missing file' 'none.elf' tools/check_symbols "$work/none.elf"

# A board that is still to be written: an error for each function of the hal, and one for the vectors.
template() {
    env -u MAKEFLAGS -u MAKELEVEL make -s SETUP=no BOARD=template "OUT_BOARD=$work/template" "$work/template/boards/template/board.o" >"$work/errors" 2>&1 && return 1
    sed -n 's/.*error: #error "\([a-z_]*\): .*/\1/p' "$work/errors" | grep -vx vectors | sort >"$work/told"
    sed -n 's/^[a-z][a-z0-9_ ]* \**\(hal_[a-z_]*\)(.*/\1/p' hal/hal_*.h | sort >"$work/wanted"
    [ "$(grep -c 'error:' "$work/errors")" -eq $(($(wc -l <"$work/wanted") + 1)) ] && diff "$work/wanted" "$work/told"
}
ok 'the template of a board says what is missing, an error a function' quietly template

ok 'documents hold' quietly tools/check_docs
cp Makefile "$work"
echo 'See [here](nowhere.md).' >"$work/a.md"
red 'documents: a dead link' 'no such file: nowhere.md' "$root/tools/check_docs" "$work"
echo 'Type `make coffee`, then `make test`.' >"$work/a.md"
red 'documents: an unknown target' 'no such target: make coffee' "$root/tools/check_docs" "$work"
page() { # name, the page, complaint
    printf '%b\n' "$2" >"$work/a.md"
    red "documents: $1" "$3" "$root/tools/check_docs" "$work"
}
page 'a file that is none' 'The rules are in `sim/nowhere.c`, the links in `a.md`.' 'no file of this name: sim/nowhere.c'
page 'a number not filled in' 'It takes {count} steps.' 'not filled in: {count}'
page 'an empty table' '<!-- table: numbers -->\n\n<!-- end -->' 'a.md:3: nothing between the markers'
page 'an empty place in a line' 'It takes <!-- steps --> <!-- end --> steps.' 'a.md:1: nothing between the markers'
printf '%s\n' '<!-- table: x -->' '| `a.md` |' '<!-- end -->' 'Then <!-- y --> 5 <!-- end -->.' >"$work/a.md"
ok 'documents: a page that is filled in passes' quietly "$root/tools/check_docs" "$work"

ok 'the formatting is that of .clang-format' quietly sh -c 'clang-format --dry-run -Werror $(git ls-files "*.c" "*.h") </dev/null'
printf 'int  f( void ){return 0;}\n' >"$work/a.c"
red 'formatting: a file that has another' 'code should be clang-formatted' \
    clang-format --style=file:"$root/.clang-format" --dry-run -Werror "$work/a.c"

summary() { # name, last line, then the commands that make a test script
    printf '#!/bin/sh\n%s\n' "$3" >"$work/a.t"
    chmod +x "$work/a.t"
    ok "summary: $1" quietly sh -c 'out=$(tools/tap_summary "$1" 2>&1); code=$?; echo "$out"
        [ "$(echo "$out" | tail -n 1)" = "$2" ] && { [ $code = 0 ] && good=yes || good=no; [ $good = "$3" ]; }' \
        - "$work/a.t" "$2" "${4:-no}"
}

summary 'passed' '2 passed, 0 failed' 'echo "ok 1"; echo "ok 2"; echo "1..2"' yes
summary 'a failure' '1 passed, 1 failed' 'echo "ok 1"; echo "not ok 2"; echo "1..2"; exit 1'
summary 'a crash after all passed' '2 passed, 1 failed' 'echo "1..2"; echo "ok 1"; echo "ok 2"; kill -SEGV $$'
summary 'a missing plan' '1 passed, 1 failed' 'echo "ok 1"'
summary 'a broken plan' '1 passed, 1 failed' 'echo "1..3"; echo "ok 1"'
summary 'no output' '0 passed, 1 failed' ':'
summary 'a missing tool' '0 passed, 1 failed' 'exec no-such-tool-here'
summary 'a skipped test' '1 passed, 1 failed' 'echo "1..2"; echo "ok 1"; echo "ok 2 # SKIP no tool"'
summary 'a skipped script' '0 passed, 1 failed' 'echo "1..0 # SKIP no tool"'

finish
