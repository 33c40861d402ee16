/* What snapshot.c and snapshot_check.c share. Not for anybody else. */
#ifndef SIM_SNAPSHOT_PARTS_H
#define SIM_SNAPSHOT_PARTS_H

#include "sim/snapshot.h"

/* Is a state with finite floats and true truth values one that may go on under its plan: nothing in it that leads outside an
 * array, divides by 0, overflows, or never ends? */
bool snapshot_is_sound(const struct sim *sim, const struct input_queue *waiting, const struct sim_plan *plan);

#endif
