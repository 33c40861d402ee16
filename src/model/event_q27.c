/* The pieces of one step of the Q4.27 plant. */
#include "model/event_q27.h"

#include "model/hermite_q27.h"

enum {
    REST_LEAST = 1 << 10, /* of a step in Q30: nothing happens in what is left then */
    NOT_HERE = -1,
    FACTOR_BITS = SLIP_Q27_WIDE
};

static int32_t signed_by(int8_t sign, int32_t value) { return sign < 0 ? -value : value; }

/* The factors of a part of the step; the whole has them ready. */
static const struct slip_q27_factors *take_part(const struct step_q27_coeffs *c, int32_t fraction,
                                                struct slip_q27_factors *part)
{
    const struct slip_q27_factors *whole = &c->wide;

    if (fraction == NORMAL_Q27_WHOLE) {
        return whole;
    }
    part->sixth = whole->sixth;
    part->travel = fixed_part(whole->travel, fraction);
    part->spring = fixed_part(whole->spring, fraction);
    part->stretch = (int32_t)fixed_round_up((int64_t)part->spring * part->travel, 32u);
    part->half_stretch = (int32_t)fixed_round_up((int64_t)part->spring * part->travel, 33u);
    part->friction = fixed_part(whole->friction, fraction);
    part->fade = fixed_part(whole->fade, fraction);
    part->drag = (int64_t)fixed_part(c->drag, fraction) * (1 << 27) + (1 << 26);
    if (c->has_floor) {
        part->floor = fixed_part(whole->floor, fraction);
        part->knee = ((int64_t)part->floor - part->friction) * (1 << 27);
    }
    return part;
}

/* The pad as seen from the given side. */
static struct slip_q27_view view_from(struct step_q27 *s, const struct slip_q27_factors *f, int8_t side)
{
    struct slip_q27_view view = {signed_by(side, s->x), signed_by(side, s->v), signed_by(side, s->disc), 0};

    view.drive = slip_q27_drive(f, view.disc, &s->is_saturated);
    return view;
}

static BASE_NOINLINE int32_t increment(struct step_q27 *s, const struct step_q27_coeffs *c,
                                       const struct slip_q27_factors *f, const struct slip_q27_view *view, int32_t x, int32_t v, int32_t p)
{
    return slip_q27_increment(f, view, slip_q27_pull(f, x, FACTOR_BITS), v, p, c->has_floor, FACTOR_BITS, &s->is_saturated);
}

static BASE_NOINLINE void slip(struct step_q27 *s, const struct step_q27_coeffs *c, const struct slip_q27_factors *f,
                 const struct slip_q27_view *view, const struct normal_q27_piece *piece, struct slip_q27_end *end)
{
    slip_q27_go(f, view, piece, end, c->has_floor, FACTOR_BITS, &s->is_saturated);
}

/* At vr = 0 the pad sticks if friction can hold it; otherwise it slips to the side that the need pulls it to. The same
 * test serves entry and exit: static and kinetic friction are equal at vr = 0. */
static int8_t regime_at_rest(const struct step_q27 *s, const struct step_q27_coeffs *c, int64_t extra)
{
    if (event_q27_is_held(c, s->x, s->disc, normal_q27_force(&s->normal, s->normal.y), extra)) {
        return PLANT_STICK;
    }
    return event_q27_need(c, s->x, s->disc) + extra > 0 ? PLANT_SLIP_PLUS : PLANT_SLIP_MINUS;
}

void event_q27_set_speed(struct step_q27 *s, const struct step_q27_coeffs *c, int32_t speed)
{
    const int64_t change = (int64_t)speed - s->disc;

    s->disc = speed;
    if (s->mode == PLANT_STICK && regime_at_rest(s, c, change * (1 << FACTOR_BITS)) == PLANT_STICK) {
        s->v = speed;
        return;
    }
    if (s->v != speed) {
        s->mode = s->v < speed ? PLANT_SLIP_PLUS : PLANT_SLIP_MINUS;
    } else {
        s->mode = regime_at_rest(s, c, 0);
    }
}

/* Books a piece that has been gone through. */
static void advance(struct step_q27 *s, struct event_q27_progress *progress, const struct normal_q27_piece *piece,
                    int32_t fraction)
{
    if (s->mode == PLANT_STICK) {
        progress->stick += (uint32_t)fraction;
    } else if (s->mode == PLANT_SLIP_MINUS) {
        progress->slip_minus += (uint32_t)fraction;
    }
    normal_q27_move(&s->normal, piece);
    progress->rest -= fraction;
    progress->is_whole = false;
}

static int32_t look(struct step_q27 *s, const struct step_q27_coeffs *c, int32_t place, int32_t fraction,
                    struct normal_q27_piece *piece)
{
    const int32_t part = fixed_part(place, fraction);

    if (part > 0) {
        normal_q27_look(&s->normal, &c->normal, part, false, piece, &s->is_saturated);
    }
    return part;
}

/* Looks for vr = 0 in a slip piece, also for a dip below 0 and back. Returns the place in (0, 1], 0 for "at the start",
 * or NOT_HERE. */
static int32_t find_crossing(struct step_q27 *s, const struct step_q27_coeffs *c, const struct slip_q27_factors *f,
                             const struct slip_q27_view *view, const struct normal_q27_piece *piece,
                             const struct slip_q27_end *end)
{
    const int64_t f0 = (int64_t)view->disc - view->v;
    const int64_t f1 = (int64_t)view->disc - end->v;
    const int64_t d0 = -(int64_t)end->first;
    struct hermite_q27 vr;
    int32_t upper = HERMITE_Q27_ONE;
    int64_t d1;

    /* A curve that stays above its first tangent stays above 0 when the tangent does. */
    if (f1 >= 0 && (d0 >= 0 || f0 + d0 > 0 || f0 <= 0)) {
        return NOT_HERE;
    }
    d1 = -(int64_t)increment(s, c, f, view, end->x, end->v, normal_q27_force(&s->normal, piece->y));
    vr = hermite_q27_make(f0, d0, f1, d1);
    if (f1 >= 0) {
        if (d1 <= 0) {
            return NOT_HERE;
        }
        upper = hermite_q27_minimum(&vr);
        if (hermite_q27_value(&vr, upper) >= 0) {
            return NOT_HERE;
        }
    }
    if (f0 <= 0) {
        return d0 <= 0 ? 0 : hermite_q27_root_after_start(&vr);
    }
    return hermite_q27_root(&vr, upper);
}

static void slip_piece(struct step_q27 *s, const struct step_q27_coeffs *c, struct event_q27_progress *progress,
                       struct normal_q27_piece *piece, int32_t fraction, const struct slip_q27_end *known)
{
    const int8_t side = s->mode;
    struct slip_q27_factors part;
    const struct slip_q27_factors *factors = take_part(c, fraction, &part);
    struct slip_q27_view view = view_from(s, factors, side);
    struct slip_q27_end end;
    int32_t place;

    if (known != NULL) {
        end = *known;
    } else {
        slip(s, c, factors, &view, piece, &end);
    }
    place = find_crossing(s, c, factors, &view, piece, &end);
    if (place != NOT_HERE && progress->events == PLANT_EVENTS_MAX) {
        progress->is_capped = true;
        place = NOT_HERE;
    }
    if (place == NOT_HERE) {
        advance(s, progress, piece, fraction);
        s->x = signed_by(side, end.x);
        s->v = signed_by(side, end.v);
        return;
    }
    progress->events++;
    fraction = look(s, c, place, fraction, piece);
    if (fraction > 0) {
        factors = take_part(c, fraction, &part);
        view = view_from(s, factors, side);
        slip(s, c, factors, &view, piece, &end);
        advance(s, progress, piece, fraction);
        s->x = signed_by(side, end.x);
    }
    s->v = s->disc;
    s->mode = regime_at_rest(s, c, 0);
}

/* Change of the contact force over the piece at the rate w: 0 where the force is held at 0. */
static int32_t force_change(const struct step_q27 *s, const struct step_q27_coeffs *c, int32_t y, int32_t w,
                            int32_t fraction)
{
    if (normal_q27_force(&s->normal, y) != y) {
        return 0;
    }
    return fixed_product(fixed_part(c->normal.step, fraction), w, 32u);
}

/* Where in a stick piece friction can no longer hold the pad. */
static int32_t find_exit(const struct step_q27 *s, const struct step_q27_coeffs *c,
                         const struct normal_q27_piece *piece, int32_t fraction, int8_t side, int32_t travel,
                         int64_t spare_end)
{
    enum { UNIT_BITS = 4 }; /* taken off so that the cubic's coefficients fit */
    const int64_t need_start = event_q27_need(c, s->x, s->disc);
    const int64_t spare_start = (int64_t)c->wide.friction * piece->p1 - (side < 0 ? -need_start : need_start);
    const int64_t pull = -(int64_t)c->wide.spring * signed_by(side, travel);
    const int64_t rise_start =
        (int64_t)c->wide.friction * force_change(s, c, s->normal.y, s->normal.w, fraction) - pull;
    const int64_t rise_end = (int64_t)c->wide.friction * force_change(s, c, piece->y, piece->w, fraction) - pull;
    struct hermite_q27 spare;

    if (spare_start <= 0) {
        return 0;
    }
    spare = hermite_q27_make(fixed_shift_right(spare_start, UNIT_BITS), fixed_shift_right(rise_start, UNIT_BITS),
                             fixed_shift_right(spare_end, UNIT_BITS), fixed_shift_right(rise_end, UNIT_BITS));
    return hermite_q27_root(&spare, HERMITE_Q27_ONE);
}

static int32_t carried(const struct step_q27_coeffs *c, int32_t disc, int32_t fraction)
{
    return fixed_product(fixed_part(c->wide.travel, fraction), disc, 32u);
}

static void stick_piece(struct step_q27 *s, const struct step_q27_coeffs *c, struct event_q27_progress *progress,
                        struct normal_q27_piece *piece, int32_t fraction)
{
    const int32_t travel = carried(c, s->disc, fraction);
    const int32_t x_end = fixed_saturate_and_tell((int64_t)s->x + travel, &s->is_saturated);
    const int64_t need_end = event_q27_need(c, x_end, s->disc);
    const int8_t side = need_end > 0 ? PLANT_SLIP_PLUS : PLANT_SLIP_MINUS;
    const int64_t spare_end = (int64_t)c->wide.friction * normal_q27_force(&s->normal, piece->y) -
                              (side < 0 ? -need_end : need_end);

    if (spare_end >= 0 || progress->events == PLANT_EVENTS_MAX) {
        progress->is_capped = progress->is_capped || spare_end < 0;
        advance(s, progress, piece, fraction);
        s->x = x_end;
        return;
    }
    progress->events++;
    fraction = look(s, c, find_exit(s, c, piece, fraction, side, travel, spare_end), fraction, piece);
    if (fraction > 0) {
        s->x = fixed_saturate_and_tell((int64_t)s->x + carried(c, s->disc, fraction), &s->is_saturated);
        advance(s, progress, piece, fraction);
    }
    s->mode = side;
}

/* Where the spring lets go or takes hold (contact lift) the piece ends there. Returns its share of the step. */
static int32_t cut_at_contact(struct step_q27 *s, const struct step_q27_coeffs *c,
                              const struct event_q27_progress *progress, struct normal_q27_piece *piece, bool *changes)
{
    const struct normal_q27 *normal = &s->normal;
    const int8_t sign = normal->is_lifted ? -1 : 1;
    const int32_t t = fixed_part(c->normal.step, progress->rest);
    struct hermite_q27 gap;
    int32_t place = 0;

    *changes = false;
    if (c->normal.contact != CONTACT_LIFT || normal->is_steady_from_rest || signed_by(sign, piece->y) >= 0 ||
        progress->contacts == PLANT_CONTACTS_MAX) {
        return progress->rest;
    }
    *changes = true;
    gap = hermite_q27_make(signed_by(sign, normal->y), signed_by(sign, fixed_product(t, normal->w, 32u)),
                           signed_by(sign, piece->y), signed_by(sign, fixed_product(t, piece->w, 32u)));
    if (signed_by(sign, normal->y) > 0) {
        place = hermite_q27_root(&gap, HERMITE_Q27_ONE);
    } else if (signed_by(sign, normal->w) > 0) {
        place = hermite_q27_root_after_start(&gap);
    }
    return look(s, c, place, progress->rest, piece);
}

static void change_contact(struct step_q27 *s, const struct step_q27_coeffs *c, struct event_q27_progress *progress)
{
    progress->contacts++;
    normal_q27_change_contact(&s->normal);
    if (s->normal.is_lifted && s->mode == PLANT_STICK) {
        s->mode = regime_at_rest(s, c, 0);
    }
}

void event_q27_step(struct step_q27 *s, const struct step_q27_coeffs *c, struct event_q27_progress *progress,
                    const struct event_q27_attempt *attempt)
{
    while (progress->rest > REST_LEAST) {
        const unsigned events = progress->events;
        const struct slip_q27_end *known = NULL;
        struct normal_q27_piece piece;
        int32_t fraction;
        bool contact_changes;

        if (attempt != NULL && progress->is_whole) {
            piece = attempt->piece;
            known = &attempt->end;
        } else {
            normal_q27_look(&s->normal, &c->normal, progress->rest, progress->is_whole, &piece, &s->is_saturated);
        }
        fraction = cut_at_contact(s, c, progress, &piece, &contact_changes);
        if (fraction > 0) {
            if (s->mode == PLANT_STICK) {
                stick_piece(s, c, progress, &piece, fraction);
            } else {
                slip_piece(s, c, progress, &piece, fraction, contact_changes ? NULL : known);
            }
        }
        if (contact_changes && progress->events == events) {
            change_contact(s, c, progress);
        }
        progress->is_lifted = progress->is_lifted || s->normal.y < 0;
    }
}

/* The sign of vr afresh at every stage, 0 at vr = 0, and no stick. */
static int32_t naive_increment(struct step_q27 *s, const struct step_q27_coeffs *c, int32_t x, int32_t v, int32_t p)
{
    const int8_t side = (int8_t)((s->disc > v) - (s->disc < v));
    const struct slip_q27_view view = view_from(s, &c->wide, side);

    if (side == 0) {
        return fixed_saturate_and_tell(-fixed_shift_right(event_q27_need(c, x, v), FACTOR_BITS), &s->is_saturated);
    }
    return signed_by(side, increment(s, c, &c->wide, &view, signed_by(side, x), signed_by(side, v), p));
}

void event_q27_naive_step(struct step_q27 *s, const struct step_q27_coeffs *c, struct event_q27_progress *progress)
{
    const int32_t travel = c->wide.travel;
    bool *const tell = &s->is_saturated;
    struct normal_q27_piece piece;
    int32_t a1, a2, a3, a4, v2, v3, v4;

    normal_q27_look(&s->normal, &c->normal, progress->rest, true, &piece, tell);
    a1 = naive_increment(s, c, s->x, s->v, piece.p1);
    v2 = fixed_saturate_and_tell(s->v + fixed_shift_right(a1, 1u), tell);
    a2 = naive_increment(s, c, fixed_saturate_and_tell((int64_t)s->x + fixed_product(travel / 2, s->v, 32u), tell), v2,
                         piece.p2);
    v3 = fixed_saturate_and_tell(s->v + fixed_shift_right(a2, 1u), tell);
    a3 = naive_increment(s, c, fixed_saturate_and_tell((int64_t)s->x + fixed_product(travel / 2, v2, 32u), tell), v3,
                         piece.p3);
    v4 = fixed_saturate_and_tell((int64_t)s->v + a3, tell);
    a4 = naive_increment(s, c, fixed_saturate_and_tell((int64_t)s->x + fixed_product(travel, v3, 32u), tell), v4,
                         piece.p4);
    {
        const int64_t mean = fixed_shift_right(SUM_Q27_SIXTH * ((int64_t)a1 + a2 + a3), 32u) + s->v;
        const int64_t gain = SUM_Q27_SIXTH * ((int64_t)a1 + 2 * ((int64_t)a2 + a3) + a4);

        s->x = fixed_saturate_and_tell(
            s->x + fixed_shift_right((int64_t)travel * fixed_saturate_and_tell(mean, tell), 32u), tell);
        s->v = fixed_saturate_and_tell(s->v + fixed_shift_right(gain, 32u), tell);
    }
    s->mode = (int8_t)((s->disc > s->v) - (s->disc < s->v));
    advance(s, progress, &piece, progress->rest);
    progress->is_lifted = s->normal.y < 0;
    if (c->normal.contact == CONTACT_LIFT && !s->normal.is_steady_from_rest) {
        s->normal.is_lifted = s->normal.y < 0;
    }
}
