#!/bin/sh
# The monitor's parts, and its pictures of two scenes as they are kept in tests/monitor. UPDATE=1 writes those anew: look
# at what git says of the difference.
program=${PICTURES:?run by make test}
kept=$(dirname "$0")/monitor
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
timeout 120 "$program" >"$work/parts"
failed=$?
grep -v '^1\.\.' "$work/parts"
count=$(grep -c 'ok ' "$work/parts")
[ "$count" -gt 0 ] || failed=1

ok() { # name, then whether it holds
    count=$((count + 1))
    if [ "$2" -eq 0 ]; then
        echo "ok $count - $1"
    else
        echo "not ok $count - $1"
        sed 's/^/# /' "$work/out"
        failed=1
    fi
}

compare() { # name of the file, what it shows, then the program's arguments
    name=$1
    claim=$2
    shift 2
    if [ -n "$UPDATE" ]; then
        "$program" "$@" >"$kept/$name.txt"
    fi
    "$program" "$@" >"$work/seen"
    diff "$kept/$name.txt" "$work/seen" >"$work/out" 2>&1
    ok "$claim" $?
}

compare 80x24 'squeal at 80 x 24' screen 24 80 squeal
compare 120x40 'at 120 x 40' screen 40 120 squeal
compare 160x50 'at 160 x 50, in larger letters' screen 50 160 squeal
compare 72x20 'a fault at the least size' screen 20 72 fault
compare 72x20-squeal 'squeal there: zeros make room for counters that are none' screen 20 72 squeal
compare ascii 'in ASCII' screen 24 80 fault ascii
compare low 'too low a screen says so' screen 19 72 squeal
compare narrow 'and too narrow a one' screen 20 71 squeal
compare help 'help' screen 24 80 squeal help
compare presets 'the presets' screen 20 72 fault presets
compare line 'a line for a pipe' line fault
"$program" screen 24 80 fault ascii | LC_ALL=C grep -q '[^ -~]' >"$work/out" 2>&1
ok 'ASCII is ASCII' $((1 - $?))
echo "1..$count"
[ "$failed" -eq 0 ]
