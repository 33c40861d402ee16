BOARD_CPU := -mcpu=cortex-m3

include hal/mps2/mps2.mk
