/* The plant in Q4.27: the twin of step_f32, integers from the input to the sample. Same options, same rules, same
 * report; what differs is the format of the states, and that x is counted in units of 2^length_shift, which lets a soft
 * spring fit.
 *
 * Two kinds of arithmetic: a fast path for the usual step, whole, without an event, every number proven to fit; and a
 * general one that saturates and says so. The pad has left its domain when anything saturates. Headroom: MODEL.md. */
#ifndef MODEL_STEP_Q27_H
#define MODEL_STEP_Q27_H

#include <stdbool.h>
#include <stdint.h>

#include "model/normal_q27.h"
#include "model/plant.h"
#include "model/scale.h"
#include "model/slip_q27.h"

/* How the steps to come are made while they are usual. It follows from what only an unusual step, an input or other
 * coefficients may change. */
enum step_q27_way {
    STEP_Q27_PIECES,
    STEP_Q27_SLIP_PHASE,
    STEP_Q27_STICK_PHASE,
    STEP_Q27_SLIP_MAP,
    STEP_Q27_STICK_MAP,
    STEP_Q27_TAME
};

struct step_q27_coeffs {
    struct slip_q27_factors fine, wide; /* of a whole step */
    int32_t drag;                       /* -h C in the format of wide */
    int32_t reach_max;                  /* the fast path serves a normal motion within it; 0: no motion at all */
    uint8_t ways[3];                    /* enum step_q27_way in each mode, from PLANT_SLIP_MINUS on */
    bool has_floor;
    bool is_naive; /* RK4 on the raw sign, no stick: for comparison only */
    struct normal_q27_coeffs normal;
    int32_t stiffness, friction, slope, floor; /* without h, Q27, for reports */
    int32_t damping_q24;
};

/* Brake force in n_max and disc speed in Vref, held over one step, Q4.27, within 1 but for rounding. */
struct step_q27_input {
    int32_t load, speed;
};

/* What a step needs of the disc's speed under the present coefficients: the same in every step until one of them
 * changes. */
struct step_q27_turning {
    int32_t carry;            /* x in a step while the pad sticks */
    int32_t drive;            /* h (mu + eps disc), what drives a pad that slips forward, in the format of fine */
    struct fixed_sum resists; /* -h C disc, what damping does to a pad that sticks; Q55 */
};

struct step_q27 {
    int32_t x, v; /* displacement over 2^length_shift and velocity of the pad along the disc */
    struct slip_q27_rest rest;
    int32_t disc;      /* disc speed held over the present step */
    int8_t mode;       /* enum plant_mode */
    bool is_saturated; /* something did not fit, now or before */
    uint8_t way;       /* enum step_q27_way */
    struct step_q27_turning turning;
    struct normal_q27 normal;
    struct plant_output output; /* of the last step */
};

/* Coefficients of a set whose scale has been derived. [MAIN] */
void step_q27_configure(struct step_q27_coeffs *coeffs, const struct params *params, const struct scale *scale);

/* Initial state of the set under the first input, with nothing having happened. [ANY] */
void step_q27_reset(struct step_q27 *state, const struct step_q27_coeffs *coeffs, const struct params *params,
                    const struct scale *scale, struct step_q27_input first);

/* Other coefficients are in force from here on, or the state has been put back as it stood under these. [ISR] */
void step_q27_adopt(struct step_q27 *state, const struct step_q27_coeffs *coeffs);

/* What is held over the steps to come. [ISR] */
void step_q27_set_input(struct step_q27 *state, const struct step_q27_coeffs *coeffs, struct step_q27_input input);

/* Advances by one step h. Cost: one RK4 step, and at most 1 + 2 (PLANT_EVENTS_MAX + PLANT_CONTACTS_MAX) where regimes
 * switch. [ISR] */
void step_q27_advance(struct step_q27 *state, const struct step_q27_coeffs *coeffs);

/* Friction force on the pad in the unit m wn Vref, Q4.27: mu P sgn(vr) while slipping, what holds the pad while
 * sticking. */
int32_t step_q27_friction(const struct step_q27 *state, const struct step_q27_coeffs *coeffs);

/* The plant has left its domain: a state saturated, or is beyond what the model means. */
static inline bool step_q27_is_outside(const struct step_q27 *state)
{
    return state->is_saturated || fixed_abs(state->v) > (uint32_t)SCALE_FAULT_SPEED << PLANT_FRACTION_BITS;
}

#endif
