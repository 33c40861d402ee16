#!/bin/sh
# The bench image counts on the boards whose budget is written down, and no step takes more than that.
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
: "${COMMANDS:?run by make test}"

timeout 200 tests/bench/target/target.py --quick --out "$work" >"$work/said" 2>"$work/errors"
code=$?
awk -v code=$code '
    $1 == "ok" || $1 == "over" {
        count++
        print ($1 == "ok" ? "" : "not ") "ok " count " - " $2 " " $3 " " $4 " " $5 " of " $7 " instructions"
        failed += $1 == "over"
    }
    END {
        count++
        print (code == 0 && count > 1 ? "" : "not ") "ok " count " - the bench image counts to its end"
        print "1.." count
        exit failed || code != 0 || count < 2
    }' "$work/said"
code=$?
sed 's/^/# /' "$work/errors"
exit $code
