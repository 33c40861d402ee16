/* The state in single precision as the integers that every reader takes, for step_f32.c alone. */
#ifndef MODEL_OUTPUT_F32_H
#define MODEL_OUTPUT_F32_H

#include "base/compiler.h"
#include "base/fmath.h"
#include "model/step_f32.h"

#define OUTPUT_MAX 15.9999990f /* the largest that Q4.27 holds */
#define BITS_OF_2 0x40000000u  /* set in all floats from 2 on, and in none below */

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

/* State in Q4.27; the usual case, all of it in range, is asked once. The disc's speed never leaves it: inputs are
 * within 1, but for rounding. */
BASE_INLINE void report_state(struct step_f32 *s, const struct step_f32_coeffs *c)
{
    struct plant_output *output = &s->output;
    const float x = s->x * c->output_length;
    bool is_saturated = false;

    if (BASE_LIKELY(fmath_abs(x) + fmath_abs(s->v) + fmath_abs(s->normal.y) + fmath_abs(s->normal.w) <= OUTPUT_MAX)) {
        output->x = inside_q27(x);
        output->v = inside_q27(s->v);
        output->y = inside_q27(s->normal.y);
        output->w = inside_q27(s->normal.w);
    } else {
        output->x = to_q27(x, &is_saturated);
        output->v = to_q27(s->v, &is_saturated);
        output->y = to_q27(s->normal.y, &is_saturated);
        output->w = to_q27(s->normal.w, &is_saturated);
    }
    output->disc = inside_q27(s->disc);
    output->mode = s->mode;
    output->has_notes = is_saturated;
    if (BASE_UNLIKELY(is_saturated)) {
        output->has_notes = false;
        output->noted = plant_notes(output);
        output->noted.is_saturated = true;
        output->has_notes = true;
    }
}

static BASE_NOINLINE void report_wide(struct step_f32 *s, const struct step_f32_coeffs *c, bool has_notes)
{
    const struct plant_notes noted = s->output.noted;

    report_state(s, c);
    if (has_notes) {
        const bool is_saturated = s->output.has_notes;

        s->output.noted = noted;
        s->output.noted.is_saturated = is_saturated;
        s->output.has_notes = true;
    }
}

/* Of a usual step with y and w known to be within range: mode and disc are as they were, and v too unless the pad
 * moves on the disc. A bit of the exponent tells that x and v are below 2. */
BASE_INLINE void report_calm(struct step_f32 *s, const struct step_f32_coeffs *c, bool has_moved, bool has_notes)
{
    struct plant_output *output = &s->output;
    const float x = s->x * c->output_length;

    if (BASE_UNLIKELY(((fmath_bits(x) | (has_moved ? fmath_bits(s->v) : 0u)) & BITS_OF_2) != 0u)) {
        report_wide(s, c, has_notes);
        return;
    }
    output->x = inside_q27(x);
    if (has_moved) {
        output->v = inside_q27(s->v);
    }
    output->y = inside_q27(s->normal.y);
    output->w = inside_q27(s->normal.w);
    output->has_notes = has_notes;
}

#endif
