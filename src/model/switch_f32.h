/* The usual event: a pad that is pressed on the disc, without a floor of friction, meets the disc once in the step, and
 * sticks or slips from there on, or breaks loose and slips from there on. By the rules and the formulas of event_f32.c,
 * which has all others, with everything known beforehand left out; for step_f32.c alone. Both sides take the same way,
 * so that mirrored pads stay mirrored.
 *
 * Each returns false, and has changed nothing, where the step is not like that. y is left to the caller. */
#ifndef MODEL_SWITCH_F32_H
#define MODEL_SWITCH_F32_H

#include "base/compiler.h"
#include "base/fmath.h"
#include "model/hermite_f32.h"
#include "model/output_f32.h"
#include "model/slip_f32.h"

/* The event is at a place of the step, and mode the regime from there on. */
BASE_INLINE void switch_at(struct step_f32 *s, float place, int8_t mode)
{
    const uint32_t before = (uint32_t)(place * (float)PLANT_SHARE_ONE);
    const uint32_t after = PLANT_SHARE_ONE - before;

    s->output.noted = (struct plant_notes){.events = 1u};
    s->output.noted.stick = s->mode == PLANT_STICK ? before : mode == PLANT_STICK ? after : 0u;
    s->output.noted.slip_minus = s->mode == PLANT_SLIP_MINUS ? before : mode == PLANT_SLIP_MINUS ? after : 0u;
    s->mode = mode;
    s->output.mode = mode;
}

/* The end of the step, but for the normal direction. */
BASE_INLINE void switch_end(struct step_f32 *s, float x, float x_rest, float v)
{
    s->x = x;
    s->x_rest = x_rest;
    s->v = v;
}

/* From x at that place the pad slips on to the side. */
BASE_INLINE bool switch_slip_on(struct step_f32 *s, const struct slip_f32_factors *whole,
                                const struct normal_f32_arc *arc, float place, float x, float x_rest, int8_t side,
                                const struct normal_f32_piece *normal)
{
    const struct slip_f32_factors part = slip_f32_take_part(whole, 1.0f - place);
    const float middle = normal_f32_arc_y(arc, 0.5f * (place + 1.0f));
    const struct normal_f32_piece piece = {
        .p1 = normal_f32_arc_y(arc, place), .p2 = middle, .p3 = middle, .p4 = normal->y};
    struct slip_f32_end end;

    slip_f32_go(&part, slip_f32_drive(&part, s->disc, side), side, x, s->disc, &piece, &end, false);
    if (!(signed_by(side, s->disc - end.v) >= 0.0f)) {
        return false;
    }
    switch_at(s, place, side);
    x = fmath_add_kept(x, end.dx, &x_rest);
    switch_end(s, x, x_rest, end.v);
    return true;
}

/* The slip was tried as a whole up to end. */
BASE_INLINE bool switch_from_slip(struct step_f32 *s, const struct step_f32_coeffs *c,
                                  const struct normal_f32_piece *normal, const struct slip_f32_end *end)
{
    const struct slip_f32_factors *f = &c->whole;
    const float drive = slip_f32_drive(f, s->disc, s->mode);
    const float last = slip_f32_half_increment(f, drive, s->mode, s->x + end->dx, end->v, normal->y, false);
    const struct hermite_f32 vr = hermite_f32_make(s->disc - s->v, -2.0f * end->first, s->disc - end->v, -2.0f * last);
    const struct normal_f32_arc arc = normal_f32_arc_make(&s->normal, c->normal.step, normal);
    float x_rest = s->x_rest;
    float place;
    float need;
    float x;

    if (signed_by(s->mode, vr.value0) <= 0.0f || !hermite_f32_crossing(&vr, s->disc - end->v, &place)) {
        return false;
    }
    x = fmath_add_kept(s->x, slip_f32_dx_at_crossing(f, &vr, PLANT_SLIP_PLUS, s->v, s->disc, place), &x_rest);
    need = s->turning.resists + f->spring * x;
    if (!(fmath_abs(need) <= f->friction * normal_f32_arc_y(&arc, place))) {
        return switch_slip_on(s, f, &arc, place, x, x_rest, need > 0.0f ? PLANT_SLIP_PLUS : PLANT_SLIP_MINUS, normal);
    }
    x = fmath_add_kept(x, (1.0f - place) * s->turning.carry, &x_rest);
    if (!(fmath_abs(s->turning.resists + f->spring * x) <= f->friction * normal->y)) {
        return false;
    }
    switch_at(s, place, PLANT_STICK);
    switch_end(s, x, x_rest, s->disc);
    return true;
}

/* Friction does not hold the pad until the end of the step. */
BASE_INLINE bool switch_from_stick(struct step_f32 *s, const struct step_f32_coeffs *c,
                                   const struct normal_f32_piece *normal)
{
    const struct slip_f32_factors *f = &c->whole;
    const float carry = s->turning.carry;
    const float need = s->turning.resists + f->spring * (s->x + carry);
    const int8_t side = need > 0.0f ? PLANT_SLIP_PLUS : PLANT_SLIP_MINUS;
    const float pull = signed_by(side, f->spring * carry);
    const struct normal_f32_arc arc = normal_f32_arc_make(&s->normal, c->normal.step, normal);
    const float spare = f->friction * s->normal.y - signed_by(side, s->turning.resists + f->spring * s->x);
    const float spare_end = f->friction * normal->y - fmath_abs(need);
    const struct hermite_f32 cubic = hermite_f32_make(spare, f->friction * arc.slope - pull, spare_end,
                                                      f->friction * (c->normal.step * normal->w) - pull);
    float x_rest = s->x_rest;
    float place;
    float x;

    if (spare <= 0.0f || !hermite_f32_crossing(&cubic, spare_end, &place)) {
        return false;
    }
    x = fmath_add_kept(s->x, place * carry, &x_rest);
    return switch_slip_on(s, f, &arc, place, x, x_rest, side, normal);
}

#endif
