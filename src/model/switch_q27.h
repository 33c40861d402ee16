/* The usual step with a switch of regime in integers: exactly one, of a pad that is pressed on the disc throughout,
 * without a floor of mu. It comes to stick, is released forward, or overtakes the disc or falls back behind it. Part of
 * step_q27, in a file of its own. What it finds is to the bit what event_q27.c would find, in half the time. */
#ifndef MODEL_SWITCH_Q27_H
#define MODEL_SWITCH_Q27_H

#include "model/step_q27.h"

/* A whole step was tried from the present state, in the fine arithmetic: y and w at its end, and where the pad slips
 * also the end of the slip. If the step is of the kind above, the state moves on to its end and the notes are made.
 * Otherwise false, and nothing has changed. */
bool switch_q27_cross(struct step_q27 *s, const struct step_q27_coeffs *c, int32_t y, int32_t w,
                      const struct slip_q27_end *end);
bool switch_q27_release(struct step_q27 *s, const struct step_q27_coeffs *c, int32_t y, int32_t w);

#endif
