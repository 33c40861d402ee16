/* Steps of the plant in single precision that need more than one piece: where regimes switch or contact changes inside the
 * step. Part of step_f32, in a file of its own. */
#ifndef MODEL_EVENT_F32_H
#define MODEL_EVENT_F32_H

#include "model/step_f32.h"

/* What is left of the step, and what of it is to be reported. */
struct event_f32_progress {
    float rest;    /* still to go, in 1/wn */
    bool is_whole; /* nothing was cut off yet */
    float stick, slip_minus;
    unsigned events, contacts;
    bool is_capped, is_lifted;
};

/* Goes through what is left of the step. */
void event_f32_step(struct step_f32 *s, const struct step_f32_coeffs *c, struct event_f32_progress *progress);

/* The disc has a new speed. A sticking pad follows if friction can also accelerate it; a slipping one keeps its speed. */
void event_f32_set_speed(struct step_f32 *s, const struct step_f32_coeffs *c, float speed);

#endif
