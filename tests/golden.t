#!/bin/sh
# The golden tables, measured by the firmware through its own console: on the board with the exact normal direction at 64
# steps a period, on the host also in fixed point and with RK4 throughout at 128. That both give the same bits is another
# test's claim.
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
count=0
failed=0

golden() { # where, table, arithmetic, steps a period, normal method, command
    count=$((count + 1))
    where=$1 table=$2 arith=$3 spp=$4 normal=$5
    shift 5
    rows=$(($(wc -l <"tests/golden/$table.csv") - 1))
    if timeout 400 "$TOOL" golden --cases "tests/golden/$table.csv" --out "$work/out.csv" --spp "$spp" \
        --normal "$normal" --arith "$arith" --asymptotic --jobs 2 -- "$@" >"$work/log" 2>&1 &&
        [ "$(tail -n 1 "$work/log")" = "$rows passed, 0 failed" ]; then
        echo "ok $count - $where: $rows rows of $table, $arith, normal $normal, $spp steps a period"
    else
        echo "not ok $count - $where: $table, $arith, normal $normal, $spp steps a period"
        failed=$((failed + 1))
    fi
    sed 's/^/# /' "$work/log"
}

# The board's own arithmetic, which is q27 where there is no FPU.
# shellcheck disable=SC2086 # A command line.
default=$(printf 'get arith\r' | timeout 10 ${BOARD_RUN-} "$IMAGE" | sed -n 's/^ok get arith=\([a-z0-9]*\).*/\1/p')

for table in paper options; do
    golden "$BOARD" $table "$default" 64 exact $BOARD_RUN "$IMAGE"
    for arith in f32 q27; do
        golden host $table $arith 64 exact "$HOST_IMAGE"
        golden host $table $arith 128 rk4 "$HOST_IMAGE"
    done
done

# RK4 on the raw sign must not pass: a comparison that cannot fail proves nothing.
count=$((count + 1))
sed '1!s/^\(fig5_N10,[^,]*\),[^,]*/\1,0.02/' tests/golden/paper.csv | sed -n '1p;/^fig5_N10,/p' >"$work/wrong.csv"
if timeout 60 "$TOOL" golden --cases "$work/wrong.csv" --out "$work/out.csv" --spp 64 --normal exact --arith f32 \
    -- "$HOST_IMAGE" >"$work/log" 2>&1; then
    echo "not ok $count - a brake with twice the damping passes as the golden one"
    failed=$((failed + 1))
else
    echo "ok $count - a brake with twice the damping is told from the golden one"
fi
echo "1..$count"
[ $failed -eq 0 ]
