/* The law of friction, one RK4 piece of slip, and what a piece is judged by: what step_f32.c, event_f32.c and
 * naive_f32.c share, and nobody else.
 *
 * Time is counted in steps, so the factors carry h/2 or the part of it that a piece takes, and a "half increment" is
 * h/2 x'': what RK4 goes by from one stage to the next. */
#ifndef MODEL_SLIP_F32_H
#define MODEL_SLIP_F32_H

#include "base/compiler.h"
#include "base/fmath.h"
#include "model/hermite_f32.h"
#include "model/step_f32.h"

/* End of one slip piece, and the half increment at its start. */
struct slip_f32_end {
    float dx, v; /* change of x, velocity */
    float first;
    float second; /* velocity at the second stage */
};

static inline float signed_by(int8_t sign, float value) { return sign < 0 ? -value : value; }

/* h/2 (s mu + eps disc): what friction does to a pad at rest that slips to the side sign, for a unit force. Mirrored
 * states give mirrored bits, here and below. */
BASE_INLINE float slip_f32_drive(const struct slip_f32_factors *f, float disc, int8_t sign)
{
    return signed_by(sign, f->friction) + f->fade * disc;
}

/* What friction and damping do: the half increment is push - drag v - what the spring does. On the floor of mu both are
 * others. */
struct slip_f32_law {
    float push, drag;
};

BASE_INLINE struct slip_f32_law slip_f32_law(const struct slip_f32_factors *f, float drive, int8_t sign, float v,
                                             float p, bool has_floor)
{
    if (has_floor && signed_by(sign, drive - f->fade * v) < f->floor) {
        return (struct slip_f32_law){signed_by(sign, f->floor) * p, f->drag};
    }
    return (struct slip_f32_law){drive * p, f->drag + f->fade * p};
}

/* The half increment at x, v. */
BASE_INLINE float slip_f32_half_increment(const struct slip_f32_factors *f, float drive, int8_t sign, float x, float v,
                                          float p, bool has_floor)
{
    const struct slip_f32_law law = slip_f32_law(f, drive, sign, v, p, has_floor);

    return law.push - f->spring * x - law.drag * v;
}

/* RK4 over one piece, its sums by Nystrom's formulas: the stages need of x only what the spring makes of it, and x is
 * linear in the velocities before. Where p2 = p3, what the two stages have in common is computed once. */
BASE_INLINE void slip_f32_go(const struct slip_f32_factors *f, float drive, int8_t sign, float x, float v1,
                             const struct normal_f32_piece *piece, struct slip_f32_end *end, bool has_floor)
{
    const float pull = f->spring * x;
    const struct slip_f32_law law1 = slip_f32_law(f, drive, sign, v1, piece->p1, has_floor);
    const float e1 = law1.push - pull - law1.drag * v1;
    const float v2 = v1 + e1;
    const struct slip_f32_law law2 = slip_f32_law(f, drive, sign, v2, piece->p2, has_floor);
    const float e2 = law2.push - pull - f->stretch * v1 - law2.drag * v2;
    const float v3 = v1 + e2;
    const struct slip_f32_law law3 = slip_f32_law(f, drive, sign, v3, piece->p3, has_floor);
    const float e3 = law3.push - pull - f->stretch * v2 - law3.drag * v3;
    const float v4 = v1 + (e3 + e3);
    const struct slip_f32_law law4 = slip_f32_law(f, drive, sign, v4, piece->p4, has_floor);
    const float e4 = law4.push - pull - f->stretch * (v3 + v3) - law4.drag * v4;
    const float inner = e2 + e3;
    const float gain = (1.0f / 3.0f) * (e1 + inner);

    end->dx = f->travel * (v1 + gain);
    end->v = v1 + (gain + (1.0f / 3.0f) * (inner + e4));
    end->first = e1;
    end->second = v2;
}

/* Change of x up to where the pad meets the disc, at a place of the piece. v is the cubic on which that place was
 * found: that of vr, as seen from side. Its mean up to there is that of its ends less a twelfth of what its slope
 * changes by. */
BASE_INLINE float slip_f32_dx_at_crossing(const struct slip_f32_factors *f, const struct hermite_f32 *vr, int8_t side,
                                          float v, float disc, float place)
{
    const float bend = signed_by(side, (1.0f / 6.0f) * vr->square + 0.25f * (place * vr->cube));

    return f->travel * place * (0.5f * (v + disc) + place * place * bend);
}

/* The factors of a part of the step, 0 to 1. */
static inline struct slip_f32_factors slip_f32_take_part(const struct slip_f32_factors *whole, float part)
{
    return (struct slip_f32_factors){
        .travel = part * whole->travel,
        .spring = part * whole->spring,
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

/* h/2 times the force that would hold the pad on the disc at x. */
BASE_INLINE float stick_need(const struct step_f32_coeffs *c, float x, float disc)
{
    return c->whole.drag * disc + c->whole.spring * x;
}

/* x moves on, and keeps what rounding takes from it. */
static inline void move_x(struct step_f32 *s, float dx) { s->x = fmath_add_kept(s->x, dx, &s->x_rest); }

#endif
