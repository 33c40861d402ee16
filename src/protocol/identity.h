/* Who is speaking, and over which line. */
#ifndef PROTOCOL_IDENTITY_H
#define PROTOCOL_IDENTITY_H

#include <stdbool.h>
#include <stdint.h>

struct identity {
    const char *version, *build, *board, *core;
    bool is_emulated, has_fpu;
    bool has_link; /* a UART of its own for the link */
    uint32_t baud; /* of the line */
};

#endif
