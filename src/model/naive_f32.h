/* RK4 on the raw sign of vr, with neither sticking nor location: for comparison only. It is wrong by up to 44 % once
 * the pad sticks, whatever the step. */
#ifndef MODEL_NAIVE_F32_H
#define MODEL_NAIVE_F32_H

#include "model/step_f32.h"

/* Advances x, v, y, w and the mode by one step h; the normal direction's step is closed by the caller. [ISR, pure] */
void naive_f32_step(struct step_f32 *state, const struct step_f32_coeffs *coeffs);

#endif
