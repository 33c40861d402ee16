# What the board.mk of every MPS2 image includes, after BOARD_CPU.
BOARD_MAP     := linker/mps2.ld
BOARD_ECHO    := tests/bench/link/echo.c
BOARD_SOURCES := hal/mps2/mps2.c hal/cmsdk_uart.c hal/cmsdk_timer.c hal/cortex_m/uart_inbox.c hal/cortex_m/semihosting.c \
                 hal/cortex_m/mpu_v7m.c

include hal/qemu.mk hal/cortex_m/cortex_m.mk
