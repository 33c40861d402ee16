/* The usual event: the plain set in a calm step, in which the pad comes to rest on the disc and sticks from there on, or
 * breaks loose and slips from there on. Computed by the rules and the formulas of event_f32.c, which has all others,
 * with everything known beforehand left out. For step_f32.c alone.
 *
 * Each returns false, and has changed nothing, where the step turns out not to be like that. */
#ifndef MODEL_SWITCH_F32_H
#define MODEL_SWITCH_F32_H

#include "base/compiler.h"
#include "base/fmath.h"
#include "model/hermite_f32.h"
#include "model/output_f32.h"
#include "model/slip_f32.h"

/* Over the whole step, to y, w. */
BASE_INLINE struct normal_f32_arc switch_arc(const struct normal_f32 *normal, float step, float y, float w)
{
    const struct normal_f32_piece piece = {.y = y, .w = w, .dy = y - normal->y};

    return normal_f32_arc_make(normal, step, &piece);
}

/* The event at a place of the step, from the regime so far to the one from there on. */
BASE_INLINE void switch_at(struct step_f32 *s, float place, int8_t mode)
{
    struct plant_notes *noted = &s->output.noted;
    const uint32_t before = (uint32_t)(place * (float)PLANT_SHARE_ONE);
    const uint32_t after = PLANT_SHARE_ONE - before;

    *noted = (struct plant_notes){.events = 1u};
    noted->stick = s->mode == PLANT_STICK ? before : after;
    if (s->mode < 0) {
        noted->slip_minus = before;
    } else if (mode < 0) {
        noted->slip_minus = after;
    }
    s->mode = mode;
    s->output.mode = mode;
}

/* Is friction at rest enough at x under the force p? */
BASE_INLINE bool switch_is_held(const struct step_f32 *s, const struct slip_f32_factors *f, float x, float p)
{
    return fmath_abs(s->turning.resists + f->spring * x) <= f->friction * p;
}

/* The slip was tried as a whole up to end. */
BASE_INLINE bool switch_to_stick(struct step_f32 *s, const struct step_f32_coeffs *c, float y, float w,
                                 const struct slip_f32_end *end)
{
    const struct slip_f32_factors *f = &c->whole;
    const float drive = slip_f32_drive(f, s->disc, s->mode);
    const float last = slip_f32_half_increment(f, drive, s->mode, s->x + end->dx, end->v, y, false);
    const struct hermite_f32 vr = hermite_f32_make(s->disc - s->v, -2.0f * end->first, s->disc - end->v, -2.0f * last);
    const struct normal_f32_arc arc = switch_arc(&s->normal, c->normal.step, y, w);
    float x_rest = s->x_rest;
    float place;
    float x;

    if (signed_by(s->mode, vr.value0) <= 0.0f || !hermite_f32_crossing(&vr, s->disc - end->v, &place)) {
        return false;
    }
    x = fmath_add_kept(s->x, slip_f32_dx_at_crossing(f, &vr, PLANT_SLIP_PLUS, s->v, s->disc, place), &x_rest);
    if (!switch_is_held(s, f, x, normal_f32_arc_y(&arc, place))) {
        return false;
    }
    x = fmath_add_kept(x, (1.0f - place) * s->turning.carry, &x_rest);
    if (!switch_is_held(s, f, x, y)) {
        return false;
    }
    switch_at(s, place, PLANT_STICK);
    s->x = x;
    s->x_rest = x_rest;
    s->v = s->disc;
    s->normal.y = y;
    s->normal.w = w;
    return true;
}

/* Friction does not hold the pad until the end of the step. */
BASE_INLINE bool switch_to_slip(struct step_f32 *s, const struct step_f32_coeffs *c, float y, float w)
{
    const struct slip_f32_factors *f = &c->whole;
    const float need = s->turning.resists + f->spring * (s->x + s->turning.carry);
    const int8_t side = need > 0.0f ? PLANT_SLIP_PLUS : PLANT_SLIP_MINUS;
    const float pull = signed_by(side, f->spring * s->turning.carry);
    const struct normal_f32_arc arc = switch_arc(&s->normal, c->normal.step, y, w);
    const float spare = f->friction * s->normal.y - signed_by(side, s->turning.resists + f->spring * s->x);
    const float spare_end = f->friction * y - fmath_abs(need);
    const struct hermite_f32 cubic =
        hermite_f32_make(spare, f->friction * arc.slope - pull, spare_end, f->friction * (c->normal.step * w) - pull);
    struct slip_f32_factors part;
    struct normal_f32_piece piece;
    struct slip_f32_end end;
    float x_rest = s->x_rest;
    float place;
    float x;

    if (spare <= 0.0f || !hermite_f32_crossing(&cubic, spare_end, &place)) {
        return false;
    }
    x = fmath_add_kept(s->x, place * s->turning.carry, &x_rest);
    part = slip_f32_take_part(f, 1.0f - place);
    piece.p1 = normal_f32_arc_y(&arc, place);
    piece.p2 = normal_f32_arc_y(&arc, 0.5f * (place + 1.0f));
    piece.p3 = piece.p2;
    piece.p4 = y;
    slip_f32_go(&part, slip_f32_drive(&part, s->disc, side), side, x, s->disc, &piece, &end, false);
    if (!(signed_by(side, s->disc - end.v) >= 0.0f)) {
        return false;
    }
    switch_at(s, place, side);
    s->x = fmath_add_kept(x, end.dx, &x_rest);
    s->x_rest = x_rest;
    s->v = end.v;
    s->normal.y = y;
    s->normal.w = w;
    return true;
}

#endif
