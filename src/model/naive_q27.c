/* RK4 on the raw sign in integers. */
#include "model/naive_q27.h"

/* The sign of vr afresh at every stage, 0 at vr = 0, and no stick. */
static BASE_NOINLINE int32_t increment(struct step_q27 *s, const struct step_q27_coeffs *c, int32_t x, int32_t v,
                                       int32_t p)
{
    const int8_t side = (int8_t)((s->disc > v) - (s->disc < v));
    const struct slip_q27_factors *f = &c->wide;
    bool *const tell = &s->is_saturated;
    const struct slip_q27_view view = {0, 0, side * s->disc, slip_q27_drive(f, side * s->disc, tell)};

    if (side == 0) {
        return fixed_saturate_and_tell(-fixed_shift_right(event_q27_need(c, x, v), SLIP_Q27_WIDE), tell);
    }
    return side * slip_q27_increment(f, &view, side * x, side * v, p, c->has_floor, SLIP_Q27_WIDE, tell);
}

void naive_q27_step(struct step_q27 *s, const struct step_q27_coeffs *c, struct plant_notes *notes)
{
    const int32_t travel = c->wide.travel;
    bool *const tell = &s->is_saturated;
    struct normal_q27_piece piece;
    int32_t a1, a2, a3, a4, v2, v3, v4;

    normal_q27_look(&s->normal, &c->normal, &piece, tell);
    a1 = increment(s, c, s->x, s->v, piece.p1);
    v2 = fixed_saturate_and_tell(s->v + fixed_shift_right(a1, 1u), tell);
    a2 = increment(s, c, fixed_saturate_and_tell((int64_t)s->x + fixed_product(travel / 2, s->v, 32u), tell), v2,
                   piece.p2);
    v3 = fixed_saturate_and_tell(s->v + fixed_shift_right(a2, 1u), tell);
    a3 = increment(s, c, fixed_saturate_and_tell((int64_t)s->x + fixed_product(travel / 2, v2, 32u), tell), v3,
                   piece.p3);
    v4 = fixed_saturate_and_tell((int64_t)s->v + a3, tell);
    a4 = increment(s, c, fixed_saturate_and_tell((int64_t)s->x + fixed_product(travel, v3, 32u), tell), v4, piece.p4);
    {
        const int64_t mean = fixed_shift_right(SUM_Q27_SIXTH * ((int64_t)a1 + a2 + a3), 32u) + s->v;
        const int64_t gain = SUM_Q27_SIXTH * ((int64_t)a1 + 2 * ((int64_t)a2 + a3) + a4);

        s->x = fixed_saturate_and_tell(
            s->x + fixed_shift_right((int64_t)travel * fixed_saturate_and_tell(mean, tell), 32u), tell);
        s->v = fixed_saturate_and_tell(s->v + fixed_shift_right(gain, 32u), tell);
    }
    s->mode = (int8_t)((s->disc > s->v) - (s->disc < s->v));
    notes->slip_minus = s->mode == PLANT_SLIP_MINUS ? PLANT_SHARE_ONE : 0u;
    notes->stick = s->mode == PLANT_STICK ? PLANT_SHARE_ONE : 0u;
    normal_q27_move(&s->normal, &piece);
    notes->is_lifted = s->normal.y < 0;
    if (c->normal.contact == CONTACT_LIFT && !s->normal.is_steady_from_rest) {
        s->normal.is_lifted = s->normal.y < 0;
    }
}
