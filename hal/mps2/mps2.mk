# What the board.mk of every MPS2 image includes, after BOARD_CPU.
BOARD_MAP     := linker/mps2.ld
BOARD_ECHO    := tests/bench/link/echo.c
BOARD_SOURCES := hal/mps2/mps2.c hal/cmsdk_uart.c hal/cmsdk_timer.c hal/cortex_m/semihosting.c hal/cortex_m/mpu_v7m.c
# The link's other end: a socket at LINK=, or nobody. mux gives the UART, which holds one byte, a buffer of 32 in front:
# the next byte is there when one is read, without a round of the emulator's main loop. A mux listens for an escape
# character, which -echr makes one that no byte is.
COMMA         := ,
MPS2_LINK     := $(if $(LINK),-chardev socket$(COMMA)id=link$(COMMA)path=$(LINK)$(COMMA)server=on$(COMMA)wait=off$(COMMA)mux=on \
                 -serial chardev:link -echr 256,-serial null)
BOARD_RUN     := qemu-system-arm -M $(BOARD) -icount shift=6,align=off,sleep=off -display none -monitor none \
                 -semihosting-config enable=on,target=native -serial stdio $(MPS2_LINK) -kernel

include hal/cortex_m/cortex_m.mk
BOARD_LDFLAGS_UNIT := -Wl,--defsym=test_stack_size=0x10000
