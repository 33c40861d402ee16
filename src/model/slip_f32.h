/* The law of friction, one RK4 piece of slip, and what a piece is judged by: what step_f32.c, event_f32.c and naive_f32.c
 * share, and nobody else. */
#ifndef MODEL_SLIP_F32_H
#define MODEL_SLIP_F32_H

#include "base/compiler.h"
#include "base/fmath.h"
#include "model/step_f32.h"

/* End of one slip piece. */
struct slip_end {
    float dx, v; /* change of x, velocity */
};

static inline float signed_by(int8_t sign, float value) { return sign < 0 ? -value : value; }

/* Signed friction coefficient at speed v while slipping to the side sign: s mu(|vr|) = s mu + eps vr, not below the floor.
 * Mirrored states give mirrored bits. */
BASE_INLINE float signed_friction(const struct step_f32_coeffs *c, float disc, int8_t sign, float v, bool has_floor)
{
    const float signed_mu = signed_by(sign, c->friction) + c->slope * (disc - v);

    return has_floor && signed_by(sign, signed_mu) < c->floor ? signed_by(sign, c->floor) : signed_mu;
}

BASE_INLINE float acceleration_at(const struct step_f32_coeffs *c, float disc, int8_t sign, float x, float v, float p,
                                  bool has_floor)
{
    return signed_friction(c, disc, sign, v, has_floor) * p - c->damping * v - c->stiffness * x;
}

/* x'' in slip with the sign of vr given. */
static inline float acceleration(const struct step_f32_coeffs *c, float disc, int8_t sign, float x, float v, float p)
{
    return acceleration_at(c, disc, sign, x, v, p, c->has_floor);
}

/* RK4 over one piece, from the acceleration at its start. */
BASE_INLINE void slip_as(const struct step_f32 *s, const struct step_f32_coeffs *c,
                         const struct normal_f32_piece *piece, float duration, float a1, struct slip_end *end,
                         bool has_floor)
{
    const float half = 0.5f * duration;
    const float sixth = duration * (1.0f / 6.0f);
    const float disc = s->disc;
    const int8_t sign = s->mode;
    const float x1 = s->x;
    const float v1 = s->v;
    const float x2 = x1 + half * v1;
    const float v2 = v1 + half * a1;
    const float a2 = acceleration_at(c, disc, sign, x2, v2, piece->p2, has_floor);
    const float x3 = x1 + half * v2;
    const float v3 = v1 + half * a2;
    const float a3 = acceleration_at(c, disc, sign, x3, v3, piece->p3, has_floor);
    const float x4 = x1 + duration * v3;
    const float v4 = v1 + duration * a3;
    const float a4 = acceleration_at(c, disc, sign, x4, v4, piece->p4, has_floor);

    end->dx = sixth * (v1 + 2.0f * (v2 + v3) + v4);
    end->v = v1 + sixth * (a1 + 2.0f * (a2 + a3) + a4);
}

static inline void slip(const struct step_f32 *s, const struct step_f32_coeffs *c, const struct normal_f32_piece *piece,
                        float duration, float a1, struct slip_end *end)
{
    if (c->has_floor) {
        slip_as(s, c, piece, duration, a1, end, true);
    } else {
        slip_as(s, c, piece, duration, a1, end, false);
    }
}

/* A curve that stays above its first tangent stays above 0 when the tangent does: the usual case, decided cheaply. */
BASE_INLINE bool stays_clear(float vr_start, float slope, float vr_end)
{
    return vr_end >= 0.0f && (slope >= 0.0f || vr_start + slope > 0.0f || vr_start <= 0.0f);
}

/* What friction could hold beyond what it must, if the pad stuck at x under the contact force p; *side is where it would
 * slip. */
BASE_INLINE float stick_spare(const struct step_f32 *s, const struct step_f32_coeffs *c, float x, float p, int8_t *side)
{
    const float need = c->damping * s->disc + c->stiffness * x;

    *side = need > 0.0f ? PLANT_SLIP_PLUS : PLANT_SLIP_MINUS;
    return c->friction * p - signed_by(*side, need);
}

/* x moves on, and keeps what rounding takes from it. */
static inline void move_x(struct step_f32 *s, float dx) { s->x = fmath_add_kept(s->x, dx, &s->x_rest); }

#endif
