/* Text from elsewhere, made fit for a terminal. */
#ifndef SQUEAL_PRINTABLE_H
#define SQUEAL_PRINTABLE_H

#include <stddef.h>

enum { PRINTABLE_GROWTH = 4 }; /* times as long, at most */

/* Copies a 0-terminated text, cut to size: printable ASCII as it is, every other byte as \xNN, so that no control
 * sequence of a terminal gets through. Returns out. */
char *printable_copy(char *out, size_t size, const char *text);

#endif
