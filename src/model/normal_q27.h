/* The normal direction in Q4.27: the two methods of normal_f32.h, with the same meaning of every function.
 *
 * Factors that belong to the step (h, h Cn, the one-step map) are in Q32: nothing of them reaches 1/2, since h Cn <=
 * 0.40. A place inside the step is a fraction of it in Q30. */
#ifndef MODEL_NORMAL_Q27_H
#define MODEL_NORMAL_Q27_H

#include <stdbool.h>
#include <stdint.h>

#include "base/fixed.h"
#include "model/scale.h"
#include "model/sine.h"
#include "model/sum_q27.h"

#define NORMAL_Q27_WHOLE (1 << 30) /* a whole step, as a fraction */

struct normal_q27_map {
    int32_t yy, yw, wy, ww; /* (y - n, w) changes by this matrix times (y - n, w) */
};

/* y at a stage changes by this row times (y - n, w). */
struct normal_q27_row {
    int32_t yy, yw;
};

struct normal_q27_coeffs {
    int32_t sixth;              /* SUM_Q27_SIXTH */
    int32_t step;               /* h */
    int32_t damping;            /* h Cn */
    struct normal_q27_map full; /* over h, of either method: the equation is linear, and so is RK4 of it */
    struct normal_q27_row second, third, fourth; /* at the stages of RK4 */
    uint32_t phase_stride;
    uint8_t terms; /* of the Taylor series */
    uint8_t contact;
    bool is_exact;
    bool has_phase; /* exact, undamped and never lifted: y from an integer phase index */
};

/* y = n + cosine cos(phase) + sine sin(phase), w = sine cos(phase) + minus_cosine sin(phase). The phase is a place
 * within a quarter turn; each full quarter turns the amplitudes instead, which costs no bit. Amplitudes are in Q28: |y
 * - n| < 8. */
struct normal_q27_phase {
    int32_t cosine, sine, minus_cosine;
    uint32_t index;
};

struct normal_q27 {
    int32_t y, w;        /* displacement and velocity */
    int32_t n;           /* brake force held over the present step */
    int32_t least_force; /* the contact force is y, but never less than this */
    int32_t reach; /* |y| and |w| stay within it until the load or the contact changes; INT32_MAX if nothing is known */
    struct normal_q27_phase phase; /* where has_phase: at the end of the present step */
    bool is_lifted;                /* spring off: contact lift and y < 0 */
    bool is_steady_from_rest;      /* from rest under a force that never changed: y >= 0 but for rounding */
};

/* The normal force at the four stages of RK4 over one piece of a step, and the state at its end. */
struct normal_q27_piece {
    int32_t p1, p2, p3, p4;
    int32_t y, w;
};

/* y between two instants as the cubic through displacement and velocity at both; t in Q30 from 0 to 1. Friction does
 * not act on y, so a step with switches of friction needs y no more often than any other: it reads it off here. */
struct normal_q27_arc {
    int32_t y, slope, square, cube; /* y + t (slope + t (square + t cube)) */
};

void normal_q27_configure(struct normal_q27_coeffs *coeffs, const struct params *params, const struct scale *scale);

/* 2 pi/spp in Q(bits), bits <= 39. */
int64_t normal_q27_step(const struct scale *scale, unsigned bits);

/* Starts at y, w under the force n. */
void normal_q27_reset(struct normal_q27 *normal, const struct normal_q27_coeffs *coeffs, int32_t y, int32_t w,
                      int32_t n, bool *is_saturated);

/* A new brake force takes hold from here on. */
void normal_q27_set_load(struct normal_q27 *normal, const struct normal_q27_coeffs *coeffs, int32_t n,
                         bool *is_saturated);

/* The contact has changed: the pad is at y = 0. */
void normal_q27_change_contact(struct normal_q27 *normal);

/* Looks ahead over a whole step without changing the state. */
void normal_q27_look(const struct normal_q27 *normal, const struct normal_q27_coeffs *coeffs,
                     struct normal_q27_piece *piece, bool *is_saturated);

/* Looks ahead over a fraction of the step; of the piece only y and w are set. */
void normal_q27_look_part(const struct normal_q27 *normal, const struct normal_q27_coeffs *coeffs, int32_t fraction,
                          struct normal_q27_piece *piece, bool *is_saturated);

/* The way from the present state to the end of a piece that takes this fraction of the step. */
void normal_q27_arc_make(struct normal_q27_arc *arc, const struct normal_q27 *normal,
                         const struct normal_q27_coeffs *coeffs, int32_t fraction,
                         const struct normal_q27_piece *piece);

/* What has been added on the way to displacement and slope. */
static inline int32_t normal_q27_arc_change(const struct normal_q27_arc *arc, int32_t t)
{
    const int32_t bend = arc->square + fixed_part_near(arc->cube, t);

    return fixed_part_near(arc->slope + fixed_part_near(bend, t), t);
}

static inline int32_t normal_q27_arc_turn(const struct normal_q27_arc *arc, int32_t t)
{
    return fixed_part_near(2 * arc->square + 3 * fixed_part_near(arc->cube, t), t);
}

/* Displacement on the way, and its change by t. */
static inline int32_t normal_q27_arc_y(const struct normal_q27_arc *arc, int32_t t)
{
    return fixed_saturate((int64_t)arc->y + normal_q27_arc_change(arc, t));
}

static inline int32_t normal_q27_arc_slope(const struct normal_q27_arc *arc, int32_t t)
{
    return fixed_saturate((int64_t)arc->slope + normal_q27_arc_turn(arc, t));
}

/* The same over a whole step to y, w within the fine arithmetic, where nothing needs to be held in bounds. */
BASE_INLINE void normal_q27_arc_fit(struct normal_q27_arc *arc, const struct normal_q27 *normal,
                                    const struct normal_q27_coeffs *coeffs, int32_t y, int32_t w)
{
    const int32_t t = fixed_part_near(coeffs->step, NORMAL_Q27_WHOLE);
    const int32_t slope0 = fixed_sum_of(t, normal->w).high;
    const int32_t slope1 = fixed_sum_of(t, w).high;
    const int32_t rise = y - normal->y;

    arc->y = normal->y;
    arc->slope = slope0;
    arc->square = 3 * rise - 2 * slope0 - slope1;
    arc->cube = slope0 + slope1 - 2 * rise;
}

/* Moves to the end of a piece. */
static inline void normal_q27_move(struct normal_q27 *normal, const struct normal_q27_piece *piece)
{
    normal->y = piece->y;
    normal->w = piece->w;
}

/* Closes a whole step: puts the undamped exact solution back on its grid, holds a gap at its limit. Returns true if the
 * gap was held. */
bool normal_q27_close_step(struct normal_q27 *normal, const struct normal_q27_coeffs *coeffs, bool *is_saturated);

/* Contact force of a displacement. A lifted pad has y < 0 and a least force of 0. */
static inline int32_t normal_q27_force(const struct normal_q27 *normal, int32_t y)
{
    return y < normal->least_force ? normal->least_force : y;
}

/* --- What the fast path of the step needs inline ------------------------------------------------------------------ */

/* A step begins: the phase goes on to its end. Each full quarter turns the amplitudes instead. */
BASE_INLINE void normal_q27_open_step(struct normal_q27 *normal, const struct normal_q27_coeffs *coeffs)
{
    struct normal_q27_phase *phase = &normal->phase;
    uint32_t index = phase->index + coeffs->phase_stride;

    if (BASE_UNLIKELY(index >= SINE_GRID / 4u)) {
        index -= SINE_GRID / 4u;
        phase->cosine = phase->sine;
        phase->sine = phase->minus_cosine;
        phase->minus_cosine = -phase->cosine;
    }
    phase->index = index;
}

/* Displacement and velocity on the grid. */
BASE_INLINE void normal_q27_at(const struct normal_q27 *normal, uint32_t index, int32_t *y, int32_t *w,
                               bool *is_saturated)
{
    const struct normal_q27_phase *phase = &normal->phase;
    const int32_t sine = sine_quarter_q31[index];
    const int32_t cosine = sine_quarter_q31[SINE_GRID / 4u - index];

    *y = sum_q27_two(normal->n, phase->cosine, cosine, phase->sine, sine, is_saturated);
    *w = sum_q27_two(0, phase->sine, cosine, phase->minus_cosine, sine, is_saturated);
}

/* The end of a whole step in contact by the prepared map. */
BASE_INLINE void normal_q27_look_end(const struct normal_q27 *normal, const struct normal_q27_map *full,
                                     struct normal_q27_piece *piece, bool *is_saturated)
{
    const int32_t d = sum_q27_plain(normal->y, -normal->n, is_saturated);
    const int32_t w = normal->w;

    piece->y = sum_q27_two(normal->y, full->yy, d, full->yw, w, is_saturated);
    piece->w = sum_q27_two(w, full->wy, d, full->ww, w, is_saturated);
}

/* The displacements of its stages, in the places of the forces. Where the closed form is used the middle two are one,
 * and the last is that of the end. */
BASE_INLINE void normal_q27_look_stages(const struct normal_q27 *normal, const struct normal_q27_coeffs *coeffs,
                                        bool is_exact, struct normal_q27_piece *piece, bool *tell)
{
    const int32_t y = normal->y;
    const int32_t d = sum_q27_plain(y, -normal->n, tell);

    piece->p1 = y;
    piece->p2 = sum_q27_two(y, coeffs->second.yy, d, coeffs->second.yw, normal->w, tell);
    if (is_exact) {
        piece->p3 = piece->p2;
        piece->p4 = piece->y;
    } else {
        piece->p3 = sum_q27_two(y, coeffs->third.yy, d, coeffs->third.yw, normal->w, tell);
        piece->p4 = sum_q27_two(y, coeffs->fourth.yy, d, coeffs->fourth.yw, normal->w, tell);
    }
}

/* From them to the forces; they differ where y < 0 alone. */
BASE_INLINE void normal_q27_press(const struct normal_q27 *normal, struct normal_q27_piece *piece)
{
    if (BASE_LIKELY((piece->p1 | piece->p2 | piece->p3 | piece->p4) >= 0)) {
        return;
    }
    piece->p1 = normal_q27_force(normal, piece->p1);
    piece->p2 = normal_q27_force(normal, piece->p2);
    piece->p3 = normal_q27_force(normal, piece->p3);
    piece->p4 = normal_q27_force(normal, piece->p4);
}

#endif
