/* One switch of regime in a step, and no more. */
#include "model/switch_q27.h"

#include "model/event_q27.h"
#include "model/hermite_q27.h"

enum { ONE = NORMAL_Q27_WHOLE };

/* The pad has switched and is at the end of the step. */
BASE_INLINE void finish(struct step_q27 *s, int8_t mode, int32_t x, int32_t v, int32_t y, int32_t w)
{
    s->x = x;
    s->v = v;
    s->mode = mode;
    s->normal.y = y;
    s->normal.w = w;
}

uint32_t switch_q27_cross(struct step_q27 *s, const struct step_q27_coeffs *c, int32_t y, int32_t w,
                          const struct slip_q27_end *end)
{
    const struct slip_q27_view view = {s->x, s->v, s->disc, s->turning.drive};
    const int32_t vr_start = view.disc - view.v;
    const int32_t vr_end = view.disc - end->v;
    struct normal_q27_arc arc;
    int32_t last, place, x, meeting;

    if (vr_start <= 0 || vr_end >= 0) {
        return 0u;
    }
    last = slip_q27_fine_increment(&c->fine, &view, end->x, end->v, y, false);
    place = hermite_q27_find(vr_start, -end->first, vr_end, -last);
    if (place <= 0 || place >= ONE - EVENT_Q27_REST_LEAST) {
        return 0u;
    }
    normal_q27_arc_fit(&arc, &s->normal, &c->normal, y, w);
    x = event_q27_x_meeting(&c->fine, &view, end, last, place, NULL);
    meeting = arc.y + normal_q27_arc_change(&arc, place);
    if (meeting < 0 || !event_q27_is_held(c, x, view.disc, meeting, 0)) {
        return 0u;
    }
    x += event_q27_carried(c, view.disc, ONE - place);
    if (!event_q27_is_held(c, x, view.disc, y, 0)) {
        return 0u;
    }
    finish(s, PLANT_STICK, x, view.disc, y, w);
    s->rest = event_q27_no_rest;
    return (uint32_t)(ONE - place);
}

/* Where friction can no longer hold the pad against a pull forward, or 0 where this is no simple case. */
static int32_t find_release(const struct step_q27 *s, const struct step_q27_coeffs *c, const struct normal_q27_arc *arc,
                            int32_t y_end)
{
    const int32_t travel = event_q27_carried(c, s->disc, ONE);
    const int64_t need = event_q27_need(c, s->x, s->disc);
    const int64_t need_end = event_q27_need(c, s->x + travel, s->disc);
    const int64_t spare = (int64_t)c->wide.friction * arc->y - need;
    const int64_t spare_end = (int64_t)c->wide.friction * y_end - need_end;
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

uint32_t switch_q27_release(struct step_q27 *s, const struct step_q27_coeffs *c, int32_t y, int32_t w)
{
    struct normal_q27_piece piece;
    struct slip_q27_view view = {0, s->v, s->disc, 0};
    struct slip_q27_factors part;
    struct slip_q27_end end;
    struct normal_q27_arc arc;
    int32_t place;

    normal_q27_arc_fit(&arc, &s->normal, &c->normal, y, w);
    place = find_release(s, c, &arc, y);
    if (place <= 0 || place >= ONE - EVENT_Q27_REST_LEAST) {
        return 0u;
    }
    piece.p1 = arc.y + normal_q27_arc_change(&arc, place);
    piece.p2 = arc.y + normal_q27_arc_change(&arc, place + (ONE - place) / 2);
    piece.p4 = y;
    if ((piece.p1 | piece.p2) < 0) {
        return 0u;
    }
    slip_q27_fine_part(&c->fine, ONE - place, &part);
    view.x = s->x + event_q27_carried(c, s->disc, place);
    view.drive = slip_q27_drive(&part, view.disc, NULL);
    slip_q27_go_fine(&part, &view, &event_q27_no_rest, &piece, &end, true, false);
    if (end.v > view.disc) {
        return 0u;
    }
    finish(s, PLANT_SLIP_PLUS, end.x, end.v, y, w);
    s->rest = end.rest;
    return (uint32_t)place;
}
