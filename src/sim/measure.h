/* What the plant did over a given number of steps: extremes, shares, frequency. Integer arithmetic on the plant's
 * output, the same for every number format. One measurement runs at a time; it is started at a step boundary and closes
 * itself. */
#ifndef SIM_MEASURE_H
#define SIM_MEASURE_H

#include <stdbool.h>
#include <stdint.h>

#include "model/plant.h"

/* In the units of struct plant_output unless said otherwise. */
struct measure {
    uint64_t planned, done; /* steps */
    int32_t x_max, x_min, v_max, v_min;
    uint64_t stick, slip_minus;   /* sums of shares, PLANT_SHARE_ONE a step */
    uint32_t crossings;           /* upward passages of the level, second half only */
    uint64_t first_q15, last_q15; /* their first and last instant, steps since the start in Q15 */
    int32_t level;                /* middle of the extremes of the first half */
    int32_t step_q27;             /* h in units of x per v */
    /* the two samples before the present one */
    int32_t x1, v1, v2;
    uint32_t smooth; /* samples in a row that lie in one slip regime without an event */
};

/* Starts at the present state, which counts as the first sample. [ISR] */
void measure_start(struct measure *measure, const struct plant_output *now, uint64_t steps, int32_t step_q27);

/* Books one step; does nothing once all planned steps are done. [ISR] */
void measure_push(struct measure *measure, const struct plant_output *output);

static inline bool measure_is_active(const struct measure *measure) { return measure->done < measure->planned; }

/* Frequency of the upward crossings in units of one per step; 0 if there were fewer than two. [MAIN] */
float measure_frequency(const struct measure *measure);

/* Share of the measured time, 0 to 1. [MAIN] */
float measure_share(const struct measure *measure, uint64_t sum);

#endif
