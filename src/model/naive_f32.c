/* What a textbook would do. */
#include "model/naive_f32.h"

#include "base/fmath.h"
#include "model/slip_f32.h"

/* The sign of vr afresh at every stage, 0 at vr = 0, and no stick. */
static float naive_acceleration(const struct step_f32_coeffs *c, float disc, float x, float v, float p)
{
    const int8_t sign = (int8_t)((disc > v) - (disc < v));

    return sign == 0 ? -c->damping * v - c->stiffness * x : acceleration(c, disc, sign, x, v, p);
}

void naive_f32_step(struct step_f32 *s, const struct step_f32_coeffs *c)
{
    const float h = c->normal.step;
    struct normal_f32_piece piece;
    float a1, a2, a3, a4, v2, v3, v4;

    normal_f32_look(&s->normal, &c->normal, h, true, &piece);
    a1 = naive_acceleration(c, s->disc, s->x, s->v, piece.p1);
    v2 = s->v + 0.5f * h * a1;
    a2 = naive_acceleration(c, s->disc, s->x + 0.5f * h * s->v, v2, piece.p2);
    v3 = s->v + 0.5f * h * a2;
    a3 = naive_acceleration(c, s->disc, s->x + 0.5f * h * v2, v3, piece.p3);
    v4 = s->v + h * a3;
    a4 = naive_acceleration(c, s->disc, s->x + h * v3, v4, piece.p4);
    s->x = fmath_add_kept(s->x, h * (1.0f / 6.0f) * (s->v + 2.0f * (v2 + v3) + v4), &s->x_rest);
    s->v += h * (1.0f / 6.0f) * (a1 + 2.0f * (a2 + a3) + a4);
    s->mode = (int8_t)((s->disc > s->v) - (s->disc < s->v));
    normal_f32_move(&s->normal, &piece);
    if (c->normal.contact == CONTACT_LIFT && !s->normal.is_steady_from_rest) {
        s->normal.is_lifted = s->normal.y < 0.0f;
    }
}
