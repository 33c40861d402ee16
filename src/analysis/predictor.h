/* Whether a set will squeal, from its parameters alone and in closed form: the paper's two criteria (N |alpha| < c, and
 * stiffness away from resonance) and the size of the brake force's step, joined into one rule. MODEL.md derives it.
 *
 *   quiet  iff  permanent slip is stable                rate < 0
 *          and  forced motion stays slower than the disc V_h < |v0|
 *
 * Float, for main; nothing of it runs in the interrupt. */
#ifndef ANALYSIS_PREDICTOR_H
#define ANALYSIS_PREDICTOR_H

#include <stdbool.h>
#include <stdint.h>

#include "model/params.h"
#include "model/scale.h"

/* Forced motion at this share of the disc's speed is near enough to it to be watched, and too near to be promised
 * quiet. */
#define PREDICTOR_TOUCH_MARGIN 0.95f

enum predictor_verdict { PREDICTION_UNKNOWN, PREDICTION_QUIET, PREDICTION_WATCH, PREDICTION_SQUEAL };

struct prediction {
    enum predictor_verdict verdict; /* UNKNOWN where the disc stands still */
    float rate;                     /* growth of permanent slip at the end of the profiles, per unit of time 1/wn */
    float touch_ratio;       /* V_h/|v0| of the steady forced motion; 1 or more: the pad catches up with the disc */
    float onset_touch_ratio; /* the same with the transient of the onset added */
    bool is_bistable;        /* quiet from rest, but a kick across the friction floor's knee may start squeal */
};

/* The state that the profiles of a set lead to. */
struct predictor_finish {
    float load, speed; /* n and |v0| */
    float friction;    /* mu at v0 */
    float slope;       /* local slope of friction times n: eps n, 0 on the floor */
    float share;       /* A: amplitude of the normal oscillation that lasts, over the load */
    bool is_on_floor;
};

/* What the forced motion is worth, for the detector: speeds in the model's units. */
struct predictor_response {
    float gain;          /* speed of the pad per speed of the normal oscillation at wn */
    float load_speed;    /* normal speed under a sine of the load */
    float load_response; /* speed of the pad under it */
};

/* Prediction for the state that the profiles of a checked set lead to. [MAIN] */
struct prediction predictor_predict(const struct params *params, const struct scale *scale);

struct predictor_finish predictor_finish(const struct params *params, const struct scale *scale);

struct predictor_response predictor_response(const struct params *params, const struct scale *scale);

/* The words of the protocol. [MAIN] */
const char *predictor_verdict_name(enum predictor_verdict verdict);

#endif
