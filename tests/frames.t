#!/bin/sh
# Frames through a bad line: none arrives that was not sent, and the campaign sees it where one does.
program=${CAMPAIGN:?run by make test}
. "$(dirname "$0")/tap.sh"

run() { # exit code, then options
    code=$1
    shift
    timeout 60 "$program" "$@" >"$work/out" 2>&1
    [ $? -eq "$code" ]
}

value() { # name of a row
    awk -v name="$1" 'index($0, name " ") == 1 { print $NF }' "$work/out"
}

is() { # name of a row, low, high
    seen=$(value "$1")
    [ -n "$seen" ] && [ "$seen" -ge "$2" ] && [ "$seen" -le "$3" ]
}

# 24 bytes of payload are 37 on the line, which pass with probability (1 - BER)^296; limits are four sigma from that.
ok 'one bit in 1000 wrong: no wrong accept, every byte accounted for' run 0 --frames 3e5 --ber 1e-3 --payload 24-24
ok 'as many frames are hit as should be' is 'hit by the line' 75940 77853
ok 'one in 100' run 0 --frames 3e5 --ber 1e-2 --payload 24-24
ok 'as many frames are hit as should be' is 'hit by the line' 284202 285166
ok 'payloads of 0 to 48 bytes' run 0 --frames 3e5 --ber 1e-2
ok 'of 0 to 240, bytes dropped, doubled and swapped' run 0 --frames 3e4 --ber 1e-4 --drop 1e-3 --double 1e-3 --swap 1e-3 --payload 0-240
ok 'some merge into pieces that are too long' is 'pieces refused: too long' 1 1000
ok 'a good line' run 0 --frames 1e4 --ber 0
ok 'loses nothing' is 'delivered intact' 10000 10000

# Of the CRC only k bits: what is refused without them is then accepted once in 2^k, more or less.
ok 'a check of 8 bits is seen to accept wrong frames' run 1 --frames 3e5 --ber 1e-2 --crc-bits 8
expected=$(($(value 'pieces refused: CRC') / 256))
ok 'about one in 256' is 'WRONG ACCEPTS' $((expected * 2 / 3)) $((expected * 3 / 2))
ok 'one of 12 bits' run 1 --frames 3e5 --ber 1e-2 --crc-bits 12
expected=$(($(value 'pieces refused: CRC') / 4096))
ok 'about one in 4096' is 'WRONG ACCEPTS' $((expected / 2)) $((expected * 2))
ok 'a line where nothing arrives proves nothing' run 1 --frames 1000 --ber 0.3
ok 'an option that is none' run 2 --frame 7
finish
