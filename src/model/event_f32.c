/* The pieces of one step in single precision. */
#include "model/event_f32.h"

#include "base/fmath.h"
#include "model/hermite_f32.h"
#include "model/slip_f32.h"

/* At vr = 0 the pad sticks if friction can hold it; otherwise it slips to the side that the need pulls it to. The same
 * test serves entry and exit: static and kinetic friction are equal at vr = 0. */
static int8_t regime_at_rest(const struct step_f32 *s, const struct step_f32_coeffs *c, float extra)
{
    const float need = c->damping * s->disc + c->stiffness * s->x + extra;
    const float limit = c->friction * normal_f32_force(&s->normal, s->normal.y);

    if (need <= limit && -need <= limit) {
        return PLANT_STICK;
    }
    return need > 0.0f ? PLANT_SLIP_PLUS : PLANT_SLIP_MINUS;
}

void event_f32_set_speed(struct step_f32 *s, const struct step_f32_coeffs *c, float speed)
{
    const float change = speed - s->disc;

    s->disc = speed;
    if (s->mode == PLANT_STICK && regime_at_rest(s, c, change / c->normal.step) == PLANT_STICK) {
        s->v = speed;
        return;
    }
    if (s->v != speed) {
        s->mode = s->v < speed ? PLANT_SLIP_PLUS : PLANT_SLIP_MINUS;
    } else {
        s->mode = regime_at_rest(s, c, 0.0f);
    }
}

/* Books a piece that has been gone through. */
static void advance(struct step_f32 *s, struct event_f32_progress *progress, const struct normal_f32_piece *piece,
                    float duration)
{
    if (s->mode == PLANT_STICK) {
        progress->stick += duration;
    } else if (s->mode == PLANT_SLIP_MINUS) {
        progress->slip_minus += duration;
    }
    normal_f32_move(&s->normal, piece);
    progress->rest -= duration;
    progress->is_whole = false;
}

/* Looks for vr = 0 in a slip piece, also for a dip below 0 and back. Returns the place in (0, 1], 0 for "at the start",
 * or a negative number for "not in this piece". */
static float find_crossing(const struct step_f32 *s, const struct step_f32_coeffs *c,
                           const struct normal_f32_piece *piece, float duration, float a1, const struct slip_end *end)
{
    const float f0 = signed_by(s->mode, s->disc - s->v);
    const float f1 = signed_by(s->mode, s->disc - end->v);
    const float d0 = -signed_by(s->mode, a1) * duration;
    struct hermite_f32 vr;
    float upper = 1.0f;
    float p_end;
    float d1;

    if (stays_clear(f0, d0, f1)) {
        return -1.0f;
    }
    p_end = normal_f32_force(&s->normal, piece->y);
    d1 = -signed_by(s->mode, acceleration(c, s->disc, s->mode, s->x + end->dx, end->v, p_end)) * duration;
    vr = hermite_f32_make(f0, d0, f1, d1);
    if (f1 >= 0.0f) {
        if (d1 <= 0.0f) {
            return -1.0f;
        }
        upper = hermite_f32_minimum(&vr);
        if (hermite_f32_value(&vr, upper) >= 0.0f) {
            return -1.0f;
        }
    }
    if (f0 <= 0.0f) {
        return d0 <= 0.0f ? 0.0f : hermite_f32_root_after_start(&vr);
    }
    return hermite_f32_root(&vr, upper);
}

static void slip_piece(struct step_f32 *s, const struct step_f32_coeffs *c, struct event_f32_progress *progress,
                       struct normal_f32_piece *piece, float duration)
{
    const float a1 = acceleration(c, s->disc, s->mode, s->x, s->v, piece->p1);
    struct slip_end end;
    float place;

    slip(s, c, piece, duration, a1, &end);
    place = find_crossing(s, c, piece, duration, a1, &end);
    if (place >= 0.0f && progress->events == PLANT_EVENTS_MAX) {
        progress->is_capped = true;
        place = -1.0f;
    }
    if (BASE_LIKELY(!(place >= 0.0f))) { /* NaN goes on too, to be caught by the domain check */
        advance(s, progress, piece, duration);
        move_x(s, end.dx);
        s->v = end.v;
        return;
    }
    progress->events++;
    if (place > 0.0f) {
        const float part = place * duration;

        normal_f32_look(&s->normal, &c->normal, part, false, piece);
        slip(s, c, piece, part, a1, &end);
        advance(s, progress, piece, part);
        move_x(s, end.dx);
    }
    s->v = s->disc;
    s->mode = regime_at_rest(s, c, 0.0f);
}

/* Slope of the contact force with time: 0 where the force is held at 0. */
static float force_rate(const struct normal_f32 *normal, float y, float w)
{
    return normal_f32_force(normal, y) == y ? w : 0.0f;
}

static void stick_piece(struct step_f32 *s, const struct step_f32_coeffs *c, struct event_f32_progress *progress,
                        struct normal_f32_piece *piece, float duration)
{
    const float dx = s->disc * duration;
    int8_t side;
    const float spare_end = stick_spare(s, c, s->x + dx, normal_f32_force(&s->normal, piece->y), &side);
    float need_start;
    float spare_start;
    float part = 0.0f;

    if (BASE_LIKELY(spare_end >= 0.0f) || progress->events == PLANT_EVENTS_MAX) {
        progress->is_capped = progress->is_capped || spare_end < 0.0f;
        advance(s, progress, piece, duration);
        move_x(s, dx);
        return;
    }
    progress->events++;
    need_start = c->damping * s->disc + c->stiffness * s->x;
    spare_start = c->friction * piece->p1 - signed_by(side, need_start);
    if (spare_start > 0.0f) {
        const float pull = signed_by(side, c->stiffness * s->disc);
        const float rate_start = c->friction * force_rate(&s->normal, s->normal.y, s->normal.w) - pull;
        const float rate_end = c->friction * force_rate(&s->normal, piece->y, piece->w) - pull;
        const struct hermite_f32 spare =
            hermite_f32_make(spare_start, rate_start * duration, spare_end, rate_end * duration);

        part = hermite_f32_root(&spare, 1.0f) * duration;
    }
    if (part > 0.0f) {
        normal_f32_look(&s->normal, &c->normal, part, false, piece);
        move_x(s, s->disc * part);
        advance(s, progress, piece, part);
    }
    s->mode = side;
}

/* Where the spring lets go or takes hold (contact lift) the piece ends there. Returns the piece's duration. */
static float cut_at_contact(const struct step_f32 *s, const struct step_f32_coeffs *c,
                            struct event_f32_progress *progress, struct normal_f32_piece *piece, bool *changes)
{
    const struct normal_f32 *normal = &s->normal;
    const float sign = normal->is_lifted ? -1.0f : 1.0f;
    const float duration = progress->rest;
    float part;

    *changes = false;
    if (c->normal.contact != CONTACT_LIFT || normal->is_steady_from_rest || sign * piece->y >= 0.0f ||
        progress->contacts == PLANT_CONTACTS_MAX) {
        return duration;
    }
    {
        struct hermite_f32 gap = hermite_f32_make(sign * normal->y, sign * normal->w * duration, sign * piece->y,
                                                  sign * piece->w * duration);

        part = gap.value0 > 0.0f   ? hermite_f32_root(&gap, 1.0f) * duration
               : gap.slope0 > 0.0f ? hermite_f32_root_after_start(&gap) * duration
                                   : 0.0f;
    }
    *changes = true;
    if (part > 0.0f) {
        normal_f32_look(normal, &c->normal, part, false, piece);
    }
    return part;
}

static void change_contact(struct step_f32 *s, const struct step_f32_coeffs *c, struct event_f32_progress *progress)
{
    progress->contacts++;
    s->normal.y = 0.0f;
    s->normal.y_rest = 0.0f;
    s->normal.is_lifted = s->normal.w < 0.0f;
    if (s->normal.is_lifted && s->mode == PLANT_STICK) {
        s->mode = regime_at_rest(s, c, 0.0f);
    }
}

void event_f32_step(struct step_f32 *s, const struct step_f32_coeffs *c, struct event_f32_progress *progress)
{
    const float least = 1e-6f * c->normal.step;

    while (progress->rest > least) {
        struct normal_f32_piece piece;
        float duration;
        bool contact_changes;
        const unsigned events = progress->events;

        normal_f32_look(&s->normal, &c->normal, progress->rest, progress->is_whole, &piece);
        duration = cut_at_contact(s, c, progress, &piece, &contact_changes);
        if (duration > 0.0f) {
            if (s->mode == PLANT_STICK) {
                stick_piece(s, c, progress, &piece, duration);
            } else {
                slip_piece(s, c, progress, &piece, duration);
            }
        }
        if (contact_changes && progress->events == events) {
            change_contact(s, c, progress);
        }
        progress->is_lifted = progress->is_lifted || s->normal.y < 0.0f;
    }
}
