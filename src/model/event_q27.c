/* The pieces of one step of the Q4.27 plant. */
#include "model/event_q27.h"

#include "model/hermite_q27.h"

enum { ONE = NORMAL_Q27_WHOLE, NOT_HERE = -1 };

/* A stretch of the step without a change of contact, on which y is known. Places on it run from 0 to ONE. */
struct stretch {
    struct normal_q27_arc arc;
    int32_t fraction; /* of the step */
    int32_t at;       /* where the pad is */
    int32_t y_end;
};

/* One step at work. */
struct work {
    struct step_q27 *s;
    const struct step_q27_coeffs *c;
    struct event_q27_progress *progress;
    struct stretch stretch;
    bool *tell; /* NULL where the fine arithmetic serves; else what the wide one sets where a number does not fit */
};

static int32_t signed_by(int8_t sign, int32_t value) { return sign < 0 ? -value : value; }

static int32_t force_of(const struct work *work, int32_t y) { return normal_q27_force(&work->s->normal, y); }

/* The way from here to a place on the stretch, as a fraction of the step. */
static int32_t fraction_to(const struct work *work, int32_t place)
{
    return fixed_part(work->stretch.fraction, place - work->stretch.at);
}

/* A place between here and the end of the stretch. */
static int32_t place_within(const struct work *work, int32_t part)
{
    return work->stretch.at + fixed_part(part, ONE - work->stretch.at);
}

/* Books the way to a place, where y is as given, and goes there. */
static void move_to(struct work *work, int32_t place, int32_t y)
{
    const uint32_t fraction = (uint32_t)fraction_to(work, place);

    if (work->s->mode == PLANT_STICK) {
        work->progress->notes.stick += fraction;
    } else if (work->s->mode == PLANT_SLIP_MINUS) {
        work->progress->notes.slip_minus += fraction;
    }
    work->stretch.at = place;
    work->s->normal.y = y;
    work->progress->notes.is_lifted = work->progress->notes.is_lifted || y < 0;
}

/* The factors of the way from here to a place; the whole step has them ready. */
static const struct slip_q27_factors *take_part(const struct work *work, int32_t place, struct slip_q27_factors *part)
{
    const struct slip_q27_factors *whole = work->tell == NULL ? &work->c->fine : &work->c->wide;
    const int32_t fraction = fraction_to(work, place);

    if (fraction == ONE) {
        return whole;
    }
    slip_q27_take_part(whole, fraction, work->c->has_floor, work->tell != NULL, part);
    return part;
}

/* The pad as seen from the given side. */
static struct slip_q27_view view_from(const struct work *work, const struct slip_q27_factors *f, int8_t side)
{
    const struct step_q27 *s = work->s;
    struct slip_q27_view view = {signed_by(side, s->x), signed_by(side, s->v), signed_by(side, s->disc), 0};

    view.drive = slip_q27_drive(f, view.disc, work->tell);
    return view;
}

/* From here to the end of the stretch. */
static void slip(const struct work *work, const struct slip_q27_factors *f, const struct slip_q27_view *view,
                 struct slip_q27_end *end)
{
    const int32_t at = work->stretch.at;
    const int32_t middle = force_of(work, normal_q27_arc_y(&work->stretch.arc, at + (ONE - at) / 2));
    const struct normal_q27_piece piece = {
        .p1 = force_of(work, work->s->normal.y), .p2 = middle, .p3 = middle, .p4 = force_of(work, work->stretch.y_end)};

    slip_q27_any_go(f, view, &work->s->rest, &piece, end, work->c->has_floor, work->tell);
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
    int8_t mode;

    s->disc = speed;
    if (s->mode == PLANT_STICK && regime_at_rest(s, c, change * (1 << SLIP_Q27_WIDE)) == PLANT_STICK) {
        s->v = speed;
        return;
    }
    if (s->v != speed) {
        mode = s->v < speed ? PLANT_SLIP_PLUS : PLANT_SLIP_MINUS;
    } else {
        mode = regime_at_rest(s, c, 0);
    }
    if (mode != s->mode) {
        event_q27_enter(s, mode);
    }
}

/* A slip piece that reaches to the end of the stretch. */
struct slip_piece {
    const struct slip_q27_factors *factors;
    struct slip_q27_view view;
    struct slip_q27_end end;
    int32_t last; /* increment at its end; known once a crossing has been found */
};

/* vr and its changes along a piece. Wide ones may exceed a word. */
static struct hermite_q27 make_vr(const struct work *work, int64_t f0, int32_t d0, int64_t f1, int32_t d1)
{
    return work->tell == NULL ? hermite_q27_make((int32_t)f0, d0, (int32_t)f1, d1)
                              : hermite_q27_make_wide(f0, d0, f1, d1);
}

/* Looks for vr = 0, also for a dip below 0 and back. Returns its place on the piece in (0, 1], 0 for "at the start", or
 * NOT_HERE. */
static int32_t find_crossing(const struct work *work, struct slip_piece *piece)
{
    const int64_t f0 = (int64_t)piece->view.disc - piece->view.v;
    const int64_t f1 = (int64_t)piece->view.disc - piece->end.v;
    const int32_t d0 = -piece->end.first;
    struct hermite_q27 vr;
    int32_t upper = HERMITE_Q27_ONE;

    /* A curve that stays above its first tangent stays above 0 when the tangent does. */
    if (f1 >= 0 && (d0 >= 0 || f0 + d0 > 0 || f0 <= 0)) {
        return NOT_HERE;
    }
    piece->last = slip_q27_any_increment(piece->factors, &piece->view, piece->end.x, piece->end.v,
                                         force_of(work, work->stretch.y_end), work->c->has_floor, work->tell);
    vr = make_vr(work, f0, d0, f1, -piece->last);
    if (f1 >= 0) {
        if (piece->last >= 0) {
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

/* Slips on to the end of the stretch or to vr = 0. known is the end of a piece that is a whole step, NULL if it has not
 * been computed. */
static void slip_piece(struct work *work, const struct slip_q27_end *known)
{
    struct step_q27 *s = work->s;
    const int8_t side = s->mode;
    struct slip_q27_factors part;
    struct slip_piece piece;
    int32_t place;

    piece.factors = take_part(work, ONE, &part);
    piece.view = view_from(work, piece.factors, side);
    if (known != NULL) {
        piece.end = *known;
    } else {
        slip(work, piece.factors, &piece.view, &piece.end);
    }
    place = find_crossing(work, &piece);
    if (place != NOT_HERE && work->progress->notes.events == PLANT_EVENTS_MAX) {
        work->progress->notes.is_capped = true;
        place = NOT_HERE;
    }
    if (place == NOT_HERE) {
        move_to(work, ONE, work->stretch.y_end);
        s->x = signed_by(side, piece.end.x);
        s->v = signed_by(side, piece.end.v);
        s->rest = piece.end.rest;
        return;
    }
    work->progress->notes.events++;
    if (place > 0) {
        const int32_t meeting = place_within(work, place);

        s->x = signed_by(
            side, event_q27_x_meeting(piece.factors, &piece.view, &piece.end, piece.last, place, &s->is_saturated));
        move_to(work, meeting, normal_q27_arc_y(&work->stretch.arc, meeting));
    }
    s->v = s->disc;
    event_q27_enter(s, regime_at_rest(s, work->c, 0));
}

static int32_t carried(const struct work *work, int32_t place)
{
    return event_q27_carried(work->c, work->s->disc, fraction_to(work, place));
}

/* Change of h mu P along the rest of the stretch, as it goes at a place of it: 0 where the force is held at 0. */
static int64_t limit_change(const struct work *work, int32_t place, int32_t y)
{
    if (force_of(work, y) != y) {
        return 0;
    }
    return (int64_t)work->c->wide.friction *
           fixed_part_near(normal_q27_arc_slope(&work->stretch.arc, place), ONE - work->stretch.at);
}

/* Where on the rest of the stretch friction can no longer hold the pad; what it can spare at the end is negative. */
static int32_t find_exit(const struct work *work, int8_t side, int32_t travel, int64_t spare_end)
{
    const struct step_q27_coeffs *c = work->c;
    const int64_t need = event_q27_need(c, work->s->x, work->s->disc);
    const int64_t spare = (int64_t)c->wide.friction * force_of(work, work->s->normal.y) - (side < 0 ? -need : need);
    const int64_t pull = (int64_t)c->wide.spring * signed_by(side, travel);
    const int64_t rise_start = limit_change(work, work->stretch.at, work->s->normal.y) + pull;
    const int64_t rise_end = limit_change(work, ONE, work->stretch.y_end) + pull;
    struct hermite_q27 cubic;

    if (spare <= 0) {
        return 0;
    }
    cubic = hermite_q27_make(event_q27_upper(spare), event_q27_upper(rise_start), event_q27_upper(spare_end),
                             event_q27_upper(rise_end));
    return hermite_q27_root(&cubic, HERMITE_Q27_ONE);
}

/* Is carried on to the end of the stretch or to where the springs win. */
static void stick_piece(struct work *work)
{
    struct step_q27 *s = work->s;
    const int32_t travel = carried(work, ONE);
    const int32_t x_end = fixed_saturate_and_tell((int64_t)s->x + travel, &s->is_saturated);
    const int64_t need_end = event_q27_need(work->c, x_end, s->disc);
    const int8_t side = need_end > 0 ? PLANT_SLIP_PLUS : PLANT_SLIP_MINUS;
    const int64_t spare_end =
        (int64_t)work->c->wide.friction * force_of(work, work->stretch.y_end) - (side < 0 ? -need_end : need_end);
    int32_t place;

    if (spare_end >= 0 || work->progress->notes.events == PLANT_EVENTS_MAX) {
        work->progress->notes.is_capped = work->progress->notes.is_capped || spare_end < 0;
        move_to(work, ONE, work->stretch.y_end);
        s->x = x_end;
        return;
    }
    work->progress->notes.events++;
    place = place_within(work, find_exit(work, side, travel, spare_end));
    if (place > work->stretch.at) {
        s->x = fixed_saturate_and_tell((int64_t)s->x + carried(work, place), &s->is_saturated);
        move_to(work, place, normal_q27_arc_y(&work->stretch.arc, place));
    }
    event_q27_enter(s, side);
}

/* --- Contact ------------------------------------------------------------------------------------------------------ */

/* Where on a stretch that starts here the spring lets go or takes hold (contact lift), or NOT_HERE. */
static int32_t find_contact_change(const struct work *work, const struct normal_q27_piece *piece)
{
    const struct normal_q27 *normal = &work->s->normal;
    const int8_t sign = normal->is_lifted ? -1 : 1;
    struct hermite_q27 gap;

    if (work->c->normal.contact != CONTACT_LIFT || normal->is_steady_from_rest || signed_by(sign, piece->y) >= 0 ||
        work->progress->contacts == PLANT_CONTACTS_MAX) {
        return NOT_HERE;
    }
    gap = hermite_q27_make(signed_by(sign, normal->y), signed_by(sign, work->stretch.arc.slope),
                           signed_by(sign, piece->y), signed_by(sign, normal_q27_arc_slope(&work->stretch.arc, ONE)));
    if (signed_by(sign, normal->y) > 0) {
        return hermite_q27_root(&gap, HERMITE_Q27_ONE);
    }
    return signed_by(sign, normal->w) > 0 ? hermite_q27_root_after_start(&gap) : 0;
}

/* Opens a stretch over the rest of the step, or up to the next change of contact. Returns true if it ends with one. */
static bool open_stretch(struct work *work, int32_t rest, struct normal_q27_piece *piece)
{
    struct stretch *stretch = &work->stretch;
    struct step_q27 *s = work->s;
    const struct normal_q27_coeffs *coeffs = &work->c->normal;
    int32_t place;

    stretch->at = 0;
    stretch->fraction = rest;
    stretch->y_end = piece->y;
    normal_q27_arc_make(&stretch->arc, &s->normal, coeffs, rest, piece);
    place = find_contact_change(work, piece);
    if (place == NOT_HERE) {
        return false;
    }
    stretch->fraction = fixed_part(rest, place);
    if (stretch->fraction > 0) {
        normal_q27_look_part(&s->normal, coeffs, stretch->fraction, piece, &s->is_saturated);
    } else {
        piece->y = s->normal.y;
        piece->w = s->normal.w;
    }
    stretch->y_end = piece->y;
    normal_q27_arc_make(&stretch->arc, &s->normal, coeffs, stretch->fraction, piece);
    return true;
}

static void change_contact(struct work *work)
{
    struct step_q27 *s = work->s;

    work->progress->contacts++;
    normal_q27_change_contact(&s->normal);
    if (s->normal.is_lifted && s->mode == PLANT_STICK) {
        event_q27_enter(s, regime_at_rest(s, work->c, 0));
    }
}

/* --- The step ----------------------------------------------------------------------------------------------------- */

void event_q27_step(struct step_q27 *s, const struct step_q27_coeffs *c, struct event_q27_progress *progress,
                    const struct event_q27_attempt *attempt)
{
    struct work work;
    const struct slip_q27_end *known = NULL;
    struct normal_q27_piece piece;
    int32_t rest = ONE;
    bool contact_changes;

    work.s = s;
    work.c = c;
    work.progress = progress;
    work.tell = attempt != NULL ? NULL : &s->is_saturated;
    if (attempt != NULL) {
        piece.y = attempt->y;
        piece.w = attempt->w;
        known = attempt->end;
    } else {
        normal_q27_look(&s->normal, &c->normal, &piece, &s->is_saturated);
    }
    do {
        contact_changes = open_stretch(&work, rest, &piece);
        known = contact_changes ? NULL : known;
        while (fraction_to(&work, ONE) > EVENT_Q27_REST_LEAST) {
            if (s->mode == PLANT_STICK) {
                stick_piece(&work);
            } else {
                slip_piece(&work, known);
            }
            known = NULL;
        }
        normal_q27_move(&s->normal, &piece);
        rest -= work.stretch.fraction;
        if (contact_changes) {
            change_contact(&work);
            normal_q27_look_part(&s->normal, &c->normal, rest, &piece, &s->is_saturated);
        }
    } while (contact_changes && rest > EVENT_Q27_REST_LEAST);
}
