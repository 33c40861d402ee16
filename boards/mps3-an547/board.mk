# Without vector instructions, which flush subnormals, and without double precision, which tools/check_symbols would not find.
BOARD_CPU     := -mcpu=cortex-m55+nomve -mfpu=fpv5-sp-d16 -mfloat-abi=hard
BOARD_MAP     := linker/mps3-an547.ld
BOARD_SOURCES := hal/cmsdk_uart.c hal/cortex_m/uart_inbox.c hal/cortex_m/systick.c hal/cortex_m/semihosting.c \
                 hal/cortex_m/mpu_v8m.c

include hal/qemu.mk hal/cortex_m/cortex_m.mk
