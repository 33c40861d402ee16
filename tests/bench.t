#!/bin/sh
# The bench of the link counts turns on host and board, and says so where there is nothing to count.
program=${BENCH_LINK:?run by make test}
. "$(dirname "$0")/tap.sh"

run() { # exit code, text of its output, rest of the command
    code=$1
    text=$2
    shift 2
    timeout 100 "$@" >"$work/out" 2>&1
    [ $? -eq "$code" ] && grep -q "$text" "$work/out"
}

bench() { # exit code, text, the firmware
    code=$1
    text=$2
    shift 2
    run "$code" "$text" "$program" --turns 40 --socket "$work/socket" -- "$@"
}

# Listens, and sends a number of times what it is told to.
listener='import os, socket, sys
print(os.getpid(), file=open(sys.argv[1] + ".pids", "a"))
line = socket.socket(socket.AF_UNIX)
line.bind(sys.argv[1])
line.listen()
peer = line.accept()[0]
for _ in range(int(sys.argv[3])):
    peer.sendall(bytes.fromhex(sys.argv[2]))
while peer.recv(1000):
    pass'

nobody_is_left() {
    cp "$work/socket.pids" "$work/out"
    [ "$(wc -l <"$work/out")" -eq 3 ] && for pid in $(cat "$work/out"); do ! kill -0 "$pid" 2>&- || return 1; done
}

ok 'it counts on the host' bench 0 'STEP of 10' "$HOST_IMAGE"
ok 'as the host is asked to' run 0 'STEP of 10' make -s --no-print-directory BOARD=host TURNS=40 bench-link
ok 'and on the board' run 0 'STEP of 10' make -s --no-print-directory BOARD="$BOARD" TURNS=40 bench-link
ok 'a firmware that does not start' bench 1 'does not listen' "$work/none"
ok 'one that ends' bench 1 'does not listen' true
ok 'one that is silent' bench 1 'no answer' python3 -c "$listener" "$work/socket" 00 0
ok 'one that says what is no frame' bench 1 'no answer' python3 -c "$listener" "$work/socket" 0102030400 1
ok 'one that never stops to' bench 1 'no answer' python3 -c "$listener" "$work/socket" 0102030400 1000000000
ok 'a command that is none' run 2 usage "$program" --turns 40
ok 'none of them is left' nobody_is_left
finish
