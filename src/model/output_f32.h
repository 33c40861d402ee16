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

/* Of a step without an event in which y may be below 0. */
static BASE_NOINLINE void report_unpressed(struct step_f32 *s, const struct step_f32_coeffs *c)
{
    report_state(s, c);
    if (s->normal.y < 0.0f) {
        s->output.noted = plant_notes(&s->output);
        s->output.noted.is_lifted = true;
        s->output.has_notes = true;
    }
}

/* Of a step with an event that is noted already, out of the usual range. */
static BASE_NOINLINE void report_wide_event(struct step_f32 *s, const struct step_f32_coeffs *c)
{
    const struct plant_notes noted = s->output.noted;

    report_state(s, c);
    s->output.noted.stick = noted.stick;
    s->output.noted.slip_minus = noted.slip_minus;
    s->output.noted.events = noted.events;
    s->output.has_notes = true;
}

/* Of a pad that is pressed on the disc: mode, set where it changes, and disc are reported already, and so is v unless
 * the pad moves on the disc. Calm: y and w are known to be below 2. A bit of the exponent tells that of the others. */
BASE_INLINE void report_pressed(struct step_f32 *s, const struct step_f32_coeffs *c, bool has_moved, bool is_calm,
                                bool has_notes)
{
    struct plant_output *output = &s->output;
    const float x = s->x * c->output_length;
    uint32_t bits = fmath_bits(x);

    bits |= has_moved ? fmath_bits(s->v) : 0u;
    bits |= is_calm ? 0u : fmath_bits(s->normal.y) | fmath_bits(s->normal.w);
    if (BASE_UNLIKELY((bits & BITS_OF_2) != 0u)) {
        if (has_notes) {
            report_wide_event(s, c);
        } else {
            report_unpressed(s, c);
        }
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
