BOARD_CPU     := -mcpu=cortex-m4 -mfpu=fpv4-sp-d16 -mfloat-abi=hard
BOARD_MAP     := linker/stm32f405.ld
BOARD_SOURCES := boards/netduinoplus2/clocks.c hal/stm32_usart.c hal/cortex_m/uart_inbox.c hal/cortex_m/systick.c \
                 hal/cortex_m/semihosting.c hal/cortex_m/mpu_v7m.c
# Its RAM is too small for the unit tests; those of the board itself run.
BOARD_UNIT    := tests/unit/tap.c tests/target/alone.c

include hal/qemu.mk hal/cortex_m/cortex_m.mk
