/* One switch of regime in a step, and no more. */
#include "model/switch_q27.h"

#include "model/event_q27.h"
#include "model/hermite_q27.h"

enum { ONE = NORMAL_Q27_WHOLE };

/* The pad has switched and is at the end of the step. */
static void finish(struct step_q27 *s, const struct normal_q27_piece *tried, int8_t mode, int32_t x, int32_t v)
{
    s->x = x;
    s->v = v;
    s->mode = mode;
    normal_q27_move(&s->normal, tried);
}

bool switch_q27_cross(struct step_q27 *s, const struct step_q27_coeffs *c, const struct normal_q27_piece *tried,
                      const struct slip_q27_end *end, uint32_t *stick)
{
    const struct slip_q27_view view = {s->x, s->v, s->disc, s->turning.drive};
    const int32_t vr_start = view.disc - view.v;
    const int32_t vr_end = view.disc - end->v;
    struct normal_q27_arc arc;
    struct hermite_q27 vr;
    int32_t last, place, x, y;

    if (vr_start <= 0 || vr_end >= 0) {
        return false;
    }
    last = slip_q27_fine_increment(&c->fine, &view, end->x, end->v, tried->y, false);
    vr = hermite_q27_make(vr_start, -end->first, vr_end, -last);
    place = hermite_q27_root(&vr, HERMITE_Q27_ONE);
    if (place <= 0 || place >= ONE - EVENT_Q27_REST_LEAST) {
        return false;
    }
    normal_q27_arc_fit(&arc, &s->normal, &c->normal, tried);
    x = event_q27_x_meeting(&c->fine, &view, end, last, place, NULL);
    y = arc.y + normal_q27_arc_change(&arc, place);
    if (y < 0 || !event_q27_is_held(c, x, view.disc, y, 0)) {
        return false;
    }
    x += event_q27_carried(c, view.disc, ONE - place);
    if (!event_q27_is_held(c, x, view.disc, tried->y, 0)) {
        return false;
    }
    finish(s, tried, PLANT_STICK, x, view.disc);
    s->rest = event_q27_no_rest;
    *stick = (uint32_t)(ONE - place);
    return true;
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
    struct hermite_q27 cubic;

    if (need_end <= 0 || spare <= 0 || spare_end >= 0) {
        return 0;
    }
    cubic = hermite_q27_make(event_q27_upper(spare),
                             event_q27_upper((int64_t)c->wide.friction * fixed_part_near(arc->slope, ONE) + pull),
                             event_q27_upper(spare_end),
                             event_q27_upper((int64_t)c->wide.friction * fixed_part_near(slope_end, ONE) + pull));
    return hermite_q27_root(&cubic, HERMITE_Q27_ONE);
}

bool switch_q27_release(struct step_q27 *s, const struct step_q27_coeffs *c, const struct normal_q27_piece *tried,
                        uint32_t *stick)
{
    struct normal_q27_piece piece = {.p4 = tried->y};
    struct slip_q27_view view = {0, s->v, s->disc, 0};
    struct slip_q27_factors part;
    struct slip_q27_end end;
    struct normal_q27_arc arc;
    int32_t place;

    normal_q27_arc_fit(&arc, &s->normal, &c->normal, tried);
    place = find_release(s, c, &arc, tried->y);
    if (place <= 0 || place >= ONE - EVENT_Q27_REST_LEAST) {
        return false;
    }
    piece.p1 = arc.y + normal_q27_arc_change(&arc, place);
    piece.p2 = arc.y + normal_q27_arc_change(&arc, place + (ONE - place) / 2);
    if ((piece.p1 | piece.p2) < 0) {
        return false;
    }
    slip_q27_fine_part(&c->fine, ONE - place, &part);
    view.x = s->x + event_q27_carried(c, s->disc, place);
    view.drive = slip_q27_drive(&part, view.disc, NULL);
    slip_q27_go_fine(&part, &view, &event_q27_no_rest, &piece, &end, true, false);
    if (end.v > view.disc) {
        return false;
    }
    finish(s, tried, PLANT_SLIP_PLUS, end.x, end.v);
    s->rest = end.rest;
    *stick = (uint32_t)place;
    return true;
}
