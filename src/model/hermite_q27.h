/* The cubic of hermite_f32.h in integers. Only its roots and its sign are wanted, so its values may have any unit: make
 * shifts all four arguments by the same number of bits until the largest takes 25. Places are in Q30. [ANY, pure] */
#ifndef MODEL_HERMITE_Q27_H
#define MODEL_HERMITE_Q27_H

#include <stdint.h>

#include "base/fixed.h"

#define HERMITE_Q27_ONE (1 << 30) /* t = 1 */

struct hermite_q27 {
    int32_t value0, slope0, square,
        cube; /* f = value0 + t (slope0 + t (square + t cube)), each within 2^25, 2^25, 9 2^25, 6 2^25 */
};

/* The arguments share one unit and are any words; or lie within 2^62. */
struct hermite_q27 hermite_q27_make(int32_t value0, int32_t slope0, int32_t value1, int32_t slope1);
struct hermite_q27 hermite_q27_make_wide(int64_t value0, int64_t slope0, int64_t value1, int64_t slope1);

/* First root in (0, upper], for f(0) > 0 >= f(upper): secant start, two safeguarded Newton passes. */
int32_t hermite_q27_root(const struct hermite_q27 *f, int32_t upper);

/* The same in (0, 1], of the cubic that hermite_q27_make() would make. */
int32_t hermite_q27_find(int32_t value0, int32_t slope0, int32_t value1, int32_t slope1);

/* Root in (0, 1] of a curve that starts at f(0) = 0 with slope0 > 0 and ends below 0: the root at 0 is divided out. */
int32_t hermite_q27_root_after_start(const struct hermite_q27 *f);

/* Place of the minimum inside (0, 1), for slope0 < 0 < slope1. */
int32_t hermite_q27_minimum(const struct hermite_q27 *f);

/* sum + factor t, rounded down. The upper word of a product lacks two bits of the result, which the search can
 * spare. */
static inline int32_t hermite_q27_term(int32_t sum, int32_t factor, int32_t t)
{
    return sum + (int32_t)fixed_floor((int64_t)factor * t, 32u) * 4;
}

/* No sum below exceeds 17 2^25. */
static inline int32_t hermite_q27_value(const struct hermite_q27 *f, int32_t t)
{
    return hermite_q27_term(f->value0, hermite_q27_term(f->slope0, hermite_q27_term(f->square, f->cube, t), t), t);
}

#endif
