# The compiler of this machine, its C library, its memory functions.
BOARD_CC      := $(CC)
BOARD_CFLAGS  := -D_POSIX_C_SOURCE=200809L
BOARD_LDFLAGS :=
BOARD_LIBS    :=
BOARD_SOURCES := boards/host/socket.c
BOARD_RUN     :=
BOARD_SIZE    := size
BOARD_SUFFIX  :=

# Where the link listens, for make monitor and its like.
ifneq ($(LINK),)
export SQUEAL_LINK := unix:$(LINK)
endif
