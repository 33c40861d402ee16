/* The grid of a map. */
#include "sim/scan.h"

#include "base/fmath.h"

enum error scan_axis_check(const struct scan_axis *axis)
{
    if (!params_accepts(axis->info, axis->from) || !params_accepts(axis->info, axis->to)) {
        return ERROR_OUT_OF_RANGE;
    }
    if (axis->is_log && !(axis->from > 0.0f && axis->to > 0.0f) && !(axis->from < 0.0f && axis->to < 0.0f)) {
        return ERROR_USAGE;
    }
    return ERROR_OK;
}

float scan_axis_value(const struct scan_axis *axis, uint32_t place)
{
    float share;
    float value;

    if (place == 0u || axis->points < 2u) {
        return axis->from;
    }
    if (place >= axis->points - 1u) {
        return axis->to;
    }
    share = (float)place / (float)(axis->points - 1u);
    if (axis->is_log) {
        /* In two halves, neither of which leaves the numbers: the ends may be further apart than single precision is
         * wide. */
        const float half =
            fmath_exp2(0.5f * share * (fmath_log2(fmath_abs(axis->to)) - fmath_log2(fmath_abs(axis->from))));

        value = axis->from * half * half;
    } else {
        value = axis->from + (axis->to - axis->from) * share;
    }
    return params_is_whole(axis->info) ? (float)fmath_round_i32(value) : value;
}

uint32_t scan_points(const struct scan *scan)
{
    uint32_t points = 1u;

    for (uint32_t i = 0u; i < scan->axis_count; i++) {
        points *= scan->axes[i].points;
    }
    return points;
}

uint32_t scan_place(const struct scan *scan, uint32_t point, uint32_t axis)
{
    if (axis >= scan->axis_count) {
        return 0u;
    }
    return axis == 0u ? point % scan->axes[0].points : point / scan->axes[0].points;
}

void scan_params(const struct scan *scan, uint32_t point, struct params *params)
{
    *params = scan->base;
    for (uint32_t i = 0u; i < scan->axis_count; i++) {
        params_set(params, scan->axes[i].info, scan_axis_value(&scan->axes[i], scan_place(scan, point, i)));
    }
}
