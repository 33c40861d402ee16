/* The few functions of float that the firmware needs, from + - * / and integer arithmetic alone: the same bits on every
 * board and on the host, with or without an FPU. No hardware square root, no library. [ANY] */
#ifndef BASE_FMATH_H
#define BASE_FMATH_H

#include <stdbool.h>
#include <stdint.h>

#define FMATH_PI 3.14159265358979f

/* Square root, correctly rounded, for value >= 0 (subnormals too); 0 for a negative value or NaN; inf for inf. */
float fmath_sqrt(float value);

/* sin(2 pi turns), turns as a fraction of 2^32 (0 = 0, 2^30 = a quarter turn). Error below 1e-7; odd and symmetric to
 * the bit: sine(-t) = -sine(t), sine(half turn - t) = sine(t). */
float fmath_sine_turns(uint32_t turns);

/* The same in Q30, integers only. Error below 1e-8 and half a unit. */
int32_t fmath_sine_turns_q30(uint32_t turns);

/* Base-2 logarithm of a positive finite value, of 0 that of the least number: error below 2e-7 before the result is
 * rounded to float; a power of two gives its exponent exactly. */
float fmath_log2(float value);

/* 2^value, error below 2e-7 of it; a whole number gives its power exactly. Beyond -126 ... 127 it is that of the
 * limit. */
float fmath_exp2(float value);

/* 1 - e^-value for value >= 0, error below 3e-7 of it: a small value keeps its digits. */
float fmath_decay(float value);

/* Nearest integer, ties away from zero; the caller keeps |value| below 2^31. */
int32_t fmath_round_i32(float value);

/* The bits of a float, and back. */
static inline uint32_t fmath_bits(float value)
{
    uint32_t bits;

    __builtin_memcpy(&bits, &value, sizeof bits);
    return bits;
}

static inline float fmath_from_bits(uint32_t bits)
{
    float value;

    __builtin_memcpy(&value, &bits, sizeof value);
    return value;
}

/* Finite: neither infinite nor NaN. */
bool fmath_is_finite(float value);

static inline float fmath_abs(float value) { return __builtin_fabsf(value); }

/* value + change, where what rounding took away is kept in *rest and comes in again with the next change: a state that
 * grows by small steps keeps their sum to twice the digits (Kahan). */
static inline float fmath_add_kept(float value, float change, float *rest)
{
    const float wanted = change + *rest;
    const float sum = value + wanted;

    *rest = wanted - (sum - value);
    return sum;
}

/* A 64-bit count as a float, error below one unit in the last place. The compiler's own conversion goes through
 * double. */
static inline float fmath_from_u64(uint64_t count)
{
    return (float)(uint32_t)(count >> 32) * 4294967296.0f + (float)(uint32_t)count;
}

static inline float fmath_max(float a, float b) { return a > b ? a : b; }
static inline float fmath_min(float a, float b) { return a < b ? a : b; }

#endif
