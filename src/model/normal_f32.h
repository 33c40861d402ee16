/* The normal direction in float: y'' = n - Cn y' - y, or without the spring while the pad is lifted.
 *
 * Two methods. RK4 integrates it beside the tangential states with the same stages, as the paper's brief asks; it takes
 * 2 pi h^5/144 of the amplitude a period. EXACT is the closed form: an integer phase for the undamped pad (no drift for
 * ever), a one-step map otherwise. Parts of a step, which only steps with an event need, use a Taylor series. */
#ifndef MODEL_NORMAL_F32_H
#define MODEL_NORMAL_F32_H

#include <stdbool.h>
#include <stdint.h>

#include "base/fmath.h"
#include "model/scale.h"

struct normal_f32_map {
    float yy, yw, wy, ww; /* (y - n, w) changes by this matrix times (y - n, w) */
};

struct normal_f32_coeffs {
    float damping; /* Cn */
    float step;    /* h */
    uint32_t phase_stride;
    bool is_exact;
    bool has_phase; /* exact, undamped and never lifted: y from an integer phase index */
    uint8_t contact;
    struct normal_f32_map full, half; /* over h and h/2 */
};

struct normal_f32 {
    float y, w;           /* displacement and velocity */
    float y_rest, w_rest; /* what rounding took from them so far */
    float n;              /* brake force held over the present step */
    float cosine, sine;   /* y = n + cosine cos(phase) + sine sin(phase), where has_phase */
    uint32_t phase;
    float least_force; /* the contact force is y, but never less than this: 0, or far below all y where it may pull */
    bool is_lifted;    /* spring off: contact lift and y < 0 */
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

/* Closes a whole step: puts the undamped exact solution back on its grid, holds a gap at its limit. Returns true if the
 * gap was held. */
bool normal_f32_close_step(struct normal_f32 *normal, const struct normal_f32_coeffs *coeffs);

/* Contact force of a displacement. A lifted pad has y < 0 and a least force of 0. */
static inline float normal_f32_force(const struct normal_f32 *normal, float y)
{
    return y < normal->least_force ? normal->least_force : y;
}

#endif
