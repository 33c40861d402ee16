/* The state in single precision as the integers that every reader takes, for step_f32.c alone. */
#ifndef MODEL_OUTPUT_F32_H
#define MODEL_OUTPUT_F32_H

#include "base/compiler.h"
#include "base/fmath.h"
#include "model/step_f32.h"

#define OUTPUT_MAX 15.9999990f /* the largest that Q4.27 holds */

/* Q4.27, saturating; a NaN comes out as 0 and is flagged. */
static inline int32_t to_q27(float value, bool *is_saturated)
{
    if (BASE_UNLIKELY(!(fmath_abs(value) <= OUTPUT_MAX))) {
        *is_saturated = true;
        return value > OUTPUT_MAX ? INT32_MAX : value < -OUTPUT_MAX ? -INT32_MAX : 0;
    }
    return (int32_t)(value * (float)(1 << PLANT_FRACTION_BITS));
}

static inline int32_t inside_q27(float value) { return (int32_t)(value * (float)(1 << PLANT_FRACTION_BITS)); }

/* State in Q4.27; the usual case, all of it in range, is asked once. */
BASE_INLINE void report_state(const struct step_f32 *s, const struct step_f32_coeffs *c, struct plant_output *output)
{
    const float x = s->x * c->output_length;

    output->mode = s->mode;
    output->is_saturated = false;
    if (BASE_LIKELY(fmath_abs(x) <= OUTPUT_MAX && fmath_abs(s->v) <= OUTPUT_MAX && fmath_abs(s->disc) <= OUTPUT_MAX &&
                    fmath_abs(s->normal.y) <= OUTPUT_MAX && fmath_abs(s->normal.w) <= OUTPUT_MAX)) {
        output->x = inside_q27(x);
        output->v = inside_q27(s->v);
        output->y = inside_q27(s->normal.y);
        output->w = inside_q27(s->normal.w);
        output->disc = inside_q27(s->disc);
        return;
    }
    output->x = to_q27(x, &output->is_saturated);
    output->v = to_q27(s->v, &output->is_saturated);
    output->y = to_q27(s->normal.y, &output->is_saturated);
    output->w = to_q27(s->normal.w, &output->is_saturated);
    output->disc = to_q27(s->disc, &output->is_saturated);
}

#endif
