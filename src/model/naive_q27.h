/* The naive method of the Q4.27 plant: RK4 on the raw sign of vr, no stick, no switch located. For comparison only. */
#ifndef MODEL_NAIVE_Q27_H
#define MODEL_NAIVE_Q27_H

#include "model/event_q27.h"

void naive_q27_step(struct step_q27 *s, const struct step_q27_coeffs *c, struct plant_notes *notes);

#endif
