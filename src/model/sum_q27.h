/* Sums of products, formed in 64 bits and rounded once: the one operation that the fixed-point plant is made of.
 *
 * It comes in two kinds, told apart at compile time. With is_saturated given the result is held within 32 bits, and
 * *is_saturated is set if it had to be. With NULL the caller has proven that the result fits, and nothing is asked.
 * Proofs: MODEL.md, "Fixed point". */
#ifndef MODEL_SUM_Q27_H
#define MODEL_SUM_Q27_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/compiler.h"
#include "base/fixed.h"

/* base + sum/2^bits, halves up. The sum itself must fit 64 bits. */
BASE_INLINE int32_t sum_q27(int32_t base, int64_t sum, unsigned bits, bool *is_saturated)
{
    int32_t fit;

    if (is_saturated != NULL) {
        return fixed_saturate_and_tell(base + fixed_round_up(sum, bits), is_saturated);
    }
    fit = (int32_t)fixed_floor((((int64_t)base * ((int64_t)1 << bits)) | ((int64_t)1 << (bits - 1u))) + sum, bits);
    BASE_FORGET(fit);
    return fit;
}

/* sum/2^bits rounded down. */
BASE_INLINE int32_t sum_q27_of(int64_t sum, unsigned bits, bool *is_saturated)
{
    int32_t fit;

    if (is_saturated != NULL) {
        return fixed_saturate_and_tell(fixed_floor(sum, bits), is_saturated);
    }
    fit = (int32_t)fixed_floor(sum, bits);
    BASE_FORGET(fit);
    return fit;
}

/* base + value/2 and base + value. */
BASE_INLINE int32_t sum_q27_half(int32_t base, int32_t value, bool *is_saturated)
{
    return is_saturated == NULL ? base + fixed_half_up(value) : sum_q27(base, value, 1u, is_saturated);
}

BASE_INLINE int32_t sum_q27_plain(int32_t base, int32_t value, bool *is_saturated)
{
    return is_saturated == NULL ? base + value : fixed_saturate_and_tell((int64_t)base + value, is_saturated);
}

/* base + factor value, the factor in Q32. */
BASE_INLINE int32_t sum_q27_step(int32_t base, int32_t factor, int32_t value, bool *is_saturated)
{
    return sum_q27(base, (int64_t)factor * value, 32u, is_saturated);
}

/* base + (a b + c d)/2^32. */
BASE_INLINE int32_t sum_q27_two(int32_t base, int32_t a, int32_t b, int32_t c, int32_t d, bool *is_saturated)
{
    struct fixed_sum sum = {1u << 31, base};

    if (is_saturated != NULL) {
        return sum_q27(base, (int64_t)a * b + (int64_t)c * d, 32u, is_saturated);
    }
    fixed_sum_add(&sum, a, b);
    fixed_sum_add(&sum, c, d);
    return sum.high;
}

/* base + sum/2^32 that forgets nothing: *rest is the word below base with a half added, before and after. What the next
 * sum starts from is then not rounded, and base is what it would be rounded to. */
#define SUM_Q27_NO_REST (1u << 31)

BASE_INLINE int32_t sum_q27_kept(int32_t base, uint32_t *rest, int64_t sum, bool *is_saturated)
{
    sum += *rest;
    *rest = (uint32_t)sum;
    return fixed_saturate_and_tell(base + fixed_floor(sum, 32u), is_saturated);
}

/* One sixth in Q32. Passed as a variable, because gcc makes a row of shifts of a product with a constant. */
#define SUM_Q27_SIXTH 715827883
#define SUM_Q27_SIXTH_Q12 683

/* The two sums of RK4 by Nystrom's formulas: mean = base + (a + b + c)/6, which the position takes, and the next
 * value = mean + (b + c + d)/6. The textbook's sum, six times as large, fits no 32 bits. rest is as above; below is
 * what a + 2 b + 2 c + d lack for having been rounded down, in 2^-20 of their unit, or 0 if they were rounded to
 * nearest. */
BASE_INLINE int32_t sum_q27_rk4(int32_t base, uint32_t *rest, int32_t sixth, int32_t a, int32_t b, int32_t c, int32_t d,
                                uint32_t below, int32_t *mean, bool *is_saturated)
{
    struct fixed_sum total = {*rest, base};

    if (is_saturated != NULL) {
        int64_t sum = (int64_t)sixth * a + (int64_t)sixth * b + (int64_t)sixth * c;

        *mean = sum_q27_kept(base, rest, sum, is_saturated);
        sum =
            (int64_t)sixth * b + (int64_t)sixth * c + (int64_t)sixth * d + (int64_t)SUM_Q27_SIXTH_Q12 * (int32_t)below;
        return sum_q27_kept(*mean, rest, sum, is_saturated);
    }
    b += c;
    fixed_sum_add(&total, sixth, a + b);
    *mean = total.high;
    fixed_sum_add(&total, sixth, b + d);
    fixed_sum_add(&total, SUM_Q27_SIXTH_Q12, (int32_t)below);
    *rest = total.low;
    return total.high;
}

#endif
