/* One slip piece in Q4.27: RK4 of the tangential equation with the sign of vr frozen.
 *
 * It is always computed as seen from the side to which the pad slips, where vr > 0: a mirrored pad goes through the
 * same integers, whatever the rounding. Time is counted in steps, so the factors carry h or the part of it that the
 * piece takes, and an "increment" is h x''. Signs are those with which a factor enters its sum. */
#ifndef MODEL_SLIP_Q27_H
#define MODEL_SLIP_Q27_H

#include <stdbool.h>
#include <stdint.h>

#include "base/compiler.h"
#include "model/normal_q27.h"
#include "model/sum_q27.h"

/* Fraction bits of the factors: FINE where all of them stay below 1/2 and the states are small, which is the usual
 * step; WIDE holds whatever the scale admits. */
enum { SLIP_Q27_FINE = 32, SLIP_Q27_WIDE = 28 };

struct slip_q27_factors {
    int32_t sixth;                 /* SUM_Q27_SIXTH */
    int32_t travel;                /* h/2^length_shift in Q32: x per v */
    int32_t spring;                /* -h K, K = Z2 2^length_shift */
    int32_t half_stretch, stretch; /* -h K travel/2 and -h K travel: what a velocity adds to the spring's increment */
    int32_t friction;              /* h mu */
    int32_t fade;                  /* -h eps */
    int32_t floor;                 /* h times the floor of mu; far below any mu where there is none */
    int64_t drag; /* -h C with 27 bits more, so that a small C is not rounded away, and the half that rounds */
    int32_t damp; /* fine: -h C, and what the lower word of -h eps p lacks in the mean */
    int64_t knee; /* (floor - friction) with 27 bits more: on the floor where -fade vr lies below it */
};

/* The pad as seen from its side. */
struct slip_q27_view {
    int32_t x, v, disc;
    int32_t drive; /* h (mu + eps disc) */
};

/* What rounding has left of x and v, as sum_q27_kept() has it, seen from the side too. Without it a small damping is
 * lost in the rounding, and a pad that comes to rest goes on to rustle. */
struct slip_q27_rest {
    uint32_t x, v;
};

/* End of a piece, and the increment at its start. */
struct slip_q27_end {
    int32_t x, v;
    struct slip_q27_rest rest;
    int32_t first;
};

/* A factor of a product whose sum must fit: wide ones stay within 4, that is 2^30. */
BASE_INLINE int32_t slip_q27_factor(int64_t factor, bool *is_saturated)
{
    int32_t fit;

    if (is_saturated != NULL && (factor > (1 << 30) || factor < -(1 << 30))) {
        *is_saturated = true;
        return factor > 0 ? 1 << 30 : -(1 << 30);
    }
    fit = (int32_t)factor;
    BASE_FORGET(fit);
    return fit;
}

/* In the fine arithmetic the upper word of fade times twice a state is in Q28, coarse beside a factor in Q32. What is
 * cut off averages to half a unit. */
enum { SLIP_Q27_UPPER_UNIT = 16 };

BASE_INLINE int32_t slip_q27_drive(const struct slip_q27_factors *f, int32_t disc, bool *is_saturated)
{
    if (is_saturated == NULL) {
        return f->friction - fixed_sum_of(f->fade, 2 * disc).high * SLIP_Q27_UPPER_UNIT - SLIP_Q27_UPPER_UNIT / 2;
    }
    return slip_q27_factor(f->friction - fixed_round_up((int64_t)f->fade * disc, 27u), is_saturated);
}

/* h x'' = (drive + fade v) p + drag v + pull in the unit of the sum, and so is pull = spring x. */
BASE_INLINE int64_t slip_q27_sum(const struct slip_q27_factors *f, const struct slip_q27_view *view, int64_t pull,
                                 int32_t v, int32_t p, bool has_floor, bool *is_saturated)
{
    int32_t drive = view->drive;
    int64_t fade = (int64_t)f->fade * p;
    int32_t drag;

    if (has_floor && -(f->fade * ((int64_t)view->disc - v)) < f->knee) {
        drive = f->floor;
        fade = 0;
    }
    drag = slip_q27_factor(fixed_floor(f->drag + fade, 27u), is_saturated);
    return pull + (int64_t)drive * p + (int64_t)drag * v;
}

/* --- Wide --- */

/* The increment at x, v, to nearest. */
BASE_INLINE int32_t slip_q27_increment(const struct slip_q27_factors *f, const struct slip_q27_view *view, int32_t x,
                                       int32_t v, int32_t p, bool has_floor, unsigned bits, bool *is_saturated)
{
    return sum_q27(0, slip_q27_sum(f, view, (int64_t)f->spring * x, v, p, has_floor, is_saturated), bits, is_saturated);
}

/* The increment of a stage, rounded down. What this takes away is added to *below with the weight of the stage: shifted
 * by OUTER it counts once, by INNER twice. */
enum { SLIP_Q27_OUTER = 12, SLIP_Q27_INNER = 11 };

BASE_INLINE int32_t slip_q27_stage(int64_t sum, uint32_t *below, unsigned weight, bool *is_saturated)
{
    *below += ((uint32_t)sum << (32u - (unsigned)SLIP_Q27_WIDE)) >> weight;
    return sum_q27_of(sum, SLIP_Q27_WIDE, is_saturated);
}

/* The stages need of x only what the spring makes of it, and x is linear in the velocities before. */
BASE_INLINE void slip_q27_go_wide(const struct slip_q27_factors *f, const struct slip_q27_view *view,
                                  const struct slip_q27_rest *rest, const struct normal_q27_piece *piece,
                                  struct slip_q27_end *end, bool has_floor, bool *tell)
{
    const int32_t v1 = view->v;
    const int64_t pull1 = (int64_t)f->spring * view->x;
    uint32_t below = 0u;
    const int64_t sum1 = slip_q27_sum(f, view, pull1, v1, piece->p1, has_floor, tell);
    const int32_t a1 = slip_q27_stage(sum1, &below, SLIP_Q27_OUTER, tell);
    const int32_t v2 = sum_q27_half(v1, a1, tell);
    const int64_t pull2 = pull1 + (int64_t)f->half_stretch * v1;
    const int64_t sum2 = slip_q27_sum(f, view, pull2, v2, piece->p2, has_floor, tell);
    const int32_t a2 = slip_q27_stage(sum2, &below, SLIP_Q27_INNER, tell);
    const int32_t v3 = sum_q27_half(v1, a2, tell);
    const int64_t pull3 = pull1 + (int64_t)f->half_stretch * v2;
    const int64_t sum3 = slip_q27_sum(f, view, pull3, v3, piece->p3, has_floor, tell);
    const int32_t a3 = slip_q27_stage(sum3, &below, SLIP_Q27_INNER, tell);
    const int32_t v4 = sum_q27_plain(v1, a3, tell);
    const int64_t pull4 = pull1 + (int64_t)f->stretch * v3;
    const int64_t sum4 = slip_q27_sum(f, view, pull4, v4, piece->p4, has_floor, tell);
    const int32_t a4 = slip_q27_stage(sum4, &below, SLIP_Q27_OUTER, tell);
    int32_t mean;

    end->rest = *rest;
    end->v = sum_q27_rk4(v1, &end->rest.v, f->sixth, a1, a2, a3, a4, below, &mean, tell);
    end->x = sum_q27_kept(view->x, &end->rest.x, (int64_t)f->travel * mean, tell);
    end->first = a1;
}

/* --- Fine: the upper word of a sum is the increment, rounded down --- */

/* What friction and damping do at a stage: the increment is drive p + drag v + what the spring does. On the floor of mu
 * both are others. */
struct slip_q27_law {
    int32_t drive, drag;
};

BASE_INLINE struct slip_q27_law slip_q27_law(const struct slip_q27_factors *f, const struct slip_q27_view *view,
                                             int32_t v, int32_t p, bool has_floor)
{
    if (has_floor && -(f->fade * ((int64_t)view->disc - v)) < f->knee) {
        return (struct slip_q27_law){f->floor, f->damp};
    }
    return (struct slip_q27_law){view->drive, f->damp + fixed_sum_of(f->fade, 2 * p).high * SLIP_Q27_UPPER_UNIT};
}

/* RK4 as its stages are linear: with v2 = v1 + a1/2, v3 = v1 + a2/2, v4 = v1 + a3 and the places of x that belong to
 * them,
 *
 *   a1 = spring x + drive p1 + drag v1
 *   a2 = spring x + drive p2 + (drag + half) v1 + drag/2 a1                  half: half_stretch
 *   a3 = spring x + drive p3 + (drag + half) v1 + drag/2 a2 + half/2 a1
 *   a4 = spring x + drive p4 + (drag + stretch) v1 + drag a3 + half a2
 *
 * with the drag of each stage. Where p2 = p3, the two share all but their last terms. */
BASE_INLINE void slip_q27_go_fine(const struct slip_q27_factors *f, const struct slip_q27_view *view,
                                  const struct slip_q27_rest *rest, const struct normal_q27_piece *piece,
                                  struct slip_q27_end *end, bool is_exact, bool has_floor)
{
    const int32_t v1 = view->v;
    struct slip_q27_law law = slip_q27_law(f, view, v1, piece->p1, has_floor);
    struct fixed_sum pull = fixed_sum_of(f->spring, view->x);
    struct fixed_sum sum = pull;
    struct fixed_sum middle = pull;
    uint32_t below;
    int32_t a1, a2, a3, mean;

    fixed_sum_add(&sum, law.drive, piece->p1);
    fixed_sum_add(&sum, law.drag, v1);
    a1 = sum.high;
    below = sum.low >> SLIP_Q27_OUTER;

    law = slip_q27_law(f, view, v1 + fixed_half_up(a1), piece->p2, has_floor);
    fixed_sum_add(&middle, law.drive, piece->p2);
    fixed_sum_add(&middle, law.drag + f->half_stretch, v1);
    sum = middle;
    fixed_sum_add(&sum, fixed_floor_word(law.drag, 1u), a1);
    a2 = sum.high;
    below += sum.low >> SLIP_Q27_INNER;

    if (!is_exact || has_floor) {
        law = slip_q27_law(f, view, v1 + fixed_half_up(a2), piece->p3, has_floor);
        middle = pull;
        fixed_sum_add(&middle, law.drive, piece->p3);
        fixed_sum_add(&middle, law.drag + f->half_stretch, v1);
    }
    fixed_sum_add(&middle, fixed_floor_word(law.drag, 1u), a2);
    fixed_sum_add(&middle, fixed_floor_word(f->half_stretch, 1u), a1);
    a3 = middle.high;
    below += middle.low >> SLIP_Q27_INNER;

    law = slip_q27_law(f, view, v1 + a3, piece->p4, has_floor);
    fixed_sum_add(&pull, law.drive, piece->p4);
    fixed_sum_add(&pull, law.drag + f->stretch, v1);
    fixed_sum_add(&pull, law.drag, a3);
    fixed_sum_add(&pull, f->half_stretch, a2);
    below += pull.low >> SLIP_Q27_OUTER;

    end->rest.v = rest->v;
    end->v = sum_q27_rk4(v1, &end->rest.v, f->sixth, a1, a2, a3, pull.high, below, &mean, NULL);
    sum = (struct fixed_sum){rest->x, view->x};
    fixed_sum_add(&sum, f->travel, mean);
    end->x = sum.high;
    end->rest.x = sum.low;
    end->first = a1;
}

/* The increment at x, v, rounded down. */
BASE_INLINE int32_t slip_q27_fine_increment(const struct slip_q27_factors *f, const struct slip_q27_view *view,
                                            int32_t x, int32_t v, int32_t p, bool has_floor)
{
    const struct slip_q27_law law = slip_q27_law(f, view, v, p, has_floor);
    struct fixed_sum sum = fixed_sum_of(f->spring, x);

    fixed_sum_add(&sum, law.drive, p);
    fixed_sum_add(&sum, law.drag, v);
    return sum.high;
}

/* --- Parts of a step ---------------------------------------------------------------------------------------------- */

/* The fine factors of a part of the step without a floor, a fraction in Q30. */
BASE_INLINE void slip_q27_fine_part(const struct slip_q27_factors *whole, int32_t fraction,
                                    struct slip_q27_factors *part)
{
    part->sixth = whole->sixth;
    part->travel = fixed_part_near(whole->travel, fraction);
    part->spring = fixed_part_near(whole->spring, fraction);
    part->half_stretch = fixed_part_near(fixed_part_near(whole->half_stretch, fraction), fraction);
    part->stretch = 2 * part->half_stretch;
    part->friction = fixed_part_near(whole->friction, fraction);
    part->fade = fixed_part_near(whole->fade, fraction);
    part->damp = fixed_part_near(whole->damp - SLIP_Q27_UPPER_UNIT / 2, fraction) + SLIP_Q27_UPPER_UNIT / 2;
}

/* The factors of a part of the step, a fraction in Q30. Those of the floor are left alone where there is none. */
void slip_q27_take_part(const struct slip_q27_factors *whole, int32_t fraction, bool has_floor, bool is_wide,
                        struct slip_q27_factors *part);

/* The two above in either arithmetic, with factors in its format: wide with is_saturated given, fine with NULL. */
int32_t slip_q27_any_increment(const struct slip_q27_factors *f, const struct slip_q27_view *view, int32_t x, int32_t v,
                               int32_t p, bool has_floor, bool *is_saturated);
void slip_q27_any_go(const struct slip_q27_factors *f, const struct slip_q27_view *view,
                     const struct slip_q27_rest *rest, const struct normal_q27_piece *piece, struct slip_q27_end *end,
                     bool has_floor, bool *is_saturated);

#endif
