/* The firmware as a POSIX process: the console is stdin and stdout, the link a socket. */
#ifndef BOARD_H
#define BOARD_H

#define BOARD_NAME "host"
#define BOARD_CORE "posix"

enum {
    BOARD_CLOCK_HZ = 25000000, /* as on the MPS2 boards, so that figures compare */
    BOARD_BAUD = 921600,
    BOARD_WRITE_MAX = 512 /* bytes that a pipe takes without waiting once it takes any: POSIX's least PIPE_BUF */
};

#endif
