/* Roots, sines and logarithms in 32-bit integers: faster than soft float, as fast as hard float, and equal on both. */
#include "base/fmath.h"

#define SIGN 0x80000000u
#define INFINITE 0x7f800000u
#define FRACTION 0x007fffffu
#define HIDDEN 0x00800000u

#define QUARTER_TURN 0x40000000u
#define HALF_TURN 0x80000000u

/* A float is significand * 2^exponent; the significand has 24 bits for subnormals too, and is not 0. */
struct parts {
    uint32_t significand;
    int exponent;
};

bool fmath_is_finite(float value) { return (fmath_bits(value) & INFINITE) != INFINITE; }

static struct parts take_apart(float positive)
{
    const uint32_t bits = fmath_bits(positive);
    struct parts parts = {(bits & FRACTION) | HIDDEN, (int)(bits >> 23) - 150};

    if (bits < HIDDEN) {
        parts.significand = bits != 0u ? bits : 1u;
        parts.exponent = -149;
        while (parts.significand < HIDDEN) {
            parts.significand <<= 1;
            parts.exponent--;
        }
    }
    return parts;
}

/* 2^exponent within the range of normal floats. */
static float power_of_two(int exponent) { return fmath_from_bits((uint32_t)(exponent + 127) << 23); }

/* Digit by digit in base 4, as on paper: 25 bits of root, of which the last rounds. There is no tie: the square of an
 * odd root is odd, and the radicand, significand * 2^25 or twice that, is even. */
float fmath_sqrt(float value)
{
    if (!(value > 0.0f)) {
        return 0.0f;
    }
    if (!fmath_is_finite(value)) {
        return value;
    }

    const struct parts parts = take_apart(value);
    const int even = parts.exponent % 2 == 0 ? 1 : 0; /* what remains of the exponent beside those 25 bits must halve */
    uint32_t digits = parts.significand << (7 + even); /* the first 16 of 25 digits; zeros follow */
    uint32_t remainder = 0u;
    uint32_t root = 0u;

    for (unsigned i = 0u; i < 25u; i++) {
        const uint32_t trial = root << 2 | 1u;

        remainder = remainder << 2 | digits >> 30;
        digits <<= 2;
        root <<= 1;
        if (remainder >= trial) {
            remainder -= trial;
            root |= 1u;
        }
    }
    return (float)((root + 1u) >> 1) * power_of_two((parts.exponent - even - 25) / 2 + 1);
}

/* High word of a product: fixed point times fixed point. */
static uint32_t multiply_high(uint32_t a, uint32_t b) { return (uint32_t)((uint64_t)a * b >> 32); }

/* The part of a quarter wave that a turn stands on, quarter turns * 2^30; the upper half of a turn is negative. */
static uint32_t fold(uint32_t turns)
{
    const uint32_t half = turns > HALF_TURN ? 0u - turns : turns;

    return half > QUARTER_TURN ? HALF_TURN - half : half;
}

/* sin(pi/2 x)/x as an alternating polynomial of x squared, minimax on 0..1 with an error of 3.4e-9 in the sine.
 * Argument and coefficients carry 2^30, z carries 2^32 and stops just short of 1. */
static uint32_t sine_ratio(uint32_t x)
{
    const uint32_t square = multiply_high(x << 1, x << 1);
    const uint32_t z = square < QUARTER_TURN ? square << 2 : UINT32_MAX;
    uint32_t sum = 5016767u - multiply_high(161942u, z);

    sum = 85564854u - multiply_high(sum, z);
    sum = 693597876u - multiply_high(sum, z);
    return 1686629674u - multiply_high(sum, z);
}

float fmath_sine_turns(uint32_t turns)
{
    uint32_t x = fold(turns);
    const uint32_t ratio = sine_ratio(x);
    int exponent = -28;

    if (x == 0u) {
        return 0.0f;
    }
    /* A small angle moves up, so that it keeps all its digits. */
    while (x < QUARTER_TURN / 2u) {
        x <<= 1;
        exponent--;
    }

    const float sine = (float)multiply_high(x, ratio) * power_of_two(exponent);

    return turns > HALF_TURN ? -sine : sine;
}

int32_t fmath_sine_turns_q30(uint32_t turns)
{
    const uint32_t x = fold(turns);
    const int32_t sine = (int32_t)(((uint64_t)x * sine_ratio(x) + (1u << 29)) >> 30);

    return turns > HALF_TURN ? -sine : sine;
}

/* Squaring doubles the logarithm, so each squaring brings one more binary digit of it before the point. */
float fmath_log2(float value)
{
    const struct parts parts = take_apart(value);
    uint32_t mantissa = parts.significand << 8; /* 1 to 2, times 2^31 */
    uint32_t fraction = 0u;

    for (unsigned i = 0u; i < 23u; i++) {
        const uint32_t square = multiply_high(mantissa, mantissa); /* 1 to 4, times 2^30 */

        fraction <<= 1;
        if (square >= HALF_TURN) {
            fraction |= 1u;
            mantissa = square;
        } else {
            mantissa = square << 1;
        }
    }
    return (float)((parts.exponent + 23) * 8388608 + (int32_t)fraction) * power_of_two(-23);
}

/* The series of e^(ln 2 rest) about 0, with |rest| <= 1/2. */
float fmath_exp2(float value)
{
    const float bounded = fmath_min(fmath_max(value, -126.0f), 127.0f);
    const int32_t whole = fmath_round_i32(bounded);
    const float x = (bounded - (float)whole) * 0.693147181f;
    float sum = 1.0f / 5040.0f;

    sum = sum * x + 1.0f / 720.0f;
    sum = sum * x + 1.0f / 120.0f;
    sum = sum * x + 1.0f / 24.0f;
    sum = sum * x + 1.0f / 6.0f;
    sum = sum * x + 0.5f;
    sum = sum * x + 1.0f;
    return (sum * x + 1.0f) * power_of_two((int)whole);
}

/* The series of 1 - e^-x about 0, where the difference would lose its digits. */
float fmath_decay(float value)
{
    float sum = 1.0f / 11.0f;

    if (value > 1.0f) {
        return 1.0f - fmath_exp2(value * -1.44269504f);
    }
    for (unsigned i = 10u; i > 1u; i--) {
        sum = (1.0f - value * sum) / (float)i;
    }
    return value * (1.0f - value * sum);
}

int32_t fmath_round_i32(float value)
{
    const int32_t whole = (int32_t)value;
    const float rest = value - (float)whole; /* exact */

    if (rest >= 0.5f) {
        return whole + 1;
    }
    return rest <= -0.5f ? whole - 1 : whole;
}
