/* Numbered checks on standard output. */
#ifndef TAP_H
#define TAP_H

#include <stdbool.h>

void tap_check(bool holds, const char *claim);

/* The plan, and how many failed. */
int tap_end(void);

#endif
