/* What a textbook would do. */
#include "model/naive_f32.h"

#include "base/fmath.h"
#include "model/slip_f32.h"

/* h x'' with the sign of vr afresh at every stage, 0 at vr = 0, and no stick. */
static float increment(const struct step_f32_coeffs *c, float disc, float x, float v, float p)
{
    const struct slip_f32_factors *f = &c->whole;
    const int8_t sign = (int8_t)((disc > v) - (disc < v));

    return 2.0f * (sign == 0 ? -stick_need(c, x, v)
                             : slip_f32_half_increment(f, slip_f32_drive(f, disc, sign), sign, x, v, p, c->has_floor));
}

void naive_f32_step(struct step_f32 *s, const struct step_f32_coeffs *c)
{
    const float h = c->whole.travel;
    struct normal_f32_piece piece;
    float a1, a2, a3, a4, v2, v3, v4;

    normal_f32_look(&s->normal, &c->normal, h, true, &piece);
    a1 = increment(c, s->disc, s->x, s->v, piece.p1);
    v2 = s->v + 0.5f * a1;
    a2 = increment(c, s->disc, s->x + 0.5f * h * s->v, v2, piece.p2);
    v3 = s->v + 0.5f * a2;
    a3 = increment(c, s->disc, s->x + 0.5f * h * v2, v3, piece.p3);
    v4 = s->v + a3;
    a4 = increment(c, s->disc, s->x + h * v3, v4, piece.p4);
    s->x = fmath_add_kept(s->x, h * (1.0f / 6.0f) * (s->v + 2.0f * (v2 + v3) + v4), &s->x_rest);
    s->v += (1.0f / 6.0f) * (a1 + 2.0f * (a2 + a3) + a4);
    s->mode = (int8_t)((s->disc > s->v) - (s->disc < s->v));
    normal_f32_move(&s->normal, &piece);
    if (c->normal.contact == CONTACT_LIFT && !s->normal.is_steady_from_rest) {
        s->normal.is_lifted = s->normal.y < 0.0f;
    }
}
