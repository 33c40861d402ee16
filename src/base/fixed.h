/* Integer helpers of the fixed-point side: the one place where negative numbers are shifted. Q4.27 is an int32_t whose
 * unit is 2^-27. [ANY, pure] */
#ifndef BASE_FIXED_H
#define BASE_FIXED_H

#include <stdint.h>

/* Magnitude; defined for INT32_MIN too. */
static inline uint32_t fixed_abs(int32_t value) { return value < 0 ? 0u - (uint32_t)value : (uint32_t)value; }

/* value / 2^shift, rounded to nearest, halves away from zero, so that mirrored values stay mirrored; shift 1 ... 62. */
static inline int64_t fixed_shift_right(int64_t value, unsigned shift)
{
    const uint64_t half = (uint64_t)1 << (shift - 1u);

    return value < 0 ? -(int64_t)((0u - (uint64_t)value + half) >> shift)
                     : (int64_t)(((uint64_t)value + half) >> shift);
}

/* The nearest value that fits 32 bits, symmetric: never INT32_MIN. */
static inline int32_t fixed_saturate(int64_t value)
{
    return value > INT32_MAX ? INT32_MAX : value < -INT32_MAX ? -INT32_MAX : (int32_t)value;
}

/* Base-2 logarithm of value >= 1 in Q16, error below 2^-15. */
int32_t fixed_log2_q16(uint64_t value);

#endif
