/* The grid of a map. */
#include "sim/scan.h"

#include "base/fmath.h"
#include "plants.h"
#include "tap.h"
#include "tests.h"

static struct scan_axis axis_of(const char *symbol, float from, float to, uint32_t points, bool is_log)
{
    size_t length = 0u;

    while (symbol[length] != '\0') {
        length++;
    }
    return (struct scan_axis){params_find(symbol, length), from, to, points, is_log};
}

static void check_axis(void)
{
    const struct scan_axis linear = axis_of("N0", 1.0f, 4.0f, 4u, false);
    const struct scan_axis ratio = axis_of("alpha", -0.1f, -0.001f, 3u, true);
    const struct scan_axis whole = axis_of("substeps", 1.0f, 64.0f, 5u, true);
    const struct scan_axis one = axis_of("v0", 2.0f, 3.0f, 1u, false);
    bool is_whole = true;

    tap_check(scan_axis_value(&linear, 0u) == 1.0f && scan_axis_value(&linear, 3u) == 4.0f, "both ends are met");
    tap_check_close(scan_axis_value(&linear, 1u), 2.0f, 1e-6f, "equal steps between");
    tap_check(scan_axis_value(&ratio, 0u) == -0.1f && scan_axis_value(&ratio, 2u) == -0.001f,
              "both ends of ratios, also below 0");
    tap_check_close(scan_axis_value(&ratio, 1u), -0.01f, 1e-8f, "equal ratios between");
    for (uint32_t i = 0u; i < 5u; i++) {
        const float value = scan_axis_value(&whole, i);

        is_whole = is_whole && value == (float)(uint32_t)value;
    }
    tap_check(is_whole && scan_axis_value(&whole, 2u) == 8.0f, "a count stays a whole number");
    tap_check(scan_axis_value(&one, 0u) == 2.0f, "one point is the first value");
}

/* Ends as far apart as the numbers are. */
static void check_extremes(void)
{
    const struct scan_axis wide = axis_of("N0", 1e-30f, 1e9f, 4u, true);
    const struct scan_axis down = axis_of("yd0", 1e6f, 1e-38f, 128u, true);
    const struct scan_axis below = axis_of("mu_floor", -1e30f, -1e-20f, 256u, true);
    bool is_falling = true;
    bool is_rising = true;

    tap_check_close(scan_axis_value(&wide, 1u) * 1e17f, 1.0f, 1e-5f, "a third of 39 decades");
    tap_check_close(scan_axis_value(&wide, 2u) * 1e4f, 1.0f, 1e-5f, "two thirds");
    for (uint32_t i = 1u; i < 128u; i++) {
        is_falling = is_falling && scan_axis_value(&down, i) < scan_axis_value(&down, i - 1u);
    }
    for (uint32_t i = 1u; i < 256u; i++) {
        is_rising = is_rising && scan_axis_value(&below, i) > scan_axis_value(&below, i - 1u);
    }
    tap_check(is_falling && is_rising, "over all numbers, in order and inside the ends");
}

static void check_refusals(void)
{
    const struct scan_axis good = axis_of("alpha", -0.1f, -0.001f, 3u, true);
    const struct scan_axis across = axis_of("alpha", -0.1f, 0.1f, 3u, true);
    const struct scan_axis zero = axis_of("N0", 0.0f, 1.0f, 3u, true);
    const struct scan_axis outside = axis_of("N0", 1.0f, 2e9f, 3u, false);
    const struct scan_axis below = axis_of("m", 0.0f, 1.0f, 3u, false);
    const struct scan_axis part = axis_of("substeps", 1.5f, 8.0f, 3u, false);

    tap_check(scan_axis_check(&good) == ERROR_OK, "an axis that can be had");
    tap_check(scan_axis_check(&across) == ERROR_USAGE && scan_axis_check(&zero) == ERROR_USAGE,
              "no ratio across or from 0");
    tap_check(scan_axis_check(&outside) == ERROR_OUT_OF_RANGE && scan_axis_check(&below) == ERROR_OUT_OF_RANGE &&
                  scan_axis_check(&part) == ERROR_OUT_OF_RANGE,
              "no end outside the parameter's range, nor half a count");
}

static void check_grid(void)
{
    struct scan scan = {.base = plants_params("mu_s 0.25"), .axis_count = 2u};
    struct params params;

    scan.axes[0] = axis_of("N0", 1.0f, 3.0f, 3u, false);
    scan.axes[1] = axis_of("spp", 0.0f, 1.0f, 2u, false);
    tap_check(scan_points(&scan) == 6u, "a grid has the product of its points");
    tap_check(scan_place(&scan, 4u, 0u) == 1u && scan_place(&scan, 4u, 1u) == 1u, "the first axis runs fastest");
    scan_params(&scan, 4u, &params);
    tap_check(params.load_n == 2.0f && params.steps_per_period == 1.0f && params.friction_static_ratio == 0.25f,
              "a point is the base with two values changed");
    scan.axis_count = 1u;
    tap_check(scan_points(&scan) == 3u && scan_place(&scan, 2u, 1u) == 0u, "one axis is a row");
}

void test_scan(void)
{
    check_axis();
    check_extremes();
    check_refusals();
    check_grid();
}
