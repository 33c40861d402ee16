/* Extremes between samples of known curves. */
#include "sim/extremum.h"

#include "base/fmath.h"
#include "plants.h"
#include "tap.h"
#include "tests.h"

enum { ONE = 1 << 27, STEP_Q27 = 13176796 /* 2 pi/64 */ };

static void check_ratio(void)
{
    uint32_t state = 3u;
    float worst = 0.0f;
    bool is_bounded = true;

    for (uint32_t i = 0u; i < plants_scaled(50000u, 2000u); i++) {
        const uint32_t whole = (tap_random(&state) >> tap_random(&state) % 31u) | 1u;
        const uint32_t part = tap_random(&state) % whole;
        const uint32_t ratio = extremum_ratio_q15(part, whole);

        worst = fmath_max(worst, fmath_abs((float)ratio / 32768.0f - (float)part / (float)whole));
        is_bounded = is_bounded && ratio <= 32768u;
    }
    tap_check(worst < 1.0f / 16384.0f, "a ratio is off by less than 2^-14");
    tap_check(is_bounded, "and never beyond 1");
    tap_check(extremum_ratio_q15(0u, 1u) == 0u && extremum_ratio_q15(1u, 1u) == 32768u &&
                  extremum_ratio_q15(UINT32_MAX, UINT32_MAX) == 32768u && extremum_ratio_q15(0u, UINT32_MAX) == 0u,
              "its ends are exact");
}

static int32_t to_q27(float value) { return (int32_t)(value * (float)ONE); }

/* x = size cos(t), sampled so that its extreme lies at each place between two samples. */
static void check_displacement(void)
{
    float worst = 0.0f;
    float worst_raw = 0.0f;

    for (uint32_t place = 1u; place < 64u; place++) {
        for (int sign = -1; sign <= 1; sign += 2) {
            const float size = 3.0f * (float)sign;
            const uint32_t before = (0u - place) << 20; /* a step is 2^26 of 2^32 turns */
            const uint32_t after = before + (1u << 26);
            const int32_t x0 = to_q27(size * fmath_sine_turns(before + (1u << 30)));
            const int32_t x1 = to_q27(size * fmath_sine_turns(after + (1u << 30)));
            const int32_t v0 = to_q27(-size * fmath_sine_turns(before));
            const int32_t v1 = to_q27(-size * fmath_sine_turns(after));
            const float extreme = (float)extremum_of_displacement(x0, v0, x1, v1, STEP_Q27) / (float)ONE;

            worst = fmath_max(worst, fmath_abs(extreme - size));
            worst_raw = fmath_max(worst_raw, fmath_min(fmath_abs((float)x0 / (float)ONE - size),
                                                       fmath_abs((float)x1 / (float)ONE - size)));
        }
    }
    tap_check_close(worst / 3.0f, 0.0f, 1e-6f, "an extreme of 64 samples a turn is good to 1e-6");
    tap_check(worst_raw / 3.0f > 1e-3f, "where the samples themselves miss 1e-3");
    tap_check(extremum_of_displacement(5, 0, 5, 0, STEP_Q27) == 5, "two samples at rest are their own extreme");
    tap_check(extremum_of_displacement(INT32_MAX, INT32_MAX, INT32_MAX, -INT32_MAX, INT32_MAX) == INT32_MAX &&
                  extremum_of_displacement(-INT32_MAX, -INT32_MAX, -INT32_MAX, INT32_MAX, INT32_MAX) == -INT32_MAX,
              "what does not fit is held at the limit");
}

static int32_t parabola(int32_t top, int32_t bend, int32_t distance) { return top - bend * distance * distance; }

static void check_parabola(void)
{
    float worst = 0.0f;
    bool is_mirrored = true;

    /* The top lies shift/8 of a step beside the middle sample. */
    for (int32_t shift = -4; shift <= 4; shift++) {
        const int32_t top = 1000000000;
        const int32_t before = parabola(top, 100000, -8 - shift);
        const int32_t middle = parabola(top, 100000, -shift);
        const int32_t after = parabola(top, 100000, 8 - shift);
        const int32_t found = extremum_of_parabola(before, middle, after);

        worst = fmath_max(worst, fmath_abs((float)(found - top)));
        is_mirrored = is_mirrored && extremum_of_parabola(-before, -middle, -after) == -found;
    }
    tap_check_close(worst, 0.0f, 200.0f, "the top of a parabola, to 1e-4 of what is between the samples");
    tap_check(is_mirrored, "and its mirror image to the bit");
    tap_check(extremum_of_parabola(0, 10, 30) == 10, "three samples without a turn give the middle one");
    tap_check(extremum_of_parabola(7, 7, 7) == 7, "so do three equal ones");
    tap_check(extremum_of_parabola(INT32_MAX, -INT32_MAX, INT32_MAX) == -INT32_MAX &&
                  extremum_of_parabola(-INT32_MAX, INT32_MAX, INT32_MAX - 1) == INT32_MAX,
              "the widest swing fits and is held at the limit");
}

void test_extremum(void)
{
    check_ratio();
    check_displacement();
    check_parabola();
}
