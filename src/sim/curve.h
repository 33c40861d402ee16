/* A profile by straight lines from point to point: pulses, and tables. In integers, for both arithmetics: times in
 * 2^-30 model steps since reset, values in Q4.27. Evaluated from the step's index alone, in the middle of each step; a
 * jump of the brake force is spread over two steps like a load step (sim/profile.h), one of the disc's speed moves to
 * the nearest grid point. */
#ifndef SIM_CURVE_H
#define SIM_CURVE_H

#include <stdbool.h>
#include <stdint.h>

#include "model/demand.h"
#include "model/scale.h"

enum { CURVE_TIME_BITS = 30 };

struct curve {
    uint32_t count;
    bool has_shared_jumps; /* two points of one time whose jump is spread */
    uint64_t at[PARAMS_POINTS_MAX];
    int32_t value[PARAMS_POINTS_MAX]; /* with the offset; the limits come last */
    uint32_t
        inverse[PARAMS_POINTS_MAX]; /* 2^62 over the way to the next point, that shifted to 32 bits; 0 for a jump */
    int32_t low, high;
    uint64_t start;          /* pulses: t1, from which their points count */
    uint64_t period;         /* of pulses; 0: they come once */
    uint64_t turns_per_step; /* of pulses that come again: part of a period in 2^-64 */
    uint64_t start_turns;    /* t1 in periods */
    uint64_t end;            /* step from which on it stays as it is; UINT64_MAX for never */
};

/* Curve of pulses or of a table; unit is that of the model, N or m/s. has_sharing: jumps are spread. [MAIN] */
void curve_derive(struct curve *curve, const struct demand *demand, const struct scale *scale, float unit,
                  bool has_sharing);

/* Value held over the given step. At most eight points are looked at beside a search of six. [ISR, pure] */
int32_t curve_value(const struct curve *curve, uint64_t step);

#endif
