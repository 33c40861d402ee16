/* One switch of regime in a step, and no more. */
#include "model/switch_q27.h"

#include "model/event_q27.h"
#include "model/hermite_q27.h"

enum { ONE = NORMAL_Q27_WHOLE };

/* A step with one switch at work. */
struct attempt {
    struct step_q27 *s;
    const struct step_q27_coeffs *c;
    int32_t y, w; /* at its end */
    struct normal_q27_arc arc;
    int32_t place; /* of the switch, Q30 */
};

BASE_INLINE int32_t signed_by(int8_t side, int32_t value) { return side < 0 ? -value : value; }

BASE_INLINE void begin(struct attempt *attempt, struct step_q27 *s, const struct step_q27_coeffs *c, int32_t y,
                       int32_t w)
{
    attempt->s = s;
    attempt->c = c;
    attempt->y = y;
    attempt->w = w;
    normal_q27_arc_fit(&attempt->arc, &s->normal, &c->normal, y, w);
}

BASE_INLINE int32_t y_at(const struct attempt *attempt, int32_t place)
{
    return attempt->arc.y + normal_q27_arc_change(&attempt->arc, place);
}

/* A switch that leaves next to nothing of the step, or none before it, is another kind. */
BASE_INLINE bool is_inside(int32_t place) { return place > 0 && place < ONE - EVENT_Q27_REST_LEAST; }

/* The pad is at the end of the step in its new regime. */
BASE_INLINE void finish(const struct attempt *attempt, int8_t mode, int32_t x, int32_t v, int32_t stick,
                        int32_t slip_minus)
{
    struct step_q27 *s = attempt->s;

    s->output.noted = (struct plant_notes){.stick = (uint32_t)stick, .slip_minus = (uint32_t)slip_minus, .events = 1u};
    s->x = x;
    s->v = v;
    s->mode = mode;
    s->normal.y = attempt->y;
    s->normal.w = attempt->w;
}

/* From x on the pad sticks to the end. */
BASE_INLINE bool stick_on(const struct attempt *attempt, int32_t x)
{
    struct step_q27 *s = attempt->s;
    const int32_t x_end = x + event_q27_carried(attempt->c, s->disc, ONE - attempt->place);

    if (!event_q27_is_held_surely(s, attempt->c, x_end, attempt->y)) {
        return false;
    }
    finish(attempt, PLANT_STICK, x_end, s->disc, ONE - attempt->place, s->mode < 0 ? attempt->place : 0);
    s->rest = event_q27_no_rest;
    return true;
}

/* From x on, where the contact force is p, the pad slips to the end. */
static BASE_NOINLINE bool slip_on(const struct attempt *attempt, int8_t side, int32_t x, int32_t p)
{
    struct step_q27 *s = attempt->s;
    const int32_t place = attempt->place;
    const int32_t middle = y_at(attempt, place + fixed_floor_word(ONE - place, 1u));
    const struct normal_q27_piece piece = {.p1 = p, .p2 = middle, .p4 = attempt->y};
    const int32_t disc = signed_by(side, s->disc);
    struct slip_q27_view view = {signed_by(side, x), disc, disc, 0};
    struct slip_q27_factors part;
    struct slip_q27_end end;

    slip_q27_fine_part(&attempt->c->fine, ONE - place, &part);
    view.drive = slip_q27_drive(&part, disc, NULL);
    slip_q27_go_fine(&part, &view, &event_q27_no_rest, &piece, &end, true, false);
    if (middle < 0 || end.v > disc) {
        return false;
    }
    finish(attempt, side, signed_by(side, end.x), signed_by(side, end.v), s->mode == PLANT_STICK ? place : 0,
           side < 0      ? ONE - place
           : s->mode < 0 ? place
                         : 0);
    s->rest = end.rest;
    return true;
}

bool switch_q27_cross(struct step_q27 *s, const struct step_q27_coeffs *c, int32_t y, int32_t w,
                      const struct slip_q27_end *end)
{
    const int8_t side = s->mode;
    const int32_t disc = signed_by(side, s->disc);
    struct slip_q27_view view = {signed_by(side, s->x), signed_by(side, s->v), disc, s->turning.drive};
    struct attempt attempt;
    int32_t last, x, p;

    if (disc <= view.v || disc >= end->v) {
        return false;
    }
    if (side < 0) {
        view.drive = slip_q27_drive(&c->fine, disc, NULL);
    }
    last = slip_q27_fine_increment(&c->fine, &view, end->x, end->v, y, false);
    begin(&attempt, s, c, y, w);
    attempt.place = hermite_q27_find(disc - view.v, -end->first, disc - end->v, -last);
    p = y_at(&attempt, attempt.place);
    if (!is_inside(attempt.place) || p < 0) {
        return false;
    }
    x = signed_by(side, event_q27_x_meeting(&c->fine, &view, end, last, attempt.place, NULL));
    if (event_q27_is_held_surely(s, c, x, p) || event_q27_is_held(c, x, s->disc, p, 0)) {
        return stick_on(&attempt, x);
    }
    return signed_by(side, event_q27_need(c, x, s->disc) > 0 ? 1 : -1) < 0 && slip_on(&attempt, -side, x, p);
}

/* Where friction can no longer hold the pad against a pull forward, or 0 where this is no simple case. */
BASE_INLINE int32_t find_release(const struct attempt *attempt)
{
    const struct step_q27_coeffs *c = attempt->c;
    const struct step_q27 *s = attempt->s;
    const struct normal_q27_arc *arc = &attempt->arc;
    const int32_t travel = event_q27_carried(c, s->disc, ONE);
    const int64_t need = event_q27_need(c, s->x, s->disc);
    const int64_t need_end = event_q27_need(c, s->x + travel, s->disc);
    const int64_t spare = (int64_t)c->wide.friction * arc->y - need;
    const int64_t spare_end = (int64_t)c->wide.friction * attempt->y - need_end;
    const int64_t pull = (int64_t)c->wide.spring * travel;
    const int32_t slope_end = arc->slope + normal_q27_arc_turn(arc, ONE);

    if (need_end <= 0 || spare <= 0 || spare_end >= 0) {
        return 0;
    }
    return hermite_q27_find(event_q27_upper(spare),
                            event_q27_upper((int64_t)c->wide.friction * fixed_part_near(arc->slope, ONE) + pull),
                            event_q27_upper(spare_end),
                            event_q27_upper((int64_t)c->wide.friction * fixed_part_near(slope_end, ONE) + pull));
}

bool switch_q27_release(struct step_q27 *s, const struct step_q27_coeffs *c, int32_t y, int32_t w)
{
    struct attempt attempt;
    int32_t p;

    begin(&attempt, s, c, y, w);
    attempt.place = find_release(&attempt);
    p = y_at(&attempt, attempt.place);
    return is_inside(attempt.place) && p >= 0 &&
           slip_on(&attempt, PLANT_SLIP_PLUS, s->x + event_q27_carried(c, s->disc, attempt.place), p);
}
