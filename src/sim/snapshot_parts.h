/* What the snapshot's files share. Not for anybody else. */
#ifndef SIM_SNAPSHOT_PARTS_H
#define SIM_SNAPSHOT_PARTS_H

#include "base/bytes.h"
#include "sim/snapshot.h"

/* A field goes out of its place where there is a writer, and else into it. */
struct snapshot_walk {
    struct bytes_writer *writer;
    struct bytes_reader *reader;
    bool is_q27; /* the arithmetic in use */
    bool is_bad; /* something was read that no field of its kind holds */
};

/* The set in force, and the units that an earlier one may have latched. Tells the arithmetic of what follows. */
void snapshot_walk_set(struct snapshot_walk *walk, struct params *params, struct scale *latched);

/* All that has become of it. With a writer nothing of it is changed. */
void snapshot_walk_run(struct snapshot_walk *walk, struct sim *sim, struct input_queue *waiting);

/* Is a state with finite floats and true truth values one that may go on under its plan: nothing in it that leads
 * outside an array, divides by 0, overflows, or never ends? */
bool snapshot_is_sound(const struct sim *sim, const struct input_queue *waiting, const struct sim_plan *plan);

#endif
