/* Steps of the plant in single precision that need more than one piece: where regimes switch or contact changes inside
 * the step. Part of step_f32, in a file of its own. */
#ifndef MODEL_EVENT_F32_H
#define MODEL_EVENT_F32_H

#include "model/slip_f32.h"
#include "model/step_f32.h"

/* What of the step is to be reported. */
struct event_f32_progress {
    float stick, slip_minus; /* shares of the step */
    unsigned events, contacts;
    bool is_capped, is_lifted;
};

/* A step that was tried as a whole, from the present state, and that may hold an event. */
struct event_f32_attempt {
    float y, w, dy, dw;             /* at its end, and their changes */
    const struct slip_f32_end *end; /* NULL if the pad sticks */
};

/* Goes through the step. attempt may be NULL. */
void event_f32_step(struct step_f32 *s, const struct step_f32_coeffs *c, struct event_f32_progress *progress,
                    const struct event_f32_attempt *attempt);

/* The disc has a new speed. A sticking pad follows if friction can also accelerate it; a slipping one keeps its
 * speed. */
void event_f32_set_speed(struct step_f32 *s, const struct step_f32_coeffs *c, float speed);

#endif
