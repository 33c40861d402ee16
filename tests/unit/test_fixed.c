/* Integer helpers: rounding on both sides of 0, saturation at both ends, ratios, products with a float. */
#include "base/fixed.h"

#include "base/fmath.h"
#include "plants.h"
#include "tap.h"
#include "tests.h"

static void check_rounding(void)
{
    uint32_t state = 31u;
    bool is_mirrored = true;
    bool is_near = true;

    tap_check(fixed_floor(-1, 1u) == -1 && fixed_floor(-5, 2u) == -2 && fixed_floor(INT64_MIN, 63u) == -1 &&
                  fixed_floor_word(-1, 1u) == -1 && fixed_floor_word(-5, 2u) == -2 &&
                  fixed_floor_word(INT32_MIN, 31u) == -1,
              "a negative number is shifted towards minus infinity");
    tap_check(fixed_round_up(5, 1u) == 3 && fixed_round_up(-5, 1u) == -2 && fixed_round_up(-6, 2u) == -1,
              "halves go up");
    tap_check(fixed_half_up(5) == 3 && fixed_half_up(-5) == -2 && fixed_half_up(-6) == -3, "in 32 bits too");
    tap_check(fixed_shift_right(5, 1u) == 3 && fixed_shift_right(-5, 1u) == -3 && fixed_shift_right(-6, 2u) == -2,
              "or away from 0");
    tap_check(fixed_product(3 << 26, -(1 << 26), 27u) == -(3 << 25) && fixed_product(1, -1, 1u) == -1 &&
                  fixed_product(1, 1, 2u) == 0,
              "a product in the same way");
    for (uint32_t i = 0u; i < plants_scaled(50000u, 2000u); i++) {
        const int64_t value = (int64_t)(((uint64_t)tap_random(&state) << 30) | tap_random(&state));
        const unsigned shift = 1u + tap_random(&state) % 40u;
        const int64_t rounded = fixed_shift_right(value, shift);

        is_mirrored = is_mirrored && fixed_shift_right(-value, shift) == -rounded;
        is_near = is_near && fixed_round_up(value, shift) == rounded &&
                  fixed_round_up(-value, shift) - fixed_shift_right(-value, shift) <= 1;
    }
    tap_check(is_mirrored && is_near, "away from 0 mirrored values stay mirrored, and both agree but for halves");
}

static void check_saturation(void)
{
    bool told = false;

    tap_check(fixed_saturate_and_tell(INT32_MAX, &told) == INT32_MAX &&
                  fixed_saturate_and_tell(-INT32_MAX, &told) == -INT32_MAX && !told,
              "both ends of 32 bits fit");
    tap_check(fixed_saturate_and_tell((int64_t)INT32_MAX + 1, &told) == INT32_MAX && told, "one more does not");
    told = false;
    tap_check(fixed_saturate_and_tell(INT32_MIN, &told) == -INT32_MAX && told, "nor does the number without a mirror");
    told = false;
    tap_check(fixed_saturate_and_tell(-(INT64_C(1) << 40), &told) == -INT32_MAX && told, "nor one far below");
    tap_check(fixed_saturate_and_tell(7, &told) == 7 && told, "and what was told stays told");
}

static void check_ratio(void)
{
    uint32_t state = 3u;
    float worst = 0.0f;
    bool is_bounded = true;

    for (uint32_t i = 0u; i < plants_scaled(50000u, 2000u); i++) {
        const uint32_t whole = (tap_random(&state) >> tap_random(&state) % 32u) | 1u;
        const uint32_t part = (tap_random(&state) >> tap_random(&state) % 32u) % whole;
        const uint32_t ratio = fixed_ratio_q30(part, whole);
        const float exact = (float)part / (float)whole;

        worst = fmath_max(worst, fmath_abs((float)ratio / 1073741824.0f - exact) - exact / 8192.0f);
        is_bounded = is_bounded && ratio <= 1u << 30;
    }
    tap_check(worst <= 1.0f / 1073741824.0f, "a ratio has thirteen good bits however small it is");
    tap_check(is_bounded && fixed_ratio_q30(UINT32_MAX, UINT32_MAX) == 1u << 30 &&
                  fixed_ratio_q30(1u, 1u) == 1u << 30 && fixed_ratio_q30(0u, 1u) == 0u &&
                  fixed_ratio_q30(0u, UINT32_MAX) == 0u,
              "and never exceeds 1; its ends are exact");
}

static void check_float(void)
{
    uint32_t state = 17u;
    bool is_exact = true;

    tap_check(fixed_times_float(1, 0.5f, 1) == 1 && fixed_times_float(1, -0.25f, 1) == -1 &&
                  fixed_times_float(3, 1.5f, 0) == 5 && fixed_times_float(-3, 1.5f, 0) == -5,
              "a product with a float is rounded, halves away from 0");
    tap_check(fixed_times_float(INT64_C(1) << 38, 16777215.0f, 0) == INT64_C(16777215) << 38, "its factor has 38 bits");
    tap_check(fixed_times_float(1, 1e30f, 0) == INT64_C(1) << 62 &&
                  fixed_times_float(-1, 1e30f, 0) == -(INT64_C(1) << 62) &&
                  fixed_times_float(1, fmath_from_bits(0xff800000u), -200) == -(INT64_C(1) << 62) &&
                  fixed_times_float(1, fmath_from_bits(0x7fc00000u), 0) == INT64_C(1) << 62,
              "what is too large is held, infinity and what is no number too");
    tap_check(fixed_times_float(1, 1e-30f, 27) == 0 && fixed_times_float(1, fmath_from_bits(1u), 149) == 1 &&
                  fixed_times_float(0, 1e30f, 27) == 0 && fixed_times_float(5, -0.0f, 27) == 0,
              "what is too small is 0; subnormals count");
    tap_check(fixed_from_float(1.0f, 27) == 1 << 27 && fixed_from_float(-15.5f, 27) == -(31 << 26) &&
                  fixed_from_float(16.0f, 27) == INT32_MAX && fixed_from_float(-1e9f, 27) == -INT32_MAX,
              "a float becomes Q4.27 or its nearest end");
    for (uint32_t i = 0u; i < plants_scaled(20000u, 1000u); i++) {
        const float value = plants_random(&state, -15.0f, 15.0f);

        is_exact = is_exact && (float)fixed_from_float(value, 27) / 134217728.0f - value <= 1.0f / 268435456.0f &&
                   fixed_from_float(-value, 27) == -fixed_from_float(value, 27);
    }
    tap_check(is_exact && fixed_bits(0u) == 0u && fixed_bits(1u) == 1u && fixed_bits(UINT64_C(1) << 32) == 33u &&
                  fixed_bits(UINT64_MAX) == 64u,
              "to the nearest, mirrored; bits are counted");
}

void test_fixed(void)
{
    check_rounding();
    check_saturation();
    check_ratio();
    check_float();
}
