# Without vector instructions, which flush subnormals, and without double precision, which tools/check_symbols would not find.
BOARD_CPU     := -mcpu=cortex-m55+nomve -mfpu=fpv5-sp-d16 -mfloat-abi=hard
BOARD_MAP     := linker/mps3-an547.ld
BOARD_SOURCES := hal/cmsdk_uart.c hal/cortex_m/systick.c hal/cortex_m/semihosting.c hal/cortex_m/mpu_v8m.c
# The link's other end: a socket at LINK=, or nobody.
COMMA         := ,
BOARD_LINK    := $(if $(LINK),unix:$(LINK)$(COMMA)server=on$(COMMA)wait=off,null)
BOARD_RUN     := qemu-system-arm -M mps3-an547 -icount shift=6,align=off,sleep=off -display none -monitor none \
                 -semihosting-config enable=on,target=native -serial stdio -serial $(BOARD_LINK) -kernel

include hal/cortex_m/cortex_m.mk
