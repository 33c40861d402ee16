#!/bin/sh
# Two clones in different folders build the same firmware, byte for byte.
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
board=mps2-an386
for clone in one a/folder/whose/name/is/longer; do
    git clone -q . "$work/$clone" && make -s -C "$work/$clone" SETUP=no BOARD=$board build/$board/squeal.elf >"$work/out" 2>&1 || {
        echo "not ok 1 - a clone builds"
        sed 's/^/# /' "$work/out"
        echo 1..1
        exit 1
    }
done
if cmp "$work/one/build/$board/squeal.elf" "$work/$clone/build/$board/squeal.elf"; then
    echo "ok 1 - two clones in different folders make the same firmware"
else
    echo "not ok 1 - two clones in different folders make the same firmware"
    exit=1
fi
echo 1..1
exit ${exit-0}
