/* How often a brake squeals when nobody knows it exactly: the same set again and again with mu_s, alpha, c and N
 * scattered about their values. Draw i is a function of (seed, i) alone and the same to the bit everywhere. The disc's
 * surface is another one in every draw.
 *
 * One bit is not believed on a rig; a share of trials with its confidence interval is. */
#ifndef SIM_OCCURRENCE_H
#define SIM_OCCURRENCE_H

#include <stdbool.h>
#include <stdint.h>

#include "model/params.h"

/* What is scattered; LOAD is the whole profile of N. */
enum occurrence_amount {
    OCCURRENCE_FRICTION,
    OCCURRENCE_SLOPE,
    OCCURRENCE_DAMPING,
    OCCURRENCE_LOAD,
    OCCURRENCE_AMOUNTS
};

enum {
    OCCURRENCE_TRIALS_MAX = 100000,
    OCCURRENCE_SEED_MAX = 0xffffff /* what a parameter holds exactly */
};

#define OCCURRENCE_SPREAD_DEFAULT 0.1f
#define OCCURRENCE_SPREAD_MAX 1.0f

struct occurrence {
    struct params base;
    uint32_t seed;
    bool is_uniform;                  /* else normal */
    float spread[OCCURRENCE_AMOUNTS]; /* relative: half width if uniform, standard deviation if normal */
};

struct occurrence_draw {
    struct params params;
    float values[OCCURRENCE_AMOUNTS]; /* as drawn, SI; of the load the factor */
    uint32_t clamped;                 /* parameters that a draw would have moved out of their range */
};

/* A draw. [ANY, pure] */
void occurrence_draw(const struct occurrence *occurrence, uint32_t index, struct occurrence_draw *draw);

/* Wilson's interval of a share, k of n > 0, at 95 %. [ANY, pure] */
void occurrence_interval(uint32_t k, uint32_t n, float *low, float *high);

/* The word of the protocol. [ANY] */
const char *occurrence_name(enum occurrence_amount amount);

#endif
