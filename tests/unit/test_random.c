/* The stateless generator: its words are those of its authors, its numbers have the moments they should. */
#include "base/random.h"

#include "base/fmath.h"
#include "plants.h"
#include "tap.h"
#include "tests.h"

#define Q31_HALF (1 << 30)

static float signed_ratio(int64_t sum, float by)
{
    const float size = fmath_from_u64((uint64_t)(sum < 0 ? -sum : sum));

    return (sum < 0 ? -size : size) / by;
}

/* The known answers that the authors publish with the generator. */
static void check_words(void)
{
    const struct random_words zeros = random_words(0u, 0u, 0u);
    const struct random_words ones = random_words(UINT32_MAX, UINT32_MAX, UINT64_MAX);
    const struct random_words pi = random_words(0x13198a2eu, 0x03707344u, UINT64_C(0x85a308d3243f6a88));

    tap_check(zeros.first == 0x6b200159u && zeros.second == 0x99ba4efeu, "zeros, as published");
    tap_check(ones.first == 0x1cb996fcu && ones.second == 0xbb002be7u, "ones, as published");
    tap_check(pi.first == 0xc4923a9cu && pi.second == 0x483df7a0u, "digits of pi, as published");
}

/* The same bits on every machine. */
static void check_pinned(void)
{
    tap_check(random_uniform_q31(0u, 0u, 0u) == 0x6b200159 && random_uniform_q31(1u, 2u, 3u) == -0x7165d155,
              "uniform numbers are pinned");
    tap_check(fmath_bits(random_normal(0u, 0u, 0u)) == 0xbf477a80u &&
                  fmath_bits(random_normal(1u, 2u, 3u)) == 0x3f84e6dcu &&
                  fmath_bits(random_normal(1u, 2u, UINT64_C(3) << 32)) == 0x3eed1d7fu,
              "so are normal ones");
}

/* Moments over n numbers, in Q15, against those of -1 ... 1: error of the mean 0.58/sqrt n, of the square 0.3/sqrt
 * n. */
static void check_uniform(void)
{
    const uint32_t count = plants_scaled(200000u, 20000u);
    const float error = 4.0f / fmath_sqrt((float)count);
    int64_t sum = 0, squares = 0, cubes = 0;
    uint32_t outer = 0u;
    bool are_odd = true;

    for (uint32_t i = 0u; i < count; i++) {
        const int32_t value = random_uniform_q31(7u, 1u, i);
        const int64_t q15 = value / 65536;

        are_odd = are_odd && (value & 1) != 0;
        sum += q15;
        squares += q15 * q15;
        cubes += q15 * q15 * q15 / 32768;
        outer += value > Q31_HALF || value < -Q31_HALF;
    }
    tap_check(are_odd, "uniform numbers are odd, so each has its opposite");
    tap_check_close(signed_ratio(sum, (float)count * 32768.0f), 0.0f, 0.58f * error, "their mean is 0");
    tap_check_close(signed_ratio(squares, (float)count * 1073741824.0f), 1.0f / 3.0f, 0.3f * error,
                    "their variance 1/3");
    tap_check_close(signed_ratio(cubes, (float)count * 1073741824.0f), 0.0f, 0.38f * error, "neither side is favoured");
    tap_check_close((float)outer / (float)count, 0.5f, 0.5f * error, "half of them lie in the outer half");
}

static void check_normal(void)
{
    const uint32_t count = plants_scaled(200000u, 5000u);
    const float error = 4.0f / fmath_sqrt((float)count);
    int64_t sum = 0, squares = 0, fourths = 0;
    uint32_t beyond[5] = {0u, 0u, 0u, 0u, 0u}; /* so many standard deviations */
    float largest = 0.0f;

    for (uint32_t i = 0u; i < count; i++) {
        const float value = random_normal(3u, 9u, i);
        const int64_t q16 = (int64_t)(int32_t)(value * 65536.0f);

        sum += q16;
        squares += q16 * q16 / 65536;
        fourths += (q16 * q16 / 65536) * (q16 * q16 / 65536) / 65536;
        largest = fmath_max(largest, fmath_abs(value));
        for (uint32_t k = 1u; k < 5u; k++) {
            beyond[k] += fmath_abs(value) > (float)k;
        }
    }
    tap_check_close(signed_ratio(sum, (float)count * 65536.0f), 0.0f, error, "normal numbers have the mean 0");
    tap_check_close(signed_ratio(squares, (float)count * 65536.0f), 1.0f, 1.42f * error, "the variance 1");
    tap_check_close(signed_ratio(fourths, (float)count * 65536.0f), 3.0f, 9.8f * error, "and the fourth moment 3");
    tap_check_close((float)beyond[1] / (float)count, 0.31731f, 0.47f * error, "so many lie beyond one deviation");
    tap_check_close((float)beyond[2] / (float)count, 0.04550f, 0.21f * error, "two");
    tap_check_close((float)beyond[3] / (float)count, 0.00270f, 0.052f * error, "three");
    tap_check_close((float)beyond[4] / (float)count, 6.33e-5f, 0.008f * error, "and four");
    tap_check(largest < 6.8f && largest > 3.0f, "and none beyond what is promised");
}

/* Mean product of two sequences in units of the variance: 1/sqrt n where they know nothing of each other. */
static void check_pair(uint32_t seed, uint32_t stream, uint64_t shift, const char *claim)
{
    const uint32_t count = plants_scaled(100000u, 5000u);
    int64_t products = 0;

    for (uint32_t i = 0u; i < count; i++) {
        const int64_t one = random_uniform_q31(7u, 1u, i) / 65536;

        products += one * (random_uniform_q31(seed, stream, i + shift) / 65536);
    }
    tap_check_close(signed_ratio(products, (float)count * 357913941.0f), 0.0f, 4.0f / fmath_sqrt((float)count), claim);
}

/* A flipped bit of seed, stream or index flips half of the bits that come out. */
static void check_mixing(void)
{
    uint32_t state = 11u;
    uint32_t flips[3] = {0u, 0u, 0u};
    bool are_mixed = true;
    const uint32_t count = plants_scaled(400u, 40u);

    for (uint32_t i = 0u; i < count; i++) {
        const uint32_t seed = tap_random(&state);
        const uint32_t stream = tap_random(&state);
        const uint64_t index = (uint64_t)tap_random(&state) << 32 | tap_random(&state);
        const uint32_t word = random_words(seed, stream, index).first;

        for (uint32_t bit = 0u; bit < 32u; bit++) {
            flips[0] += (uint32_t)__builtin_popcount(word ^ random_words(seed ^ 1u << bit, stream, index).first);
            flips[1] += (uint32_t)__builtin_popcount(word ^ random_words(seed, stream ^ 1u << bit, index).first);
            flips[2] +=
                (uint32_t)__builtin_popcount(word ^ random_words(seed, stream, index ^ UINT64_C(1) << 2u * bit).first);
        }
    }
    for (uint32_t i = 0u; i < 3u; i++) {
        const float share = (float)flips[i] / (1024.0f * (float)count);

        are_mixed = are_mixed && share > 0.49f && share < 0.51f;
    }
    tap_check(are_mixed, "every bit of seed, stream and index turns half of the result");
}

void test_random(void)
{
    check_words();
    check_pinned();
    check_uniform();
    check_normal();
    check_pair(7u, 1u, 1u, "neighbours know nothing of each other");
    check_pair(7u, 1u, 2u, "nor do the next but one");
    check_pair(7u, 1u, UINT64_C(1) << 32, "nor numbers far apart");
    check_pair(7u, 2u, 0u, "nor streams");
    check_pair(8u, 1u, 0u, "nor seeds");
    check_mixing();
}
