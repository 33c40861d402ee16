/* Interpolated extremes without floating point. */
#include "sim/extremum.h"

#include "base/fixed.h"

uint32_t extremum_ratio_q15(uint32_t part, uint32_t whole)
{
    uint32_t shift = 0u;

    /* Seventeen significant bits of the divisor leave fifteen of the quotient. */
    while ((whole >> shift) >= (1u << 17)) {
        shift++;
    }
    return ((part >> shift) << 15) / (whole >> shift);
}

int32_t extremum_of_displacement(int32_t x0, int32_t v0, int32_t x1, int32_t v1, int32_t step_q27)
{
    const uint32_t a = fixed_abs(v0);
    const uint32_t b = fixed_abs(v1);
    const int64_t t = a + b != 0u ? (int64_t)extremum_ratio_q15(a >> 1, (a >> 1) + (b >> 1) + 1u) : 0;
    const int64_t d0 = fixed_shift_right((int64_t)v0 * step_q27, 27);
    const int64_t d1 = fixed_shift_right((int64_t)v1 * step_q27, 27);
    const int64_t rise = (int64_t)x1 - x0;
    const int64_t square = 3 * rise - 2 * d0 - d1;
    const int64_t cube = d0 + d1 - 2 * rise;
    int64_t value = fixed_shift_right(cube * t, 15) + square;

    value = fixed_shift_right(value * t, 15) + d0;
    value = fixed_shift_right(value * t, 15) + x0;
    return fixed_saturate(value);
}

int32_t extremum_of_parabola(int32_t before, int32_t middle, int32_t after)
{
    const int64_t lean = (int64_t)after - before;
    const int64_t bend = 2 * (int64_t)middle - after - before;
    const uint32_t lean_size = (uint32_t)((lean < 0 ? -lean : lean) >> 2);
    const uint32_t bend_size = (uint32_t)((bend < 0 ? -bend : bend) >> 2) + 1u;
    int64_t gain;

    if (lean_size > bend_size) {
        return middle; /* not the outermost of the three */
    }
    gain = fixed_shift_right((int64_t)lean_size * extremum_ratio_q15(lean_size, bend_size), 16);
    return fixed_saturate(bend < 0 ? middle - gain : middle + gain);
}
