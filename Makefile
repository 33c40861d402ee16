# make help lists the targets. BOARD= names a folder of boards/, V=1 shows the commands.
# Everything goes to build/: build/<board>/ for firmware, build/tools/ and build/unit/ for programs of this machine.

BOARD  ?= mps2-an386
BOARDS := $(filter-out template,$(notdir $(patsubst %/board.mk,%,$(wildcard boards/*/board.mk))))
ifeq ($(filter $(BOARD),$(BOARDS) template),)
$(error there is no board '$(BOARD)'; the boards are: $(BOARDS))
endif
BOARDS_EMULATED := $(filter-out host,$(BOARDS))
.DEFAULT_GOAL := all

# As many jobs as processors, for the makes below too; -j on the command line has its way.
ifeq ($(MAKELEVEL),0)
MAKEFLAGS += -j$(shell nproc)
endif

Q := $(if $(V),,@)
say = $(if $(V),,@echo "  $(1) $(2)")

# --- How C is compiled: the same language, arithmetic and warnings everywhere ---------------------------------------
CFLAGS_ALL := -std=c99 -O2 -g -ffp-contract=off -ffile-prefix-map=$(CURDIR)=. -Isrc -MMD -MP \
              -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wundef -Wdouble-promotion -Wstrict-prototypes \
              -Wmissing-prototypes -Wcast-align -Wswitch-enum -Wvla -Werror
CFLAGS_HOSTED := $(CFLAGS_ALL) -D_POSIX_C_SOURCE=200809L
FUZZ_OPTIONS  := -max_len=128 -timeout=10 -entropic=0
SANITIZE      := -fsanitize=address,undefined -fno-sanitize-recover=all

LINK ?=
include boards/$(BOARD)/board.mk
CFLAGS_BOARD := $(CFLAGS_ALL) -Ihal -Iboards/$(BOARD) $(BOARD_CFLAGS)
MAKEFILES_READ := $(MAKEFILE_LIST)

# --- What is compiled -----------------------------------------------------------------------------------------------
# src/base/mem.c belongs to boards without a C library: their BOARD_SOURCES name it.
SOURCES       := $(filter-out src/base/mem.c,$(wildcard $(addprefix src/,$(addsuffix /*.c,base model analysis sim protocol))))
SOURCES_BOARD := $(sort $(BOARD_SOURCES)) boards/$(BOARD)/board.c
SOURCES_IMAGE := $(SOURCES) $(wildcard src/app/*.c) $(SOURCES_BOARD)
SOURCES_TOOL  := $(SOURCES) $(wildcard tools/squeal/*.c tools/squeal/*/*.c)
SOURCES_MERIT := $(filter-out src/protocol/%,$(SOURCES)) $(addprefix tools/squeal/support/,csv.c fields.c) $(wildcard tests/merit/*.c)
SOURCES_BENCH := $(filter src/base/% src/model/%,$(SOURCES)) src/protocol/frame.c src/protocol/master.c \
                 $(filter-out %/echo.c,$(wildcard tests/bench/link/*.c))
SOURCES_PICTURES := $(wildcard tests/monitor/*.c) tools/squeal/plot/spectrum.c $(addprefix tools/squeal/monitor/,canvas.c keys.c \
                    letters.c lines.c panels.c panels_overlay.c panels_plots.c panels_words.c picture.c screen.c trace.c)
SOURCES_CONVERGE := $(filter-out src/protocol/%,$(SOURCES)) $(filter-out tests/oracle/main.c,$(wildcard tests/oracle/*.c)) \
                    $(wildcard tests/converge/*.c) tools/squeal/support/broken.c
# The controller of tests/hil: all but its main is tested with the rest.
SOURCES_LAW   := $(filter-out %/main.c,$(wildcard tests/hil/controller/*.c))
UNIT_TESTS    := $(filter-out tests/unit/platform_host.c,$(wildcard tests/unit/*.c))
UNIT_BOARD    := $(or $(BOARD_UNIT),$(SOURCES_LAW) $(UNIT_TESTS))

OUT_BOARD  := build/$(BOARD)
IMAGE      := $(OUT_BOARD)/squeal$(BOARD_SUFFIX)
UNIT_IMAGE := $(OUT_BOARD)/unit$(BOARD_SUFFIX)
PROBE      := $(OUT_BOARD)/probe$(BOARD_SUFFIX)
CONTROLLER := $(OUT_BOARD)/controller$(BOARD_SUFFIX)
UNIT_HOST  := build/unit/host
TOOL       := build/tools/squeal
BOARDS_LIST := build/tools/boards
ORACLE     := build/tests/oracle
CAMPAIGN   := build/tests/frames
MERIT      := build/tests/merit
BENCH_LINK := build/tests/bench-link
# What the link's bench measures by, where the board has a UART of its own: an image that does nothing but answer.
ECHO       := $(if $(BOARD_ECHO),$(OUT_BOARD)/echo$(BOARD_SUFFIX))
BENCH      := $(OUT_BOARD)/bench$(BOARD_SUFFIX)
PICTURES   := build/tests/monitor
CONVERGE   := build/tests/converge
FUZZER     := build/fuzz/fuzzer
REPLAY     := build/unit/fuzz

OBJECTS_IMAGE := $(SOURCES_IMAGE:%.c=$(OUT_BOARD)/%.o)
OBJECTS_UNIT  := $(patsubst %.c,$(OUT_BOARD)/%.o,$(SOURCES) $(SOURCES_BOARD) $(UNIT_BOARD) tests/target/platform.c)
OBJECTS_PROBE := $(patsubst %.c,$(OUT_BOARD)/%.o,$(SOURCES) $(SOURCES_BOARD) tests/target/probe.c)
OBJECTS_CONTROLLER := $(patsubst %.c,$(OUT_BOARD)/%.o,$(SOURCES) $(SOURCES_BOARD) $(SOURCES_LAW) tests/hil/controller/main.c src/app/fault.c)
OBJECTS_HOST  := $(patsubst %.c,build/unit/%.o,$(SOURCES) $(SOURCES_LAW) $(UNIT_TESTS) tests/unit/platform_host.c)
OBJECTS_TOOL  := $(SOURCES_TOOL:%.c=build/tools/%.o)
OBJECTS_LINE  := $(patsubst %.c,build/tools/%.o,$(filter src/base/%,$(SOURCES)) src/protocol/frame.c $(wildcard tests/frames/*.c))
OBJECTS_PICTURES := $(SOURCES_PICTURES:%.c=build/unit/%.o)
OBJECTS_MERIT := $(SOURCES_MERIT:%.c=build/tools/%.o)
OBJECTS_CONVERGE := $(SOURCES_CONVERGE:%.c=build/tools/%.o)
OBJECTS_BENCH := $(SOURCES_BENCH:%.c=build/tools/%.o)
OBJECTS_REPLAY := $(patsubst %.c,build/unit/%.o,$(SOURCES) $(wildcard tests/fuzz/*.c))
OBJECTS_FUZZER := $(patsubst %.c,build/fuzz/%.o,$(SOURCES) $(filter-out tests/fuzz/files.c,$(wildcard tests/fuzz/*.c)))
OBJECTS_ECHO  := $(patsubst %.c,$(OUT_BOARD)/%.o,$(filter src/base/%,$(SOURCES)) $(SOURCES_BOARD) $(BOARD_ECHO))
OBJECTS_TARGET := $(patsubst %.c,$(OUT_BOARD)/%.o,$(filter-out src/protocol/%,$(SOURCES)) $(SOURCES_BOARD) src/app/isr.c src/app/fault.c \
                    $(wildcard tests/bench/target/*.c))
OBJECTS       := $(sort $(OBJECTS_TARGET) $(OBJECTS_IMAGE) $(OBJECTS_UNIT) $(OBJECTS_PROBE) $(OBJECTS_CONTROLLER) $(OBJECTS_HOST) $(OBJECTS_TOOL) \
                        $(OBJECTS_LINE) $(OBJECTS_MERIT) $(OBJECTS_PICTURES) $(OBJECTS_CONVERGE) $(OBJECTS_BENCH) \
                        $(OBJECTS_REPLAY) $(OBJECTS_FUZZER) $(if $(ECHO),$(OBJECTS_ECHO)))

# The commit's name is kept in a file that changes only when the name does.
BUILD_ID := $(or $(shell GIT_OPTIONAL_LOCKS=0 git describe --always --dirty 2>/dev/null),unknown)
ifneq ($(BUILD_ID),$(shell cat build/build_id 2>/dev/null))
$(shell mkdir -p build && echo '$(BUILD_ID)' >build/build_id)
endif

# --- Rules ----------------------------------------------------------------------------------------------------------
.PHONY: bench bench-images all run paper tool monitor console test golden oracle hil detector noise converge frames fuzz bench-link bench-link-on debug bits check size clean help setup setup-clang other-images tested-images host-image command
.DELETE_ON_ERROR:

all: $(IMAGE) $(CONTROLLER) ## build the firmware and the controller of tests/hil for BOARD (default mps2-an386)

$(OUT_BOARD)/%.o: %.c
	$(call say,CC,$@)
	$(Q)mkdir -p $(@D)
	$(Q)$(BOARD_CC) $(CFLAGS_BOARD) $(CFLAGS_EXTRA) -c $< -o $@
$(OUT_BOARD)/tests/%.o: CFLAGS_EXTRA := -Itests/unit -Itests

build/unit/%.o: %.c
	$(call say,CC,$@)
	$(Q)mkdir -p $(@D)
	$(Q)$(CC) $(CFLAGS_HOSTED) $(CFLAGS_EXTRA) $(SANITIZE) -c $< -o $@
build/unit/tests/%.o: CFLAGS_EXTRA := -Itests
build/unit/tools/%.o: CFLAGS_EXTRA := -Itools -D_XOPEN_SOURCE=700
build/unit/tests/monitor/%.o: CFLAGS_EXTRA := -I. -Itools -D_XOPEN_SOURCE=700
build/unit/tests/fuzz/%.o: CFLAGS_EXTRA := -Ihal

# The fuzzer is led by what the firmware does, and the firmware alone is watched by the sanitizers: the harness around it is
# by those of $(REPLAY). Comparisons are left out of what leads: they take as long as all the rest, and a dictionary has the
# words.
build/fuzz/%.o: %.c
	$(call say,CC,$@)
	$(Q)mkdir -p $(@D)
	$(Q)clang $(CFLAGS_HOSTED) -Ihal $(FUZZED) -c $< -o $@
build/fuzz/src/%.o build/fuzz/tests/fuzz/firmware.o: FUZZED := $(SANITIZE) -fsanitize=float-cast-overflow \
    -fsanitize=fuzzer-no-link -fno-sanitize-coverage=trace-cmp
$(OBJECTS_FUZZER): | setup-clang

build/tools/%.o: %.c
	$(call say,CC,$@)
	$(Q)mkdir -p $(@D)
	$(Q)$(CC) $(CFLAGS_HOSTED) $(CFLAGS_EXTRA) -c $< -o $@
build/tools/tools/%.o: CFLAGS_EXTRA := -Itools -D_XOPEN_SOURCE=700
build/tools/tests/merit/%.o build/tools/tests/converge/%.o: CFLAGS_EXTRA := -I. -Itools

# The compiler must not turn the body of memcpy into a call of memcpy.
$(OUT_BOARD)/src/base/mem.o: CFLAGS_EXTRA := -fno-tree-loop-distribute-patterns
$(OUT_BOARD)/src/app/version.o: CFLAGS_EXTRA := -DBUILD_ID='"$(BUILD_ID)"'
$(OUT_BOARD)/src/app/version.o: build/build_id

$(OBJECTS): $(MAKEFILES_READ) | setup
-include $(OBJECTS:.o=.d)

$(IMAGE): $(OBJECTS_IMAGE)
$(UNIT_IMAGE): $(OBJECTS_UNIT)
$(UNIT_IMAGE): BOARD_LDFLAGS += $(BOARD_LDFLAGS_UNIT)
$(PROBE): $(OBJECTS_PROBE)
$(CONTROLLER): $(OBJECTS_CONTROLLER)
$(ECHO): $(OBJECTS_ECHO)
$(BENCH): $(OBJECTS_TARGET)
$(IMAGE) $(UNIT_IMAGE) $(PROBE) $(CONTROLLER) $(ECHO) $(BENCH): $(wildcard linker/*.ld)
	$(call say,LD,$@)
	$(Q)$(BOARD_CC) $(CFLAGS_BOARD) $(BOARD_LDFLAGS) $(filter %.o,$^) -o $@ $(BOARD_LIBS)

$(UNIT_HOST): $(OBJECTS_HOST)
$(REPLAY): $(OBJECTS_REPLAY)
$(PICTURES): $(OBJECTS_PICTURES)
$(UNIT_HOST) $(REPLAY) $(PICTURES):
	$(call say,LD,$@)
	$(Q)mkdir -p $(@D)
	$(Q)$(CC) $(SANITIZE) $^ -o $@ -lm

$(FUZZER): $(OBJECTS_FUZZER)
	$(call say,LD,$@)
	$(Q)clang $(SANITIZE) -fsanitize=fuzzer $^ -o $@

build/fuzz/dictionary: tests/fuzz/dictionary $(wildcard src/*/*.def)
	$(Q)mkdir -p $(@D)
	$(Q)tests/fuzz/dictionary >$@

$(TOOL): $(OBJECTS_TOOL) | $(BOARDS_LIST)
$(CAMPAIGN): $(OBJECTS_LINE)
$(MERIT): $(OBJECTS_MERIT)
$(BENCH_LINK): $(OBJECTS_BENCH)
$(CONVERGE): $(OBJECTS_CONVERGE)
$(TOOL) $(CAMPAIGN) $(MERIT) $(BENCH_LINK) $(CONVERGE):
	$(call say,LD,$@)
	$(Q)mkdir -p $(@D)
	$(Q)$(CC) $^ -o $@ -lm

# How the tool starts each board: written anew each time, changed only when it differs.
$(BOARDS_LIST): boards-list
	$(Q)mkdir -p $(@D)
	$(Q)for board in $(BOARDS); do $(MAKE) -s --no-print-directory BOARD=$$board LINK=@LINK@ ROOT=$(CURDIR)/ command || exit; \
	done >$@.new
	$(Q)if cmp -s $@ $@.new; then rm $@.new; else mv $@.new $@; fi
.PHONY: boards-list
boards-list:

$(ORACLE): $(wildcard tests/oracle/*.[ch] tests/oracle/*.def) Makefile | setup
	$(call say,CC,$@)
	$(Q)mkdir -p $(@D)
	$(Q)$(CC) -std=c99 -O2 -ffp-contract=off -Wall -Wextra -D_POSIX_C_SOURCE=200809L -o $@ $(filter %.c,$^) -lm

# What make command prints, a line for each of these boards.
commands_of = $$(for board in $(1); do MAKEFLAGS= $(MAKE) -s --no-print-directory BOARD=$$board command; done)

# --- Use ------------------------------------------------------------------------------------------------------------
ROOT       ?=
PORT       := $(if $(filter host,$(BOARD)),host,qemu:$(BOARD))
PRESET     :=
COMMAND    := $(strip $(BOARD_RUN) $(ROOT)$(IMAGE))
CASES      ?= tests/golden/paper.csv
OUT        ?= build/golden
ARITH      ?= f32
SPP        ?= 64
NORMAL     ?= exact
METHOD     ?= event
POINTS     ?=
ASYMPTOTIC ?=
FRAMES     ?= 1000000
BER        ?= 1e-3
DROP       ?= 0
DOUBLE     ?= 0
SWAP       ?= 0
PAYLOAD    ?= 0-48
SEED       ?= 1
COUNT      ?= 10000
TURNS      ?= 5000
FUZZ_FOR   ?= 60
ONLY       ?=

run: $(IMAGE) $(TOOL) ## run the demonstration and the map, results in build/run (POINTS= of the map along an axis, 0: none)
	$(Q)$(TOOL) demo --board $(BOARD) --out build/run $(if $(POINTS),--points $(POINTS)) -- $(COMMAND)

monitor: $(IMAGE) $(TOOL) ## watch the plant in this terminal, keys turn force and speed (PORT= a device, PRESET= a set)
	$(Q)$(TOOL) monitor --port $(PORT) $(if $(PRESET),--preset $(PRESET))

console: $(IMAGE) ## talk to the firmware in this terminal (LINK= a path: the link listens on a socket there)
	@echo "Ctrl-C leaves. The firmware echoes; type help and Enter."
	@saved=$$(stty -g 2>/dev/null) && trap "stty $$saved" EXIT INT TERM && stty -icanon -echo; \
	SQUEAL_REALTIME=1 $(COMMAND)

golden: $(IMAGE) $(TOOL) ## run the cases of CASES= into OUT= (ARITH= SPP= NORMAL= METHOD= ASYMPTOTIC=1)
	$(Q)$(TOOL) golden --cases $(CASES) --out $(OUT) --spp $(SPP) --normal $(NORMAL) --method $(METHOD) --arith $(ARITH) \
	    $(if $(ASYMPTOTIC),--asymptotic) --jobs 2 -- $(COMMAND)

# On the host unless a board is asked for: on an emulated one it takes an hour.
PAPER_BOARD := $(if $(filter file default,$(origin BOARD)),host,$(BOARD))
paper: $(TOOL) ## run the whole paper on the firmware, on BOARD=host unless told: figures, numbers, claims in build/paper (ONLY=)
	$(Q)$(MAKE) --no-print-directory BOARD=$(PAPER_BOARD) all
	$(Q)$(TOOL) paper --port $(if $(filter host,$(PAPER_BOARD)),host,qemu:$(PAPER_BOARD)) --out build/paper --limit 60 \
	    --arith $(ARITH) --spp $(SPP) --method $(METHOD) $(if $(filter file,$(origin NORMAL)),,--normal $(NORMAL)) \
	    $(if $(ONLY),--only $(ONLY))

oracle: $(ORACLE) ## make golden rows for any parameters: the cases of CASES= into OUT=, by the reference solver
	$(Q)$(ORACLE) --cases $(CASES) --out $(OUT) --jobs 2

# Every seed and count has its own folder. The cases are drawn anew each time, but only a change of them, or of the oracle,
# makes the truth anew: that takes its time.
MERIT_OUT := build/detector/$(SEED)-$(COUNT)

hil: $(IMAGE) $(CONTROLLER) ## a second firmware brakes with the plant, in lockstep over the link; results in build/hil
	$(Q)COMMANDS="$(call commands_of,$(BOARD))" timeout 600 tests/hil/hil.py --board $(BOARD) --out build/hil

detector: $(MERIT) $(MERIT_OUT)/truth.csv ## the detector on COUNT= random cases of seed SEED= against the oracle (ARITH="f32 q27")
	$(Q)trap 'cat $(MERIT_OUT)/table.txt' EXIT; cp $(MERIT_OUT)/cases.txt $(MERIT_OUT)/table.txt; \
	$(MERIT) check --truth $(MERIT_OUT)/truth.csv --disagree $(MERIT_OUT)/disagree.csv \
	    --arith "$(if $(filter file,$(origin ARITH)),f32 q27,$(ARITH))" --jobs 2 >>$(MERIT_OUT)/table.txt

$(MERIT_OUT)/truth.csv: $(MERIT_OUT)/cases.csv $(wildcard tests/oracle/*.[ch] tests/oracle/*.def) | $(ORACLE)
	$(Q)$(ORACLE) --cases $< --out $@ --jobs 2 --progress 10

$(MERIT_OUT)/cases.csv: $(MERIT) draw
	$(Q)mkdir -p $(@D)
	$(Q)$(MERIT) cases --count $(COUNT) --seed $(SEED) --out $@.new >$(@D)/cases.txt
	$(Q)if cmp -s $@ $@.new; then rm $@.new; else mv $@.new $@; fi
.PHONY: draw
draw:

converge: $(CONVERGE) ## error against steps per period of ours and other methods, table and picture in build/converge
	$(Q)mkdir -p build/converge
	$(Q)$(CONVERGE) --out build/converge | tee build/converge/table.txt
	$(Q)gnuplot build/converge/converge.gp && echo "build/converge/converge.svg .png .csv"

noise: host-image ## measure how much roughness starts squeal from rest, and how much a stable brake bears
	$(Q)tools/starting_noise build/host/squeal

frames: $(CAMPAIGN) ## send FRAMES= frames over a line with bit errors BER= (DROP= DOUBLE= SWAP= a byte, PAYLOAD= SEED=)
	$(Q)$(CAMPAIGN) --frames $(FRAMES) --ber $(BER) --drop $(DROP) --double $(DOUBLE) --swap $(SWAP) --payload $(PAYLOAD) --seed $(SEED)

# What it learns stays in build/fuzz/corpus for the next time.
fuzz: $(FUZZER) $(REPLAY) build/fuzz/dictionary ## throw random bytes at console and link for FUZZ_FOR= seconds, in two processes
	$(Q)mkdir -p build/fuzz/corpus && cd build/fuzz && rm -f fuzz-*.log && \
	{ ./fuzzer $(FUZZ_OPTIONS) -dict=dictionary -jobs=2 -workers=2 -max_total_time=$(FUZZ_FOR) corpus ../../tests/fuzz/corpus \
	    </dev/null >/dev/null 2>&1; code=$$?; tail -qn 1 fuzz-*.log; \
	    [ $$code = 0 ] || ls -t crash-* timeout-* oom-* 2>/dev/null | sed 's,^,build/fuzz/,;s,$$, breaks something: tests/fuzz/README.md says what to do,'; \
	    exit $$code; }

bench: bench-images ## count instructions on every emulated board, compare, and prove the rates they can keep; results in build/bench
	$(Q)COMMANDS="$(call commands_of,$(BOARDS_EMULATED))" && \
	export COMMANDS && mkdir -p build/bench && \
	{ tests/bench/target/target.py --out build/bench || echo 'not ok: it ended so'; } | tee build/bench/table.txt && \
	! grep -q '^over\|^not ' build/bench/table.txt

bench-images:
	$(Q)for board in $(BOARDS_EMULATED); do $(MAKE) --no-print-directory BOARD=$$board tested-images || exit; done

# What starts the firmware depends on LINK=.
BENCH_SOCKET := $(OUT_BOARD)/bench.sock

bench-link: ## count turns of lockstep a second, beside what the line alone takes (TURNS=)
	$(Q)$(MAKE) --no-print-directory BOARD=$(BOARD) LINK=$(BENCH_SOCKET) bench-link-on

bench-link-on: $(IMAGE) $(ECHO) $(BENCH_LINK)
	$(Q)$(BENCH_LINK) --turns $(TURNS) --socket $(LINK) -- $(COMMAND) $(if $(ECHO),-- $(BOARD_RUN) $(ECHO))

test: tested-images $(UNIT_IMAGE) $(PROBE) $(UNIT_HOST) $(TOOL) $(ORACLE) $(CAMPAIGN) $(MERIT) $(PICTURES) $(CONVERGE) $(BENCH_LINK) $(ECHO) $(FUZZER) build/fuzz/dictionary $(REPLAY) other-images ## run everything that a change must pass
	$(Q)COMMANDS="$(call commands_of,$(BOARDS))" BOARD=$(BOARD) BOARD_RUN="$(BOARD_RUN)" IMAGE=$(IMAGE) CONTROLLER=$(CONTROLLER) UNIT_IMAGE=$(UNIT_IMAGE) PROBE=$(PROBE) \
	    UNIT_HOST=$(UNIT_HOST) HOST_IMAGE=build/host/squeal TOOL=$(TOOL) ORACLE=$(CURDIR)/$(ORACLE) CAMPAIGN=$(CAMPAIGN) MERIT=$(CURDIR)/$(MERIT) \
	    PICTURES=$(CURDIR)/$(PICTURES) CONVERGE=$(CURDIR)/$(CONVERGE) BENCH_LINK=$(BENCH_LINK) \
	    FUZZER=$(FUZZER) FUZZ_OPTIONS="$(FUZZ_OPTIONS)" REPLAY=$(REPLAY) tools/tap_summary $(wildcard tests/*.t tests/system/*.t)

bits: $(IMAGE) other-images ## compare the bits of all boards with the host's: f32 and q27, over a million steps each (5 minutes of processor time)
	$(Q)COMMANDS="$(call commands_of,$(BOARDS))" BOARD=$(BOARD) tests/system/bits.py

tool: $(TOOL) ## build the host tool, build/tools/squeal; see its --help

host-image: | setup
	$(Q)$(MAKE) --no-print-directory BOARD=host all

# One make a board: two at a time would write the same objects.
other-images: | setup
	$(Q)for board in $(filter-out $(BOARD),$(BOARDS)); do $(MAKE) --no-print-directory BOARD=$$board tested-images || exit; done

tested-images: $(IMAGE) $(CONTROLLER) $(if $(filter $(BOARD),$(BOARDS_EMULATED)),$(BENCH))

command: ## print "board: the command that starts its firmware"
	@echo "$(BOARD): $(COMMAND)"

debug: $(IMAGE) ## halt the emulated board at reset and attach gdb; the console goes to build/<board>/console.txt
	$(if $(BOARD_RUN),,$(error BOARD=host needs no emulator: gdb $(IMAGE)))
	$(Q)tools/setup gdb-multiarch
	$(Q)rm -f $(OUT_BOARD)/gdb.sock; \
	$(COMMAND) -S -chardev socket,path=$(OUT_BOARD)/gdb.sock,server=on,wait=off,id=gdb -gdb chardev:gdb \
	    </dev/null >$(OUT_BOARD)/console.txt & \
	trap "kill $$! 2>/dev/null; rm -f $(OUT_BOARD)/gdb.sock" EXIT; trap '' INT; \
	until [ -S $(OUT_BOARD)/gdb.sock ] || ! kill -0 $$! 2>/dev/null; do sleep 0.1; done; \
	gdb-multiarch -q -ex 'target remote $(OUT_BOARD)/gdb.sock' -ex 'break main' $(GDB_ARGS) $(IMAGE)

check: $(IMAGE) $(CONTROLLER) ## check layers, forbidden symbols, documents and the formatting
	$(Q)tools/check_layers
	$(Q)tools/check_symbols $(IMAGE)
	$(Q)tools/check_symbols $(CONTROLLER)
	$(Q)tools/check_snapshot
	$(Q)tools/check_docs
	$(Q)tools/gen_tables --check
	$(Q)! grep -nE '^.{121}' $$(git ls-files '*.c' '*.h')
	$(Q)clang-format --dry-run -Werror $$(git ls-files '*.c' '*.h')

size: $(IMAGE) other-images ## flash, RAM and deepest stack of every board against tests/budget.txt
	$(Q)tools/budget tests/budget.txt $(foreach board,$(filter-out host,$(BOARDS)),$(board)=build/$(board)/squeal.elf)

clean: ## remove build/
	$(Q)rm -rf build

setup: ## find the tools that are missing and install them (SETUP=no only names them)
	@tools/setup

setup-clang: setup
	@tools/setup clang clang-format

help: ## print this list
	@awk -F ':.*## ' '/^[a-z-]+:.*## / { printf "  make %-9s %s\n", $$1, $$2 }' Makefile
	@echo "  BOARD= one of: $(BOARDS)"
