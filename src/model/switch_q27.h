/* The usual step with a switch of regime in integers: exactly one, of a pad that slips forward and comes to stick, or
 * sticks and comes to slip forward, pressed on the disc throughout and without a floor of mu. Part of step_q27, in a
 * file of its own. What it finds is to the bit what event_q27.c would find, in half the time. */
#ifndef MODEL_SWITCH_Q27_H
#define MODEL_SWITCH_Q27_H

#include "model/step_q27.h"

/* A whole step was tried from the present state, in the fine arithmetic: y and w at its end, and where the pad slips
 * also the end of the slip. If the step is of the kind above, the state moves on to its end. Returns the share of the
 * step spent sticking, Q30, or 0 if it is of another kind; then nothing has changed. */
uint32_t switch_q27_cross(struct step_q27 *s, const struct step_q27_coeffs *c, int32_t y, int32_t w,
                          const struct slip_q27_end *end);
uint32_t switch_q27_release(struct step_q27 *s, const struct step_q27_coeffs *c, int32_t y, int32_t w);

#endif
