/* The console's studies: what they ask for as words, their results as lines. The studies themselves are in
 * sim/study.h. */
#ifndef PROTOCOL_STUDYING_H
#define PROTOCOL_STUDYING_H

#include "protocol/console_parts.h"

/* The commands. [MAIN] */
void studying_scan(struct console *console);
void studying_margin(struct console *console);
void studying_occurrence(struct console *console);

/* Goes on with the one under way. Always true: something was done. [MAIN] */
bool studying_continue(struct console *console);

/* Ends the study under way with what it has, because a stop waits. [MAIN] */
void studying_cut_short(struct console *console);

#endif
