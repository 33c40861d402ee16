# What the board.mk of a board includes that QEMU emulates under the board's name: how it is started. The console is on stdin
# and stdout, the link at LINK=, a socket, or nowhere. mux gives the UART, which holds one byte, a buffer of 32 in front: the
# next byte is there when one is read, without a round of the emulator's main loop. A mux listens for an escape character,
# which -echr makes one that no byte is.
COMMA     := ,
QEMU_LINK := $(if $(LINK),-chardev socket$(COMMA)id=link$(COMMA)path=$(LINK)$(COMMA)server=on$(COMMA)wait=off$(COMMA)mux=on \
             -serial chardev:link -echr 256,-serial null)
BOARD_RUN := qemu-system-arm -M $(BOARD) -icount shift=6,align=off,sleep=off -display none -monitor none \
             -semihosting-config enable=on,target=native -serial stdio $(QEMU_LINK) -kernel
