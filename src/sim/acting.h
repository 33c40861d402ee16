/* The acting process: what brake force and disc speed do over time, from step to step, one code for both.
 *
 *   profile or curve, with offset and limits -> lag -> + dither            sim/profile.h, sim/curve.h, model/demand.h
 *
 * Without a lag and without an inertia the value of a step depends on its index alone. With them it has a state, which
 * is that of the beginning of the step to come; the value held over the step is that of its middle:
 *
 *   lag      s' = (demand - s)/lag, solved exactly for a demand that is held over the step
 *   inertia  J v'/R = - pads F R, F the friction at the end of the step before; it stands where it would turn round
 *
 * Both are sums of small changes: f32 keeps what rounding takes, q27 counts in 2^-56. */
#ifndef SIM_ACTING_H
#define SIM_ACTING_H

#include <stdbool.h>
#include <stdint.h>

#include "sim/curve.h"
#include "sim/profile.h"

/* A factor for integers: mantissa 2^-shift. */
struct acting_factor {
    int32_t mantissa;
    unsigned shift;
};

struct acting {
    enum demand_kind kind;
    bool is_plain; /* nothing but a profile: the fast way */
    bool has_state, has_lag, has_dither;
    struct profile profile;
    struct profile_q27 profile_q27;
    uint64_t end; /* step from which on nothing more is asked for; UINT64_MAX for never */
    float begin;  /* before anything changes */
    int32_t begin_q27;
    float lag_half, lag_whole; /* part of the way that half a step and a whole one go */
    struct acting_factor lag_half_q27, lag_whole_q27;
    float slowing; /* speed lost in a step per unit of friction */
    struct acting_factor slowing_q27;
    float dither;
    int32_t dither_q27;
    uint64_t dither_turns; /* a step */
    bool is_force;
    struct curve curve; /* of pulses and tables */
};

/* A sum in either arithmetic; the one that is not in use stays as it was at reset. */
struct acting_sum {
    float value, rest;
    int64_t value_q56;
};

struct acting_state {
    struct acting_sum lag, inertia;
};

/* [MAIN] */
void acting_of_load(struct acting *acting, const struct params *params, const struct scale *scale);
void acting_of_speed(struct acting *acting, const struct params *params, const struct scale *scale);

/* As it is before the first step. [ISR] */
void acting_reset(struct acting_state *state, const struct acting *acting);

/* What the dither is put on, with the state at the beginning of the given step. [ISR, pure] */
float acting_base_f32(const struct acting *acting, const struct acting_state *state, uint64_t step);
int32_t acting_base_q27(const struct acting *acting, const struct acting_state *state, uint64_t step);

/* Value held over the given step, with the state at its beginning. [ISR, pure] */
float acting_moving_f32(const struct acting *acting, const struct acting_state *state, uint64_t step);
int32_t acting_moving_q27(const struct acting *acting, const struct acting_state *state, uint64_t step);

static inline float acting_value_f32(const struct acting *acting, const struct acting_state *state, uint64_t step)
{
    if (step >= acting->end) {
        return acting->profile.last;
    }
    return acting->is_plain ? profile_moving_value(&acting->profile, step) : acting_moving_f32(acting, state, step);
}

static inline int32_t acting_value_q27(const struct acting *acting, const struct acting_state *state, uint64_t step)
{
    if (step >= acting->end) {
        return acting->profile_q27.last;
    }
    return acting->is_plain ? profile_q27_moving_value(&acting->profile_q27, step)
                            : acting_moving_q27(acting, state, step);
}

/* The step is made: its state goes on, friction being that at its end. [ISR] */
void acting_advance_f32(const struct acting *acting, struct acting_state *state, uint64_t step, float friction);
void acting_advance_q27(const struct acting *acting, struct acting_state *state, uint64_t step, int32_t friction);

/* From here on it goes on from this value, without dither: a controller's, or that of the set before. [ISR] */
void acting_take_f32(struct acting_state *state, float value);
void acting_take_q27(struct acting_state *state, int32_t value);

/* Does the value stay as it is from this step on? A lag may have 2^-12 of a unit left to go. [MAIN] */
bool acting_is_steady(const struct acting *acting, const struct acting_state *state, uint64_t step, bool is_q27);

/* Step from which on nothing but what is periodic moves, as far as the set tells; UINT64_MAX for never. [MAIN] */
uint64_t acting_settled_step(const struct acting *acting, const struct params *params, const struct scale *scale);

#endif
