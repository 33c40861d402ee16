/* The normal direction in float: y'' = n - Cn y' - y, or without the spring while the pad is lifted.
 *
 * Two methods. RK4 integrates it beside the tangential states with the same stages, as the paper's brief asks; it takes
 * 2 pi h^5/144 of the amplitude a period. EXACT is the closed form: an integer phase for the undamped pad (no drift for
 * ever), a one-step map otherwise. Parts of a step, which only steps with an event need, use a Taylor series. */
#ifndef MODEL_NORMAL_F32_H
#define MODEL_NORMAL_F32_H

#include <stdbool.h>
#include <stdint.h>

#include "base/compiler.h"
#include "base/fmath.h"
#include "model/scale.h"
#include "model/sine.h"

/* Half a step is that of a velocity's half increments, whose sum is multiplied by 1/3: as numbers both h and 1/3 are
 * 3e-8 too large, and this undoes it, or every frequency is off by as much. */
#define NORMAL_F32_HALF 0.49999997f

struct normal_f32_map {
    float yy, yw, wy, ww; /* (y - n, w) changes by this matrix times (y - n, w) */
};

struct normal_f32_coeffs {
    float damping;         /* Cn */
    float step, half_step; /* h, and h/2 for what acts on a velocity */
    uint32_t phase_stride;
    bool is_exact;
    bool has_phase; /* exact, undamped and never lifted: y from an integer phase index */
    uint8_t contact;
    struct normal_f32_map full, half; /* over h and h/2, in closed form */
    float between;                    /* has_phase: 1/(2 cos(h/2)), the middle of a step from both its ends */
};

struct normal_f32 {
    float y, w;           /* displacement and velocity */
    float y_rest, w_rest; /* what rounding took from them so far */
    float n;              /* brake force held over the present step */
    float cosine, sine;   /* y = n + cosine cos(phase) + sine sin(phase), where has_phase */
    uint32_t phase;       /* within a quarter turn; each full quarter turns the amplitudes instead */
    float least_force; /* the contact force is y, but never less than this: 0, or far below all y where it may pull */
    bool
        is_calm; /* on the grid and pressed on the disc, whatever the phase: 0 <= y <= 2 n, |w| <= n, to the last bit */
    bool is_lifted;           /* spring off: contact lift and y < 0 */
    bool is_steady_from_rest; /* from rest under a force that never changed: y >= 0 but for rounding */
};

/* The normal force at the four stages of RK4 over one piece of a step, and the state at its end. */
struct normal_f32_piece {
    float p1, p2, p3, p4;
    float dy, dw; /* changes over the piece */
    float y, w;
};

void normal_f32_configure(struct normal_f32_coeffs *coeffs, const struct params *params, const struct scale *scale);

/* Starts at y, w under the force n. */
void normal_f32_reset(struct normal_f32 *normal, const struct normal_f32_coeffs *coeffs, float y, float w, float n);

/* Is the motion calm? Asked when it changes, and where a state has been put back. */
void normal_f32_find_calm(struct normal_f32 *normal);

/* A new brake force takes hold from here on. */
void normal_f32_set_load(struct normal_f32 *normal, const struct normal_f32_coeffs *coeffs, float n);

/* Looks ahead over duration (0 < duration <= h) without changing the state; is_whole says that it is a whole step, for
 * which the prepared maps serve. */
void normal_f32_look(const struct normal_f32 *normal, const struct normal_f32_coeffs *coeffs, float duration,
                     bool is_whole, struct normal_f32_piece *piece);

/* Moves to the end of a piece. */
static inline void normal_f32_move(struct normal_f32 *normal, const struct normal_f32_piece *piece)
{
    normal->y = fmath_add_kept(normal->y, piece->dy, &normal->y_rest);
    normal->w = fmath_add_kept(normal->w, piece->dw, &normal->w_rest);
}

/* The way of y between two instants, as the cubic through displacement and velocity at both; t from 0 to 1. Friction
 * does not act on y, so a step with switches of friction integrates y once and reads it off here. */
struct normal_f32_arc {
    float y, slope, square, cube; /* y + t (slope + t (square + t cube)) */
};

/* From the present state to the end of a piece that takes so long. */
static inline struct normal_f32_arc normal_f32_arc_make(const struct normal_f32 *normal, float duration,
                                                        const struct normal_f32_piece *piece)
{
    const float slope0 = duration * normal->w;
    const float slope1 = duration * piece->w;

    return (struct normal_f32_arc){normal->y, slope0, 3.0f * piece->dy - 2.0f * slope0 - slope1,
                                   slope0 + slope1 - 2.0f * piece->dy};
}

static inline float normal_f32_arc_y(const struct normal_f32_arc *arc, float t)
{
    return arc->y + t * (arc->slope + t * (arc->square + t * arc->cube));
}

/* A step begins: the phase goes on to its end. Each full quarter turns the amplitudes instead. Returns the phase. */
BASE_INLINE uint32_t normal_f32_open_step(struct normal_f32 *normal, const struct normal_f32_coeffs *coeffs)
{
    uint32_t phase = normal->phase + coeffs->phase_stride;

    if (BASE_UNLIKELY(phase >= SINE_GRID / 4u)) {
        const float cosine = normal->cosine;

        phase -= SINE_GRID / 4u;
        normal->cosine = normal->sine;
        normal->sine = -cosine;
    }
    normal->phase = phase;
    return phase;
}

/* Displacement less n, and velocity, on the grid. */
BASE_INLINE void normal_f32_at(const struct normal_f32 *normal, uint32_t phase, float *d, float *w)
{
    const float sine = sine_quarter_f32[phase];
    const float cosine = sine_quarter_f32[SINE_GRID / 4u - phase];

    *d = normal->cosine * cosine + normal->sine * sine;
    *w = normal->sine * cosine - normal->cosine * sine;
}

/* A whole step on the grid, up to phase: its end and the displacements of its stages, in the places of the forces. */
BASE_INLINE void normal_f32_look_phase(const struct normal_f32 *normal, const struct normal_f32_coeffs *coeffs,
                                       uint32_t phase, struct normal_f32_piece *piece)
{
    float d;

    normal_f32_at(normal, phase, &d, &piece->w);
    piece->y = normal->n + d;
    piece->dy = piece->y - normal->y;
    piece->dw = piece->w - normal->w;
    piece->p1 = normal->y;
    piece->p2 = normal->n + coeffs->between * ((normal->y - normal->n) + d);
    piece->p3 = piece->p2;
    piece->p4 = piece->y;
}

/* Closes a whole step: puts the undamped exact solution back on its grid, holds a gap at its limit. Returns true if the
 * gap was held. */
bool normal_f32_close_step(struct normal_f32 *normal, const struct normal_f32_coeffs *coeffs);

/* Contact force of a displacement. A lifted pad has y < 0 and a least force of 0. */
static inline float normal_f32_force(const struct normal_f32 *normal, float y)
{
    return y < normal->least_force ? normal->least_force : y;
}

/* A whole step in contact by the prepared maps: its end and the displacements of its stages, in the places of the
 * forces. The middle two are one. */
BASE_INLINE void normal_f32_look_map(const struct normal_f32 *normal, const struct normal_f32_coeffs *coeffs,
                                     struct normal_f32_piece *piece)
{
    const float d = normal->y - normal->n;

    piece->dy = coeffs->full.yy * d + coeffs->full.yw * normal->w;
    piece->dw = coeffs->full.wy * d + coeffs->full.ww * normal->w;
    piece->y = normal->y + piece->dy;
    piece->w = normal->w + piece->dw;
    piece->p1 = normal->y;
    piece->p2 = normal->y + (coeffs->half.yy * d + coeffs->half.yw * normal->w);
    piece->p3 = piece->p2;
    piece->p4 = piece->y;
}

/* The same by RK4 over a duration and its half; spring is 0 for a pad that is lifted, else 1. b is half w'. */
BASE_INLINE void normal_f32_look_rk4(const struct normal_f32 *normal, const struct normal_f32_coeffs *coeffs,
                                     float duration, float half, float spring, struct normal_f32_piece *piece)
{
    const float drag = half * coeffs->damping;
    const float y1 = normal->y;
    const float w1 = normal->w;
    const float b1 = half * (normal->n - spring * y1) - drag * w1;
    const float y2 = y1 + half * w1;
    const float w2 = w1 + b1;
    const float b2 = half * (normal->n - spring * y2) - drag * w2;
    const float y3 = y1 + half * w2;
    const float w3 = w1 + b2;
    const float b3 = half * (normal->n - spring * y3) - drag * w3;
    const float y4 = y1 + half * (w3 + w3);
    const float w4 = w1 + (b3 + b3);
    const float b4 = half * (normal->n - spring * y4) - drag * w4;
    const float inner = b2 + b3;
    const float gain = (1.0f / 3.0f) * (b1 + inner);

    piece->dy = duration * (w1 + gain);
    piece->dw = gain + (1.0f / 3.0f) * (inner + b4);
    piece->y = y1 + piece->dy;
    piece->w = w1 + piece->dw;
    piece->p1 = y1;
    piece->p2 = y2;
    piece->p3 = y3;
    piece->p4 = y4;
}

/* Is the pad pressed on the disc, at all stages and at the end? Asked of the signs. */
BASE_INLINE bool normal_f32_is_pressed(const struct normal_f32_piece *piece)
{
    const uint32_t signs = fmath_bits(piece->p1) | fmath_bits(piece->p2) | fmath_bits(piece->p3) |
                           fmath_bits(piece->p4) | fmath_bits(piece->y);

    return (int32_t)signs >= 0;
}

/* From displacements to forces; they differ where y < 0 alone. */
static inline void normal_f32_press(const struct normal_f32 *normal, struct normal_f32_piece *piece)
{
    piece->p1 = normal_f32_force(normal, piece->p1);
    piece->p2 = normal_f32_force(normal, piece->p2);
    piece->p3 = normal_f32_force(normal, piece->p3);
    piece->p4 = normal_f32_force(normal, piece->p4);
}

#endif
