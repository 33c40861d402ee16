#!/bin/sh
# Two clones in different folders build the same firmware, byte for byte.
. "$(dirname "$0")/tap.sh"

image=build/mps2-an386/squeal.elf
build() { # folder of a new clone
    git clone -q . "$work/$1" && env -u MAKEFLAGS -u MAKELEVEL make -s -C "$work/$1" SETUP=no BOARD=mps2-an386 "$image"
}

ok 'a clone builds' quietly build one
ok 'and another, in a folder of another depth' quietly build a/folder/whose/name/is/longer
ok 'both make the same firmware' quietly cmp "$work/one/$image" "$work/a/folder/whose/name/is/longer/$image"
finish
