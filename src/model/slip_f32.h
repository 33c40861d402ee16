/* The law of friction, one RK4 piece of slip, and what a piece is judged by: what step_f32.c, event_f32.c and
 * naive_f32.c share, and nobody else.
 *
 * Time is counted in steps, so the factors carry h or the part of it that a piece takes, and an "increment" is h
 * x''. */
#ifndef MODEL_SLIP_F32_H
#define MODEL_SLIP_F32_H

#include "base/compiler.h"
#include "base/fmath.h"
#include "model/step_f32.h"

/* End of one slip piece, and the increment at its start. */
struct slip_f32_end {
    float dx, v; /* change of x, velocity */
    float first;
};

static inline float signed_by(int8_t sign, float value) { return sign < 0 ? -value : value; }

/* h (s mu + eps disc): what friction does to a pad at rest that slips to the side sign, for a unit force. Mirrored
 * states give mirrored bits, here and below. */
BASE_INLINE float slip_f32_drive(const struct slip_f32_factors *f, float disc, int8_t sign)
{
    return signed_by(sign, f->friction) + f->fade * disc;
}

/* The part of the increment that does not come from x: h (s mu + eps (disc - v)) p - h C v, mu not below the floor. */
BASE_INLINE float slip_f32_push(const struct slip_f32_factors *f, float drive, int8_t sign, float v, float p,
                                bool has_floor)
{
    if (has_floor) {
        const float signed_mu = drive - f->fade * v;
        const float mu = signed_by(sign, signed_mu);

        return signed_by(sign, mu < f->floor ? f->floor : mu) * p - f->drag * v;
    }
    return drive * p - (f->drag + f->fade * p) * v;
}

/* The increment at x, v. */
BASE_INLINE float slip_f32_increment(const struct slip_f32_factors *f, float drive, int8_t sign, float x, float v,
                                     float p, bool has_floor)
{
    return slip_f32_push(f, drive, sign, v, p, has_floor) - f->spring * x;
}

/* RK4 over one piece, its sums by Nystrom's formulas: the stages need of x only what the spring makes of it, and x is
 * linear in the velocities before. */
BASE_INLINE void slip_f32_go(const struct slip_f32_factors *f, float disc, int8_t sign, float x, float v1,
                             const struct normal_f32_piece *piece, struct slip_f32_end *end, bool has_floor)
{
    const float drive = slip_f32_drive(f, disc, sign);
    const float pull = f->spring * x;
    const float a1 = slip_f32_push(f, drive, sign, v1, piece->p1, has_floor) - pull;
    const float v2 = v1 + 0.5f * a1;
    const float a2 = slip_f32_push(f, drive, sign, v2, piece->p2, has_floor) - pull - f->half_stretch * v1;
    const float v3 = v1 + 0.5f * a2;
    const float a3 = slip_f32_push(f, drive, sign, v3, piece->p3, has_floor) - pull - f->half_stretch * v2;
    const float v4 = v1 + a3;
    const float a4 = slip_f32_push(f, drive, sign, v4, piece->p4, has_floor) - pull - f->stretch * v3;
    const float inner = a2 + a3;
    const float gain = (1.0f / 6.0f) * (a1 + inner);

    end->dx = f->travel * (v1 + gain);
    end->v = v1 + (gain + (1.0f / 6.0f) * (inner + a4));
    end->first = a1;
}

/* The factors of a part of the step, 0 to 1. */
static inline struct slip_f32_factors slip_f32_take_part(const struct slip_f32_factors *whole, float part)
{
    return (struct slip_f32_factors){
        .travel = part * whole->travel,
        .spring = part * whole->spring,
        .half_stretch = part * part * whole->half_stretch,
        .stretch = part * part * whole->stretch,
        .friction = part * whole->friction,
        .fade = part * whole->fade,
        .drag = part * whole->drag,
        .floor = part * whole->floor,
    };
}

/* A curve that stays above its first tangent stays above 0 when the tangent does: the usual case, decided cheaply. */
BASE_INLINE bool stays_clear(float vr_start, float slope, float vr_end)
{
    return vr_end >= 0.0f && (slope >= 0.0f || vr_start + slope > 0.0f || vr_start <= 0.0f);
}

/* h times the force that would hold the pad on the disc at x. */
BASE_INLINE float stick_need(const struct step_f32_coeffs *c, float x, float disc)
{
    return c->whole.drag * disc + c->whole.spring * x;
}

/* x moves on, and keeps what rounding takes from it. */
static inline void move_x(struct step_f32 *s, float dx) { s->x = fmath_add_kept(s->x, dx, &s->x_rest); }

#endif
