/* Does permanent slip die out? Under a constant load whose normal oscillation lasts, a disturbance of the slipping pad
 * obeys
 *
 *     xi'' + (C + eps n (1 - A cos tau)) xi' + Z2 xi = 0            A: share of the normal oscillation in the load
 *
 * whose rate of growth per unit of time 1/wn is the logarithm of the largest multiplier of its map over one period.
 * Below 0: it dies out. Constant friction and speed do not matter. Float, for main. [pure] */
#ifndef ANALYSIS_FLOQUET_H
#define ANALYSIS_FLOQUET_H

struct floquet_problem {
    float damping;   /* C */
    float slope;     /* eps n, negative where friction weakens */
    float stiffness; /* Z2, at most SCALE_STIFFNESS_MAX */
    float share;     /* A: 1 after a step from rest, 0 once the normal oscillation is gone */
};

/* By the map over one period, found with RK4: error below 2e-6. */
float floquet_rate(const struct floquet_problem *problem);

/* In closed form: negative damping, and the first tongue of parametric resonance at Z = 1/2. Good to the order of eps n
 * while damping is small (C below 0.5). */
float floquet_rate_closed(const struct floquet_problem *problem);

#endif
