/* Event search on a cubic: few passes, always inside the bracket, no division wider than 32 bits. */
#include "model/hermite_q27.h"

#include <stdbool.h>

enum { NEWTON_PASSES = 2, INPUT_BITS = 25 };

static uint64_t magnitude(int64_t value) { return value < 0 ? 0u - (uint64_t)value : (uint64_t)value; }

/* The sign aside, all bits of a word that say something. */
static uint32_t significant(int32_t value) { return (uint32_t)(value ^ fixed_floor_word(value, 31u)); }

static int32_t scaled(int32_t value, unsigned up)
{
    return fixed_floor_word((int32_t)((uint32_t)value << up), 31u - INPUT_BITS);
}

BASE_INLINE struct hermite_q27 make(int32_t value0, int32_t slope0, int32_t value1, int32_t slope1)
{
    const uint32_t all = significant(value0) | significant(slope0) | significant(value1) | significant(slope1);
    const unsigned up = BASE_LEADING_ZEROS(all | 1u) - 1u;
    const int32_t start = scaled(value0, up);
    const int32_t d0 = scaled(slope0, up);
    const int32_t d1 = scaled(slope1, up);
    const int32_t rise = scaled(value1, up) - start;
    const struct hermite_q27 f = {start, d0, 3 * rise - 2 * d0 - d1, d0 + d1 - 2 * rise};

    return f;
}

struct hermite_q27 hermite_q27_make(int32_t value0, int32_t slope0, int32_t value1, int32_t slope1)
{
    return make(value0, slope0, value1, slope1);
}

struct hermite_q27 hermite_q27_make_wide(int64_t value0, int64_t slope0, int64_t value1, int64_t slope1)
{
    const unsigned bits = fixed_bits(magnitude(value0) | magnitude(slope0) | magnitude(value1) | magnitude(slope1));
    const unsigned down = bits > 30u ? bits - 30u : 0u;

    return hermite_q27_make((int32_t)fixed_floor(value0, down), (int32_t)fixed_floor(slope0, down),
                            (int32_t)fixed_floor(value1, down), (int32_t)fixed_floor(slope1, down));
}

/* Where the straight line from value0 > 0 at 0 to end <= 0 at upper meets 0. */
BASE_INLINE int32_t secant(int32_t value0, int32_t end, int32_t upper)
{
    int32_t part;

    /* Rounding may have taken a sign; the root is then at the end that it was near. */
    if (value0 <= 0) {
        return 0;
    }
    if (end >= 0) {
        return upper;
    }
    part = (int32_t)fixed_ratio_q30((uint32_t)value0, fixed_abs(end) + (uint32_t)value0);
    return upper == HERMITE_Q27_ONE ? part : fixed_product(upper, part, 30);
}

/* t - value/slope, or a place below 0 where the quotient is beyond 1. */
BASE_INLINE int32_t newton(int32_t t, int32_t value, int32_t slope)
{
    const uint32_t part = fixed_abs(value);
    const uint32_t whole = fixed_abs(slope);
    uint32_t move;

    if (whole < part || whole == 0u) {
        return -1;
    }
    move = fixed_ratio_q30(part, whole);
    move = move < HERMITE_Q27_ONE ? move : HERMITE_Q27_ONE - 1u; /* so that t + move fits */
    return (value < 0) == (slope < 0) ? t - (int32_t)move : t + (int32_t)move;
}

BASE_INLINE int32_t find_root(const struct hermite_q27 *f, int32_t upper)
{
    int32_t low = 0;
    int32_t high = upper;
    int32_t t = secant(f->value0, hermite_q27_value(f, upper), upper);

    for (int pass = 0; pass < NEWTON_PASSES; pass++) {
        const int32_t value = hermite_q27_value(f, t);
        const int32_t bend = hermite_q27_term(2 * f->square, 3 * f->cube, t); /* within 5 2^28 */
        const int32_t slope = hermite_q27_term(f->slope0, bend, t);           /* within 6 2^28 */
        const int32_t next = newton(t, value, slope);

        if (value < 0) {
            high = t;
        } else {
            low = t;
        }
        /* A root on the bracket's edge is a root: a strict test here would jump away after converging. */
        t = next >= low && next <= high ? next : low + (high - low) / 2;
    }
    return t;
}

int32_t hermite_q27_root(const struct hermite_q27 *f, int32_t upper) { return find_root(f, upper); }

int32_t hermite_q27_find(int32_t value0, int32_t slope0, int32_t value1, int32_t slope1)
{
    const struct hermite_q27 f = make(value0, slope0, value1, slope1);

    return find_root(&f, HERMITE_Q27_ONE);
}

int32_t hermite_q27_root_after_start(const struct hermite_q27 *f)
{
    const struct hermite_q27 divided = {f->slope0, f->square, f->cube, 0};

    return hermite_q27_root(&divided, HERMITE_Q27_ONE);
}

int32_t hermite_q27_minimum(const struct hermite_q27 *f)
{
    const struct hermite_q27 descent = {-fixed_floor_word(f->slope0, 2u), -fixed_floor_word(f->square, 1u),
                                        -fixed_floor_word(3 * f->cube, 2u), 0};

    return hermite_q27_root(&descent, HERMITE_Q27_ONE);
}
