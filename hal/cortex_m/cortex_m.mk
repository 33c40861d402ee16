# What the board.mk of every Cortex-M board includes, after BOARD_CPU, BOARD_MAP and its own BOARD_SOURCES.
BOARD_CC       := arm-none-eabi-gcc
# Scheduled before registers are given out, a step of RK4 holds more at a time than there are registers.
BOARD_CFLAGS   := $(BOARD_CPU) -mthumb -ffreestanding -fno-math-errno -fno-common -ffunction-sections -fdata-sections \
                  -fno-schedule-insns
BOARD_LDFLAGS  := -nostdlib -T $(BOARD_MAP) -Wl,--gc-sections -Wl,--fatal-warnings
# Unit tests pass whole sets by value: a map whose RAM has the room gives them this stack.
BOARD_LDFLAGS_UNIT := -Wl,--defsym=test_stack_size=0x10000
BOARD_LIBS     := -lgcc
BOARD_SOURCES  += hal/cortex_m/startup.c hal/cortex_m/faults.c src/base/mem.c
BOARD_SUFFIX   := .elf
