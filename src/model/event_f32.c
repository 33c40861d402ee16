/* The pieces of one step in single precision. */
#include "model/event_f32.h"

#include "base/fmath.h"
#include "model/hermite_f32.h"

#define REST_LEAST 1e-6f /* of a step: nothing happens in what is left then */
#define NOT_HERE (-1.0f)

/* A stretch of the step without a change of contact, on which y is known. Places on it run from 0 to 1. */
struct stretch {
    struct normal_f32_arc arc;
    float fraction; /* of the step */
    float at, y;    /* where the pad is */
    float y_end;
};

/* One step at work. */
struct work {
    struct step_f32 *s;
    const struct step_f32_coeffs *c;
    struct event_f32_progress *progress;
    struct stretch stretch;
};

static float force_of(const struct work *work, float y) { return normal_f32_force(&work->s->normal, y); }

/* The way from here to a place on the stretch, as a fraction of the step. */
static float fraction_to(const struct work *work, float place)
{
    return work->stretch.fraction * (place - work->stretch.at);
}

/* Books the way to a place, where y is as given, and goes there. */
static void move_to(struct work *work, float place, float y)
{
    const float fraction = fraction_to(work, place);

    if (work->s->mode == PLANT_STICK) {
        work->progress->stick += fraction;
    } else if (work->s->mode == PLANT_SLIP_MINUS) {
        work->progress->slip_minus += fraction;
    }
    work->stretch.at = place;
    work->stretch.y = y;
    work->progress->is_lifted = work->progress->is_lifted || y < 0.0f;
}

/* At vr = 0 under the contact force p the pad sticks if friction can hold it; otherwise it slips to the side that the
 * need pulls it to. The same test serves entry and exit: static and kinetic friction are equal at vr = 0. */
static int8_t regime_at_rest(const struct step_f32 *s, const struct step_f32_coeffs *c, float p, float extra)
{
    const float need = stick_need(c, s->x, s->disc) + 0.5f * extra;
    const float limit = c->whole.friction * p;

    if (need <= limit && -need <= limit) {
        return PLANT_STICK;
    }
    return need > 0.0f ? PLANT_SLIP_PLUS : PLANT_SLIP_MINUS;
}

void event_f32_set_speed(struct step_f32 *s, const struct step_f32_coeffs *c, float speed)
{
    const float change = speed - s->disc;
    const float p = normal_f32_force(&s->normal, s->normal.y);

    s->disc = speed;
    if (s->mode == PLANT_STICK && regime_at_rest(s, c, p, change) == PLANT_STICK) {
        s->v = speed;
        return;
    }
    if (s->v != speed) {
        s->mode = s->v < speed ? PLANT_SLIP_PLUS : PLANT_SLIP_MINUS;
    } else {
        s->mode = regime_at_rest(s, c, p, 0.0f);
    }
}

/* --- Slip --------------------------------------------------------------------------------------------------------- */

/* The factors of the way from here to a place; the whole step has them ready. */
static const struct slip_f32_factors *take_part(const struct work *work, float place, struct slip_f32_factors *part)
{
    const float fraction = fraction_to(work, place);

    if (fraction == 1.0f) {
        return &work->c->whole;
    }
    *part = slip_f32_take_part(&work->c->whole, fraction);
    return part;
}

/* From here to the end of the stretch. */
static void slip(const struct work *work, const struct slip_f32_factors *f, struct slip_f32_end *end)
{
    const struct step_f32 *s = work->s;
    const struct stretch *stretch = &work->stretch;
    const float middle = force_of(work, normal_f32_arc_y(&stretch->arc, 0.5f * (stretch->at + 1.0f)));
    const struct normal_f32_piece piece = {
        .p1 = force_of(work, stretch->y), .p2 = middle, .p3 = middle, .p4 = force_of(work, stretch->y_end)};

    slip_f32_go(f, slip_f32_drive(f, s->disc, s->mode), s->mode, s->x, s->v, &piece, end, work->c->has_floor);
}

/* Looks for vr = 0 in a slip piece that reaches to the end of the stretch, also for a dip below 0 and back. Returns its
 * place on the piece in (0, 1], 0 for "at the start", or NOT_HERE; *vr is then
 * as seen from the side of the slip. */
static float find_crossing(const struct work *work, const struct slip_f32_factors *f, const struct slip_f32_end *end,
                           struct hermite_f32 *vr)
{
    const struct step_f32 *s = work->s;
    const float f0 = signed_by(s->mode, s->disc - s->v);
    const float f1 = signed_by(s->mode, s->disc - end->v);
    const float d0 = -2.0f * signed_by(s->mode, end->first);
    float upper = 1.0f;
    float last;

    if (stays_clear(f0, d0, f1)) {
        return NOT_HERE;
    }
    last = slip_f32_half_increment(f, slip_f32_drive(f, s->disc, s->mode), s->mode, s->x + end->dx, end->v,
                                   force_of(work, work->stretch.y_end), work->c->has_floor);
    *vr = hermite_f32_make(f0, d0, f1, -2.0f * signed_by(s->mode, last));
    if (f1 >= 0.0f) {
        if (signed_by(s->mode, last) >= 0.0f) {
            return NOT_HERE;
        }
        upper = hermite_f32_minimum(vr);
        if (hermite_f32_value(vr, upper) >= 0.0f) {
            return NOT_HERE;
        }
    }
    if (f0 <= 0.0f) {
        return d0 <= 0.0f ? 0.0f : hermite_f32_root_after_start(vr);
    }
    return hermite_f32_root(vr, upper);
}

/* Slips on to the end of the stretch or to vr = 0. known is the end of a piece that is a whole step, NULL if it has not
 * been computed. */
static void slip_piece(struct work *work, const struct slip_f32_end *known)
{
    struct step_f32 *s = work->s;
    struct slip_f32_factors part;
    const struct slip_f32_factors *factors = take_part(work, 1.0f, &part);
    struct slip_f32_end end;
    struct hermite_f32 vr;
    float place;

    if (known != NULL) {
        end = *known;
    } else {
        slip(work, factors, &end);
    }
    place = find_crossing(work, factors, &end, &vr);
    if (place >= 0.0f && work->progress->events == PLANT_EVENTS_MAX) {
        work->progress->is_capped = true;
        place = NOT_HERE;
    }
    if (!(place >= 0.0f)) { /* NaN goes on too, to be caught by the domain check */
        move_to(work, 1.0f, work->stretch.y_end);
        move_x(s, end.dx);
        s->v = end.v;
        return;
    }
    work->progress->events++;
    if (place > 0.0f) {
        const float meeting = work->stretch.at + place * (1.0f - work->stretch.at);

        move_x(s, slip_f32_dx_at_crossing(factors, &vr, s->mode, s->v, s->disc, place));
        move_to(work, meeting, normal_f32_arc_y(&work->stretch.arc, meeting));
    }
    s->v = s->disc;
    s->mode = regime_at_rest(s, work->c, force_of(work, work->stretch.y), 0.0f);
}

/* --- Stick -------------------------------------------------------------------------------------------------------- */

static float carried(const struct work *work, float place)
{
    return fraction_to(work, place) * (work->c->whole.travel * work->s->disc);
}

/* Change of h mu P along the rest of the stretch, as it goes at a place of it: 0 where the force is held at 0. */
static float limit_change(const struct work *work, float place, float y)
{
    const struct normal_f32_arc *arc = &work->stretch.arc;
    const float slope = arc->slope + place * (2.0f * arc->square + 3.0f * place * arc->cube);

    return force_of(work, y) == y ? work->c->whole.friction * slope * (1.0f - work->stretch.at) : 0.0f;
}

/* Is carried on to the end of the stretch or to where the springs win. */
static void stick_piece(struct work *work)
{
    struct step_f32 *s = work->s;
    const struct slip_f32_factors *whole = &work->c->whole;
    const float dx = carried(work, 1.0f);
    const float need_end = stick_need(work->c, s->x + dx, s->disc);
    const int8_t side = need_end > 0.0f ? PLANT_SLIP_PLUS : PLANT_SLIP_MINUS;
    const float spare_end = whole->friction * force_of(work, work->stretch.y_end) - signed_by(side, need_end);
    float place = work->stretch.at;
    float spare;

    if (spare_end >= 0.0f || work->progress->events == PLANT_EVENTS_MAX) {
        work->progress->is_capped = work->progress->is_capped || spare_end < 0.0f;
        move_to(work, 1.0f, work->stretch.y_end);
        move_x(s, dx);
        return;
    }
    work->progress->events++;
    spare = whole->friction * force_of(work, work->stretch.y) - signed_by(side, stick_need(work->c, s->x, s->disc));
    if (spare > 0.0f) {
        const float pull = signed_by(side, whole->spring * dx);
        const struct hermite_f32 cubic =
            hermite_f32_make(spare, limit_change(work, place, work->stretch.y) - pull, spare_end,
                             limit_change(work, 1.0f, work->stretch.y_end) - pull);

        place += hermite_f32_root(&cubic, 1.0f) * (1.0f - place);
    }
    if (place > work->stretch.at) {
        move_x(s, carried(work, place));
        move_to(work, place, normal_f32_arc_y(&work->stretch.arc, place));
    }
    s->mode = side;
}

/* --- Contact ------------------------------------------------------------------------------------------------------ */

/* Where on a stretch that starts here the spring lets go or takes hold (contact lift), or NOT_HERE. */
static float find_contact_change(const struct work *work, const struct normal_f32_piece *piece)
{
    const struct normal_f32 *normal = &work->s->normal;
    const float sign = normal->is_lifted ? -1.0f : 1.0f;
    const float duration = work->stretch.fraction * work->c->normal.step;
    struct hermite_f32 gap;

    if (work->c->normal.contact != CONTACT_LIFT || normal->is_steady_from_rest || sign * piece->y >= 0.0f ||
        work->progress->contacts == PLANT_CONTACTS_MAX) {
        return NOT_HERE;
    }
    gap = hermite_f32_make(sign * normal->y, sign * normal->w * duration, sign * piece->y, sign * piece->w * duration);
    return gap.value0 > 0.0f   ? hermite_f32_root(&gap, 1.0f)
           : gap.slope0 > 0.0f ? hermite_f32_root_after_start(&gap)
                               : 0.0f;
}

/* Opens a stretch over the rest of the step, or up to the next change of contact. Returns true if it ends with one. */
static bool open_stretch(struct work *work, float rest, struct normal_f32_piece *piece)
{
    struct stretch *stretch = &work->stretch;
    const struct normal_f32 *normal = &work->s->normal;
    const struct normal_f32_coeffs *coeffs = &work->c->normal;
    float place;

    stretch->at = 0.0f;
    stretch->y = normal->y;
    stretch->fraction = rest;
    place = find_contact_change(work, piece);
    if (place > 0.0f) {
        stretch->fraction = rest * place;
        normal_f32_look(normal, coeffs, stretch->fraction * coeffs->step, false, piece);
    } else if (place == 0.0f) {
        stretch->fraction = 0.0f;
        *piece = (struct normal_f32_piece){.y = normal->y, .w = normal->w};
    }
    stretch->y_end = piece->y;
    stretch->arc = normal_f32_arc_make(normal, stretch->fraction * coeffs->step, piece);
    return place >= 0.0f;
}

static void change_contact(struct work *work)
{
    struct step_f32 *s = work->s;

    work->progress->contacts++;
    s->normal.y = 0.0f;
    s->normal.y_rest = 0.0f;
    s->normal.is_lifted = s->normal.w < 0.0f;
    if (s->normal.is_lifted && s->mode == PLANT_STICK) {
        s->mode = regime_at_rest(s, work->c, 0.0f, 0.0f);
    }
}

/* --- The step ----------------------------------------------------------------------------------------------------- */

void event_f32_step(struct step_f32 *s, const struct step_f32_coeffs *c, struct event_f32_progress *progress,
                    const struct event_f32_attempt *attempt)
{
    struct work work = {.s = s, .c = c, .progress = progress};
    const struct slip_f32_end *known = NULL;
    struct normal_f32_piece piece;
    float rest = 1.0f;
    bool contact_changes;

    if (attempt != NULL) {
        piece.y = attempt->y;
        piece.w = attempt->w;
        piece.dy = attempt->dy;
        piece.dw = attempt->dw;
        known = attempt->end;
    } else {
        normal_f32_look(&s->normal, &c->normal, c->normal.step, true, &piece);
    }
    do {
        contact_changes = open_stretch(&work, rest, &piece);
        known = contact_changes ? NULL : known;
        while (fraction_to(&work, 1.0f) > REST_LEAST) {
            if (s->mode == PLANT_STICK) {
                stick_piece(&work);
            } else {
                slip_piece(&work, known);
            }
            known = NULL;
        }
        normal_f32_move(&s->normal, &piece);
        rest -= work.stretch.fraction;
        if (contact_changes) {
            change_contact(&work);
            normal_f32_look(&s->normal, &c->normal, rest * c->normal.step, false, &piece);
        }
    } while (contact_changes && rest > REST_LEAST);
}
