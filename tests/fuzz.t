#!/bin/sh
# A million random inputs on console and link, the same ones every time; before them the corpus, by the ordinary compiler.
fuzzer=${FUZZER:?run by make test}
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
count=0
failed=0
RUNS=1000000

ok() { # name, then the command that must succeed
    name=$1
    shift
    count=$((count + 1))
    if "$@" >"$work/out" 2>&1; then
        echo "ok $count - $name"
    else
        echo "not ok $count - $name"
        grep -v 'NEW\|REDUCE\|^#' "$work/out" | tail -n 40 | sed 's/^/# /'
        failed=$((failed + 1))
    fi
}

corpus=$(LC_ALL=C ls tests/fuzz/corpus | sed 's,^,tests/fuzz/corpus/,')
echo "$corpus" | paste -sd, - >"$work/inputs"

# shellcheck disable=SC2086 # Lists.
ok 'the corpus, by the ordinary compiler' timeout 60 "${REPLAY:?run by make test}" $corpus
# No corpus folder, so that the order of its files does not matter, and nothing is written.
million() {
    timeout 2400 "$fuzzer" $FUZZ_OPTIONS -dict=build/fuzz/dictionary -seed=1 -runs=$RUNS -seed_inputs="@$work/inputs" \
        -artifact_prefix=build/fuzz/ && grep -q "^Done $RUNS runs" "$work/out"
}
ok "$RUNS inputs break nothing" million
grep '^#.*DONE\|^Done' "$work/out" | sed 's/^/# /'
[ $failed = 0 ] || echo '# what to do with a file that is named there: tests/fuzz/README.md'
echo "1..$count"
[ $failed -eq 0 ]
