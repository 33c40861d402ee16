/* Random cases of five kinds, in turn. README.md has their ranges. */
#ifndef MERIT_DRAW_H
#define MERIT_DRAW_H

#include "dice.h"
#include "set.h"

enum draw_kind { DRAW_SOFT, DRAW_BRAKE, DRAW_DAMPED, DRAW_FLOORED, DRAW_REVERSED, DRAW_KINDS };

extern const char *const draw_kind_names[DRAW_KINDS];

/* One case. It may be one that the firmware refuses. */
struct set draw_set(struct dice *dice, enum draw_kind kind);

/* Writes the table of so many cases to a file that is open. Returns how many sets the firmware refused; others were
 * drawn in their place. */
long draw_table(FILE *file, long count, uint64_t seed);

#endif
