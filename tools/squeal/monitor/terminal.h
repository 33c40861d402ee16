/* The terminal in the hands of a program that draws on all of it: keys one by one, the alternate screen, no cursor.
 * However the program ends, short of SIGKILL, the terminal is as it was. One terminal a process: standard input and
 * output. */
#ifndef SQUEAL_TERMINAL_H
#define SQUEAL_TERMINAL_H

#include <stdbool.h>

#include "squeal/monitor/screen.h"

/* Can it be drawn upon? Not if input or output is no terminal, or if it cannot move its cursor (TERM=dumb or none). */
bool terminal_can_draw(void);

/* What it can show, by TERM, COLORTERM, NO_COLOR and the locale's variables. */
struct screen_style terminal_style(void);

/* Takes it; INT, TERM, HUP and QUIT give it back before they take their course, that of the handlers there were. False
 * with errno. */
bool terminal_take(void);

/* Gives it back; does no harm if it is not taken. */
void terminal_give_back(void);

/* Stops this process as Ctrl-Z does, the terminal given back meanwhile. */
void terminal_suspend(void);

/* Its size now, which may have changed since; 24 x 80 if it does not tell. */
void terminal_size(int *rows, int *cols);

#endif
