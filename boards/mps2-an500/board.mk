# The chip could do double precision too; built without it, a double is a call that tools/check_symbols finds.
BOARD_CPU := -mcpu=cortex-m7 -mfpu=fpv5-sp-d16 -mfloat-abi=hard

include hal/mps2/mps2.mk
