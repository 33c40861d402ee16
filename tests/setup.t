#!/bin/sh
# tools/setup in a world of its own: PATH holds nothing but small fakes, so tools can be missing, installed or broken.
root=$(pwd)
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
count=0
failed=0
everything='arm-none-eabi-gcc arm-none-eabi-ld qemu-system-arm gnuplot prove python3 make git timeout'

fake() { # name, script
    printf '#!/bin/sh\n%s\n' "$2" >"$work/bin/$1"
    /bin/chmod +x "$work/bin/$1"
}

world() { # user id; a world with all tools, apt-get and sudo
    /bin/rm -rf "${work:?}/bin" "$work/log"
    /bin/mkdir "$work/bin"
    for tool in $everything; do
        fake "$tool" ''
    done
    fake cc 'echo "/lib/${1#-print-file-name=}"'
    fake id "echo $1"
    fake env 'while case $1 in *=*) ;; *) false ;; esac; do export "$1"; shift; done; exec "$@"'
    /bin/ln -s /bin/sed "$work/bin/sed"
    fake apt-get "echo \"apt-get \$* \$DEBIAN_FRONTEND\" >>$work/log"
    fake sudo 'SUDO=yes; export SUDO; [ "$1" = -n ] && shift; exec "$@"'
}

lose() { for tool in "$@"; do /bin/rm "$work/bin/$tool"; done; }

# A fake apt-get that does install: it makes the tools that were lost.
heal() { # tools
    fake apt-get "echo \"apt-get \$* \$DEBIAN_FRONTEND\" >>$work/log
        [ \$1 = update ] || for tool in $*; do echo '#!/bin/sh' >$work/bin/\$tool; /bin/chmod +x $work/bin/\$tool; done"
}

run() { # name, exit code, text of the output, text of apt-get's log ('' for none), arguments
    name=$1 code=$2 text=$3 logged=$4
    shift 4
    count=$((count + 1))
    out=$(PATH=$work/bin "$root/tools/setup" "$@" </dev/null 2>&1)
    seen=$?
    log=$(cat "$work/log" 2>/dev/null)
    good=yes
    [ "$seen" = "$code" ] || good=no
    case $out in *"$text"*) ;; *) good=no ;; esac
    case $log in *"$logged"*) ;; *) good=no ;; esac
    [ -n "$logged" ] || [ -z "$log" ] || good=no
    if [ $good = yes ]; then
        echo "ok $count - $name"
    else
        echo "not ok $count - $name"
        printf '%s\n' "exit $seen" "$out" "$log" | sed 's/^/# /'
        failed=$((failed + 1))
    fi
}

command='apt-get install -y --no-install-recommends'
unset SETUP

world 0
run 'nothing to do, nothing done' 0 '' ''
[ -z "$out" ] || { echo "# it should be silent: $out"; failed=$((failed + 1)); }

world 0
lose qemu-system-arm arm-none-eabi-ld
heal qemu-system-arm arm-none-eabi-ld
run 'root installs what is missing, and only that' 0 'missing: arm-none-eabi-ld qemu-system-arm' \
    "$command binutils-arm-none-eabi qemu-system-arm noninteractive"
case $log in 'apt-get update noninteractive'*) ;; *) echo '# the lists were not updated first'; failed=$((failed + 1)) ;; esac

world 1000
lose prove
heal prove
run 'another user goes through sudo' 0 "on Debian: $command perl" "$command perl noninteractive"

world 1000
lose sudo prove
run 'without sudo the command is named' 1 "on Debian: $command perl" ''

world 0
lose apt-get cc arm-none-eabi-gcc make git timeout python3
run 'without apt-get the packages are named' 1 \
    "$command gcc libc6-dev gcc-arm-none-eabi python3 make git coreutils" ''

world 0
lose python3
SETUP=no
export SETUP
run 'SETUP=no installs nothing' 1 "on Debian: $command python3" ''
lose gnuplot
run 'and names everything' 1 "$command gnuplot-nox python3" ''
world 0
lose gnuplot
run 'without gnuplot alone the rest goes on' 0 'pictures will be missing' ''
unset SETUP

world 0
lose gnuplot
run 'also where it cannot be installed' 0 'pictures will be missing' "$command gnuplot-nox"

world 0
lose qemu-system-arm
run 'what does not come is an error' 1 'still missing: qemu-system-arm' "$command qemu-system-arm"

world 0
lose gnuplot prove
fake apt-get "echo \"apt-get \$*\" >>$work/log
    case \"\$*\" in *gnuplot*) exit 100 ;; install*) echo '#!/bin/sh' >$work/bin/prove; /bin/chmod +x $work/bin/prove ;; esac"
run 'a gnuplot that cannot be had does not hold up the others' 0 'pictures will be missing' "$command perl"

world 0
fake cc 'echo "${1#-print-file-name=}"'
run 'a compiler without C library and sanitizers' 1 "$command libc6-dev gcc" "$command libc6-dev gcc"

world 0
SETUP=no
export SETUP
run 'a further tool is asked for by name' 1 "$command gdb-multiarch" '' gdb-multiarch
run 'clang with its fuzzer' 1 "$command clang libclang-rt-dev" '' clang
fake clang 'exit 1'
run 'a clang without it' 1 "missing: libFuzzer
setup: on Debian: $command libclang-rt-dev" '' clang
fake clang ''
run 'a clang that has it' 0 '' '' clang
lose clang
run 'is needed by the fuzzer alone' 0 '' ''
unset SETUP

echo "1..$count"
exit "$failed"
