#!/bin/sh
# What starts an unstable brake from its exact equilibrium, by the command that makes the table in DETECTOR.md.
out=$(timeout 60 tools/starting_noise "${HOST_IMAGE:?run by make test}" --presets brake --levels 0,preset,1e-4 \
    --periods 700 --stable-periods 4000)
count=0
failed=0

row() { # pattern of a row, claim
    count=$((count + 1))
    if echo "$out" | grep -qx "$1"; then
        echo "ok $count - $2"
    else
        echo "not ok $count - $2"
        echo "$out" | sed 's/^/# /'
        failed=$((failed + 1))
    fi
}

row '| 0 | [0-9]* | never | 0 | 0 |' 'without noise fixed point locks, and single precision starts from its rounding'
row '| preset | [0-9]* | [0-9]* | 0 | 0 |' 'the surface of the preset starts both, and leaves a stable brake quiet'
row '| 1e-4 | [0-9]* | [0-9]* | [1-9][0-9]* | [1-9][0-9]* |' 'a hundred times as much is watched'
echo "1..$count"
[ $failed -eq 0 ]
