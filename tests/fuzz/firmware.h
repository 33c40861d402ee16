/* The firmware's own program, src/app/main.c, as functions: what a round of its loop does is not copied here. */
#ifndef FUZZ_FIRMWARE_H
#define FUZZ_FIRMWARE_H

#include "protocol/console.h"
#include "protocol/link.h"

/* What the program consists of, to be looked at. */
extern const struct firmware {
    const struct executive *executive;
    const struct console *console;
    const struct link *link;
    const struct turn *turn;
    const struct text *console_text, *link_text;
} firmware;

/* As after power on. */
void firmware_start(void);

/* One round of the main loop. */
void firmware_round(void);

/* Are there bytes that the program has read, and neither console nor link has taken? */
bool firmware_has_input(void);

#endif
