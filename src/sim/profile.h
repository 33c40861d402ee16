/* What is asked of brake force and disc speed over time, in its plainest forms: constant, step, ramp, sine. Times are
 * in model steps since reset, values in the model's units, with offset and limits; a value is that of the middle of its
 * step, t = (i + 1/2) h, and is held over it. Pulses and tables are sim/curve.h, what becomes of it all sim/acting.h.
 *
 * A load step inside a model step f h after its start is spread over two, so that its impulse and its first moment are
 * those of the real one: n = from + (to - from) (2 - f)(1 - f)/2, then from + (to - from) (2 - f)(1 + f)/2. What
 * remains is of third order in h; rounding the instant to the grid would leave up to h/2 of the change. The disc's
 * speed changes at the nearest grid point. */
#ifndef SIM_PROFILE_H
#define SIM_PROFILE_H

#include <stdbool.h>
#include <stdint.h>

#include "model/demand.h"
#include "model/scale.h"

struct profile {
    enum demand_kind kind;   /* of those four */
    float from, to;          /* sine: mean and amplitude */
    float low, high;         /* of a ramp and of a sine; the ends of the others are within them */
    float first, second;     /* share of the change in the step that contains t1, and in the next */
    uint32_t start;          /* whole steps before t1 */
    float start_fraction;    /* rest of t1, 0 to 1 step */
    float per_step;          /* ramp: 1/(t2 - t1) in steps */
    uint64_t turns_per_step; /* sine: fraction of a turn in 2^-64 */
    float last;              /* value from the step end on, for good; end is UINT64_MAX where there is none */
    uint64_t end;
};

/* Profile of a checked demand, of which any other kind is taken for a constant; unit is that of the model, N or m/s.
 * is_shared: a step is spread, else it moves to the grid. [MAIN] */
void profile_derive(struct profile *profile, const struct demand *demand, const struct scale *scale, float unit,
                    bool is_shared);

/* Value of a profile before its end. */
float profile_moving_value(const struct profile *profile, uint64_t step);

/* Value held over the given step. Same bits everywhere. [ISR, pure] */
static inline float profile_value(const struct profile *profile, uint64_t step)
{
    return step >= profile->end ? profile->last : profile_moving_value(profile, step);
}

/* The same profile in integers: values in Q4.27, a place on the ramp in Q60. */
struct profile_q27 {
    enum demand_kind kind;
    int32_t from, to, low, high;
    int32_t first, second; /* shares in Q30; the second reaches 9/8 */
    uint32_t start;
    uint32_t length;         /* ramp: steps after which it is over */
    int64_t place;           /* ramp: of the middle of the step in which it starts; below 0 before it */
    int64_t per_step;        /* ramp: way of one step, 2 for anything faster */
    uint64_t turns_per_step; /* sine: as above */
    int32_t last;
    uint64_t end;
};

/* [MAIN] */
void profile_q27_derive(struct profile_q27 *derived, const struct profile *profile);

int32_t profile_q27_moving_value(const struct profile_q27 *profile, uint64_t step);

/* Value held over the given step. No floating point. [ISR, pure] */
static inline int32_t profile_q27_value(const struct profile_q27 *profile, uint64_t step)
{
    return step >= profile->end ? profile->last : profile_q27_moving_value(profile, step);
}

#endif
