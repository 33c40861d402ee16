#!/bin/sh
# The golden tables, measured by the firmware through its own console: with the exact normal direction at 64 steps a period
# on the board in its own arithmetic and on the host in the other; on the host with RK4 throughout at 128, fixed point by the
# table of options alone. That host and boards give the same bits is another test's claim.
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
        [ $arith = "$default" ] || golden host $table $arith 64 exact "$HOST_IMAGE"
    done
    golden host $table f32 128 rk4 "$HOST_IMAGE"
done
golden host options q27 128 rk4 "$HOST_IMAGE"

# RK4 on the raw sign must not pass: a comparison that cannot fail proves nothing.
sed -n '1p;/^fig5_N10,/p' tests/golden/paper.csv >"$work/fig5_N10.csv"
for method in event naive; do
    count=$((count + 1))
    timeout 60 "$TOOL" golden --cases "$work/fig5_N10.csv" --out "$work/out.csv" --spp 64 --normal rk4 --method $method \
        --arith f32 -- "$HOST_IMAGE" >"$work/log" 2>&1
    case $method:$(tail -n 1 "$work/log") in
    'event:1 passed, 0 failed') echo "ok $count - located stick-slip of fig5_N10 passes with RK4" ;;
    'naive:0 passed, 1 failed') echo "ok $count - RK4 on the raw sign is told from it" ;;
    *)
        echo "not ok $count - fig5_N10 by the method $method"
        failed=$((failed + 1)) ;;
    esac
    sed 's/^/# /' "$work/log"
done
echo "1..$count"
[ $failed -eq 0 ]
