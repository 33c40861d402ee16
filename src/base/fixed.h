/* Integer helpers of the fixed-point side: the one place where negative numbers are shifted. Q4.27 is an int32_t whose
 * unit is 2^-27, Q2.30 one whose unit is 2^-30, and so on. [ANY, pure] */
#ifndef BASE_FIXED_H
#define BASE_FIXED_H

#include <stdbool.h>
#include <stdint.h>

#include "base/compiler.h"

/* Magnitude; defined for INT32_MIN too. */
static inline uint32_t fixed_abs(int32_t value) { return value < 0 ? 0u - (uint32_t)value : (uint32_t)value; }

/* value / 2^shift rounded down; shift 0 ... 63. C99 leaves this shift to the compiler; gcc and clang keep the sign, and
 * a unit test asks them. */
static inline int64_t fixed_floor(int64_t value, unsigned shift) { return value >> shift; }

/* The same in 32 bits; shift 0 ... 31. */
static inline int32_t fixed_floor_word(int32_t value, unsigned shift) { return value >> shift; }

/* value / 2 to nearest, halves up, in 32 bits; value < INT32_MAX. */
static inline int32_t fixed_half_up(int32_t value) { return (value + 1) >> 1; }

/* value / 2^shift to nearest, halves up; shift 1 ... 62. The cheaper rounding, for numbers that have no mirror
 * image. */
static inline int64_t fixed_round_up(int64_t value, unsigned shift)
{
    return fixed_floor(value + ((int64_t)1 << (shift - 1u)), shift);
}

/* value / 2^shift, rounded to nearest, halves away from zero, so that mirrored values stay mirrored; shift 1 ... 62. */
static inline int64_t fixed_shift_right(int64_t value, unsigned shift)
{
    const uint64_t half = (uint64_t)1 << (shift - 1u);

    return value < 0 ? -(int64_t)((0u - (uint64_t)value + half) >> shift)
                     : (int64_t)(((uint64_t)value + half) >> shift);
}

/* a b / 2^shift in the same rounding, for a product that fits 32 bits then. */
static inline int32_t fixed_product(int32_t a, int32_t b, unsigned shift)
{
    return (int32_t)fixed_shift_right((int64_t)a * b, shift);
}

/* A part of a value without a mirror image: fraction in Q30, 0 to 1; halves up. */
static inline int32_t fixed_part(int32_t value, int32_t fraction)
{
    return (int32_t)fixed_round_up((int64_t)value * fraction, 30u);
}

/* The nearest value that fits 32 bits, symmetric: never INT32_MIN. */
static inline int32_t fixed_saturate(int64_t value)
{
    return value > INT32_MAX ? INT32_MAX : value < -INT32_MAX ? -INT32_MAX : (int32_t)value;
}

/* The same, remembering that it had to; *is_saturated is never cleared here. */
BASE_INLINE int32_t fixed_saturate_and_tell(int64_t value, bool *is_saturated)
{
    const int32_t low = (int32_t)value;

    if (BASE_LIKELY(low == value && low != INT32_MIN)) {
        return low;
    }
    *is_saturated = true;
    return fixed_saturate(value);
}

/* A sum of products, 64 bits in two words: what is above and what is below 2^32. The sum must fit. */
struct fixed_sum {
    uint32_t low;
    int32_t high;
};

/* The sum in one number. */
static inline int64_t fixed_sum_whole(const struct fixed_sum *sum)
{
    return (int64_t)sum->high * (INT64_C(1) << 32) + sum->low;
}

/* Adds a b. */
BASE_INLINE void fixed_sum_add(struct fixed_sum *sum, int32_t a, int32_t b)
{
#ifdef BASE_ADD_PRODUCT
    BASE_ADD_PRODUCT(sum->low, sum->high, a, b);
#else
    const int64_t whole = fixed_sum_whole(sum) + (int64_t)a * b;

    sum->low = (uint32_t)whole;
    sum->high = (int32_t)fixed_floor(whole, 32u);
#endif
}

/* a b. */
BASE_INLINE struct fixed_sum fixed_sum_of(int32_t a, int32_t b)
{
    struct fixed_sum sum;
#ifdef BASE_PRODUCT
    BASE_PRODUCT(sum.low, sum.high, a, b);
#else
    sum = (struct fixed_sum){0u, 0};
    fixed_sum_add(&sum, a, b);
#endif
    return sum;
}

/* A part of a value as fixed_part() gives it, but up to four units less: by the upper word alone. */
static inline int32_t fixed_part_near(int32_t value, int32_t fraction)
{
    return fixed_sum_of(value, fraction).high * 4;
}

/* Bits that the magnitude takes, 0 for 0. */
unsigned fixed_bits(uint64_t magnitude);

/* part/whole in Q30 for 0 <= part <= whole, whole > 0; relative error below 2^-14, never above 1. One division of 32
 * bits. */
uint32_t fixed_ratio_q30(uint32_t part, uint32_t whole);

/* factor value 2^exponent, rounded to nearest, halves away from zero; |factor| <= 2^38. What exceeds 2^62 is held
 * there; NaN counts as infinite. No floating-point operation. */
int64_t fixed_times_float(int64_t factor, float value, int exponent);

/* value in a format with so many fraction bits, saturated. */
static inline int32_t fixed_from_float(float value, int fraction_bits)
{
    return fixed_saturate(fixed_times_float(1, value, fraction_bits));
}

/* Base-2 logarithm of value >= 1 in Q16, error below 2^-15. */
int32_t fixed_log2_q16(uint64_t value);

#endif
