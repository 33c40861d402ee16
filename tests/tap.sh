# TAP for a shell script, which reads it with: . "$(dirname "$0")/tap.sh"
# It has a folder, $work, that goes when the script ends; what is in $work/out is told of a claim that does not hold.
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
count=0
failed=0

ok() { # claim, then the command that must succeed
    name=$1
    shift
    count=$((count + 1))
    if "$@"; then
        echo "ok $count - $name"
    else
        echo "not ok $count - $name"
        [ ! -e "$work/out" ] || sed 's/^/# /' "$work/out"
        failed=$((failed + 1))
    fi
}

# A command whose output is told of only if it fails: ok 'a claim' quietly the command
quietly() { "$@" >"$work/out" 2>&1; }

finish() {
    echo "1..$count"
    exit $((failed != 0))
}
