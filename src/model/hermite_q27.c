/* Event search on a cubic: few passes, always inside the bracket, no division wider than 32 bits. */
#include "model/hermite_q27.h"

#include <stdbool.h>

enum { NEWTON_PASSES = 2, COEFFICIENT_BITS = 28 };

static uint64_t magnitude(int64_t value) { return value < 0 ? 0u - (uint64_t)value : (uint64_t)value; }

static int32_t shifted(int64_t value, int down)
{
    return (int32_t)(down > 0 ? fixed_shift_right(value, (unsigned)down) : value * ((int64_t)1 << -down));
}

static struct hermite_q27 normalise(int64_t value0, int64_t slope0, int64_t square, int64_t cube)
{
    const uint64_t all = magnitude(value0) | magnitude(slope0) | magnitude(square) | magnitude(cube);
    const int down = (int)fixed_bits(all) - COEFFICIENT_BITS;
    const struct hermite_q27 f = {shifted(value0, down), shifted(slope0, down), shifted(square, down),
                                  shifted(cube, down)};

    return f;
}

struct hermite_q27 hermite_q27_make(int64_t value0, int64_t slope0, int64_t value1, int64_t slope1)
{
    const int64_t rise = value1 - value0;

    return normalise(value0, slope0, 3 * rise - 2 * slope0 - slope1, slope0 + slope1 - 2 * rise);
}

/* Where the straight line from value0 > 0 at 0 to end <= 0 at upper meets 0. */
static int32_t secant(int32_t value0, int32_t end, int32_t upper)
{
    /* Rounding may have taken a sign; the root is then at the end that it was near. */
    if (value0 <= 0) {
        return 0;
    }
    if (end >= 0) {
        return upper;
    }
    return fixed_product(upper, (int32_t)fixed_ratio_q30((uint32_t)value0, fixed_abs(end) + (uint32_t)value0), 30);
}

/* t - value/slope, or a place below 0 where the quotient is beyond 1. */
static int32_t newton(int32_t t, int32_t value, int32_t slope)
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

int32_t hermite_q27_root(const struct hermite_q27 *f, int32_t upper)
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

int32_t hermite_q27_root_after_start(const struct hermite_q27 *f)
{
    const struct hermite_q27 divided = {f->slope0, f->square, f->cube, 0};

    return hermite_q27_root(&divided, HERMITE_Q27_ONE);
}

int32_t hermite_q27_minimum(const struct hermite_q27 *f)
{
    const struct hermite_q27 descent =
        normalise(-(int64_t)f->slope0, -2 * (int64_t)f->square, -3 * (int64_t)f->cube, 0);

    return hermite_q27_root(&descent, HERMITE_Q27_ONE);
}
