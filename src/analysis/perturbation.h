/* The paper's analytic solution of forced slip, Eqs. 14 to 19, as printed and set right: what the pad does as long as
 * it neither sticks nor overtakes the disc, under a constant load from rest.
 *
 *     x'' + d x' + Z2 x = B (1 - cos tau) + eps cos(tau) x'     d = C + eps n, eps = eps n here, B = n (mu + eps |V0|)
 *
 * expanded in eps. Derivation and the list of what is wrong in print: model/MODEL.md, "The paper's analytic solution".
 * Everything in the model's units (model/scale.h). Float, for main. */
#ifndef ANALYSIS_PERTURBATION_H
#define ANALYSIS_PERTURBATION_H

#include <stdbool.h>
#include <stdint.h>

#include "base/complex32.h"
#include "model/params.h"
#include "model/scale.h"

enum { PERTURBATION_ORDER_MAX = 2, PERTURBATION_HARMONICS = 3 };

enum perturbation_form {
    PERTURBATION_PRINTED,  /* 1 - sin for the normal direction, arctg for atan2, damping C alone, one phi_0 too many */
    PERTURBATION_WITH_COS, /* the same, but with 1 - cos, which the initial state asks for */
    PERTURBATION_CORRECTED
};

/* Forced motion: x = mean + sum over k of Re(harmonic[k - 1] exp(i k tau)). */
struct perturbation {
    float mean;
    struct complex32 harmonic[PERTURBATION_HARMONICS];
    float damping, stiffness; /* d and Z2, of the transient */
};

/* Is the set one of these: constant load and speed, in the normal direction from rest, no cn, no floor, a spring?
 * [MAIN] */
bool perturbation_is_served(const struct params *params, const struct scale *scale);

/* Solution of a set that is served, order 0 ... 2. [MAIN] */
void perturbation_derive(struct perturbation *solution, const struct params *params, const struct scale *scale,
                         enum perturbation_form form, unsigned order);

/* Where the pad is and how fast, turns of a normal period as a fraction of 2^32. */
struct perturbation_state {
    float x, v;
};

struct perturbation_state perturbation_forced(const struct perturbation *solution, uint32_t turns);

/* The same with the transient that leads there from a state at tau = 0: exact for eps = 0, else to the order of eps.
 * Only for d < 2 Z. periods since reset, in normal periods. */
struct perturbation_state perturbation_from(const struct perturbation *solution, struct perturbation_state start,
                                            float periods);

/* Largest speed of the forced motion over a period. */
float perturbation_speed(const struct perturbation *solution);

#endif
