#!/bin/sh
# A million random inputs on console and link, the same ones every time; before them the corpus, by the ordinary compiler.
fuzzer=${FUZZER:?run by make test}
. "$(dirname "$0")/tap.sh"
RUNS=1000000

corpus=$(LC_ALL=C ls tests/fuzz/corpus | sed 's,^,tests/fuzz/corpus/,')
echo "$corpus" | paste -sd, - >"$work/inputs"

# shellcheck disable=SC2086 # Lists.
ok 'the corpus, by the ordinary compiler' quietly timeout 60 "${REPLAY:?run by make test}" $corpus
# No corpus folder, so that the order of its files does not matter, and nothing is written.
million() {
    timeout 2400 "$fuzzer" $FUZZ_OPTIONS -dict=build/fuzz/dictionary -seed=1 -runs=$RUNS -seed_inputs="@$work/inputs" \
        -artifact_prefix=build/fuzz/ >"$work/all" 2>&1 && grep -q "^Done $RUNS runs" "$work/all" && return
    grep -v 'NEW\|REDUCE\|^#' "$work/all" | tail -n 40 >"$work/out"
    return 1
}
ok "$RUNS inputs break nothing" million
grep '^#.*DONE\|^Done' "$work/all" | sed 's/^/# /'
[ $failed = 0 ] || echo '# what to do with a file that is named there: tests/fuzz/README.md'
finish
