# Compiler flags of the core; with an FPU, its single precision alone: -mfpu=fpv4-sp-d16 -mfloat-abi=hard.
BOARD_CPU     := -mcpu=cortex-m3
BOARD_MAP     := linker/template.ld
# Drivers that fit the chip (hal/*.c, hal/cortex_m/systick.c), semihosting.c where a board is emulated, mpu_v8m.c for Armv8-M.
BOARD_SOURCES := hal/cortex_m/mpu_v7m.c

# Emulated by QEMU under this name: include hal/qemu.mk as well.
include hal/cortex_m/cortex_m.mk
