BOARD_CPU     := -mcpu=cortex-m4 -mfpu=fpv4-sp-d16 -mfloat-abi=hard
BOARD_MAP     := linker/stm32f405.ld
BOARD_SOURCES := boards/netduinoplus2/clocks.c hal/stm32_usart.c hal/cortex_m/systick.c hal/cortex_m/semihosting.c hal/cortex_m/mpu_v7m.c
# The link's other end: a socket at LINK=, or nobody.
COMMA         := ,
BOARD_LINK    := $(if $(LINK),unix:$(LINK)$(COMMA)server=on$(COMMA)wait=off,null)
BOARD_RUN     := qemu-system-arm -M netduinoplus2 -icount shift=6,align=off,sleep=off -display none -monitor none \
                 -semihosting-config enable=on,target=native -serial stdio -serial $(BOARD_LINK) -kernel

include hal/cortex_m/cortex_m.mk
