/* A run as bytes: all that the plant, its detector, its measurement and its controller's demands have become since
 * reset, so that it goes on elsewhere with the same bits, verdicts and hash as if nothing had happened. Every field
 * stands for itself, in a fixed width, low byte first: the same image on every board, byte for byte. What follows from
 * the set is made anew. PROTOCOL.md lists the bytes. */
#ifndef SIM_SNAPSHOT_H
#define SIM_SNAPSHOT_H

#include <stdint.h>

#include "model/params.h"
#include "sim/input.h"
#include "sim/sim.h"

enum {
    SNAPSHOT_LAYOUT = 2, /* another number with every change of the bytes or of what they mean */
    SNAPSHOT_SIZE = 3927
};

/* The run of a plant that is in no fault, and the demands that wait for their steps. [ISR] */
void snapshot_take(uint8_t image[SNAPSHOT_SIZE], const struct sim *sim, const struct input_queue *waiting);

/* Can a run go on from this image? ERROR_OK, and the plan to go on with; or WRONG_CRC; WRONG_LAYOUT; what is wrong with
 * the set in it; OUT_OF_RANGE, and no parameter to blame, for a state that no run leads to, and that might do harm.
 * Some 5 KB of stack. [MAIN] */
struct params_problem snapshot_check(const uint8_t image[SNAPSHOT_SIZE], struct sim_plan *plan);

/* Puts a run back that has passed the check; sim_resume() has to follow. [ISR] */
void snapshot_restore(const uint8_t image[SNAPSHOT_SIZE], struct sim *sim, struct input_queue *waiting);

#endif
