/* Everything that can be said of a set without integrating it, in SI, for the state that its profiles lead to: what
 * console and tools print. Float, for main. [pure] */
#ifndef ANALYSIS_ANALYSIS_H
#define ANALYSIS_ANALYSIS_H

#include <stdbool.h>

#include "analysis/perturbation.h"
#include "analysis/predictor.h"

struct analysis_mode {
    float growth_per_s, frequency_hz, damping_ratio;
};

struct analysis {
    struct prediction prediction;
    struct analysis_mode tangential, normal; /* complex eigenvalues of steady sliding, analysis/eigen.h */
    float floquet_per_s, closed_per_s;       /* growth of permanent slip: by the monodromy, in closed form */
    float load_n;                            /* that the profiles end with */
    float load_border_n;                     /* above it slip grows: c/|alpha|, less in the tongue; inf: none */
    float alpha_border_s_per_m;              /* the same of alpha; -inf without a load */
    float load_touch_n;                      /* the forced motion alone reaches the disc's speed; inf: never */
    float outer_m_per_s;                     /* V*: faster pads run away where no floor holds friction; inf: none */
    bool has_forced;                         /* the perturbation solution applies: the pad slips on, without touching */
    float forced_um[PERTURBATION_ORDER_MAX + 1]; /* its amplitude, half the range of x, by order */
};

void analysis_make(struct analysis *analysis, const struct params *params, const struct scale *scale);

#endif
