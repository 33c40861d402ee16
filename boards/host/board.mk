# The compiler of this machine, its C library, its memory functions.
BOARD_CC      := $(CC)
BOARD_CFLAGS  := -D_POSIX_C_SOURCE=200809L
BOARD_LDFLAGS :=
BOARD_LIBS    :=
BOARD_SOURCES := boards/host/socket.c
# Where the link listens, if anywhere.
BOARD_RUN     := $(if $(LINK),env SQUEAL_LINK=unix:$(LINK))
BOARD_SUFFIX  :=
