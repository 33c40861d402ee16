/* Straight lines, evaluated from the step's index alone. */
#include "sim/curve.h"

#include "base/fixed.h"
#include "base/fmath.h"
#include "sim/turns.h"

#define STEP (UINT64_C(1) << CURVE_TIME_BITS)
#define STEPS_MAX 2147483648.0f /* 2^31: a time beyond it never comes */
#define TWO_TO_62 4611686018427387904.0f

enum { PULSE_POINTS = 4, NEAR_BELOW = 3, NEAR_ABOVE = 4 };

static uint64_t time_of(float time_s, const struct scale *scale)
{
    return (uint64_t)fixed_times_float(1, fmath_min(time_s / scale->step_s, STEPS_MAX), CURVE_TIME_BITS);
}

static void add_point(struct curve *curve, uint64_t at, float value)
{
    curve->at[curve->count] = at;
    curve->value[curve->count] = fixed_from_float(value, 27);
    curve->inverse[curve->count] = 0u;
    curve->count++;
}

/* A way in 32 bits, the first of which is set. */
static uint32_t normalised(uint64_t way, unsigned bits)
{
    return bits > 32u ? (uint32_t)(way >> (bits - 32u)) : (uint32_t)(way << (32u - bits));
}

static void derive_ways(struct curve *curve, bool has_sharing)
{
    curve->has_shared_jumps = false;
    for (uint32_t i = 0u; i + 1u < curve->count; i++) {
        const uint64_t way = curve->at[i + 1u] - curve->at[i];

        if (way != 0u) {
            curve->inverse[i] = (uint32_t)(TWO_TO_62 / (float)normalised(way, fixed_bits(way)));
        } else {
            curve->has_shared_jumps = has_sharing;
        }
    }
}

static void derive_pulses(struct curve *curve, const struct demand *demand, const struct scale *scale, float unit)
{
    const float from = (demand->from + demand->offset) / unit;
    const float to = (demand->to + demand->offset) / unit;
    const bool comes_again = demand->every_s > 0.0f && demand->every_s / scale->step_s < STEPS_MAX;
    const float turns = comes_again ? scale->step_s / demand->every_s : 0.0f;
    const uint64_t rise = time_of(demand->rise_s, scale);
    const uint64_t hold = time_of(demand->hold_s, scale);

    curve->start = time_of(demand->start_s, scale);
    add_point(curve, 0u, from);
    add_point(curve, rise, to);
    add_point(curve, rise + hold, to);
    add_point(curve, rise + hold + time_of(demand->fall_s, scale), from);
    curve->turns_per_step = turns_in_step(turns);
    if (curve->turns_per_step != 0u) {
        curve->period = time_of(demand->every_s, scale);
        curve->start_turns = turns_in_time(curve->turns_per_step, curve->start);
    }
}

void curve_derive(struct curve *curve, const struct demand *demand, const struct scale *scale, float unit,
                  bool has_sharing)
{
    *curve = (struct curve){.low = fixed_from_float(demand->low / unit, 27),
                            .high = fixed_from_float(demand->high / unit, 27)};
    if (demand->kind == DEMAND_PULSES) {
        derive_pulses(curve, demand, scale, unit);
    }
    for (uint32_t i = 0u; demand->kind == DEMAND_TABLE && i < demand->table->count; i++) {
        const struct params_point *point = &demand->table->points[i];

        add_point(curve, time_of(point->time_s, scale), (point->value + demand->offset) / unit);
    }
    derive_ways(curve, has_sharing);
    curve->end = UINT64_MAX;
    if (curve->period == 0u && curve->count > 0u) {
        const uint64_t last = curve->start + curve->at[curve->count - 1u];

        curve->end = curve->count > 1u ? (last >> CURVE_TIME_BITS) + 3u : 0u;
    }
}

static int32_t limited(const struct curve *curve, int32_t value)
{
    return value < curve->low ? curve->low : value > curve->high ? curve->high : value;
}

/* How many points are not after this time. */
static uint32_t points_until(const struct curve *curve, uint64_t time)
{
    uint32_t low = 0u;
    uint32_t high = curve->count;

    while (low < high) {
        const uint32_t middle = (low + high) / 2u;

        if (curve->at[middle] <= time) {
            low = middle + 1u;
        } else {
            high = middle;
        }
    }
    return low;
}

/* On the line that leaves the last of so many points. */
static int32_t line_value(const struct curve *curve, uint32_t passed, uint64_t time)
{
    const uint32_t i = passed > 0u ? passed - 1u : 0u;
    int64_t change;
    unsigned bits;
    uint64_t share;

    if (passed == 0u || passed == curve->count) {
        return limited(curve, curve->value[i]);
    }
    bits = fixed_bits(curve->at[passed] - curve->at[i]);
    share = (uint64_t)normalised(time - curve->at[i], bits) * curve->inverse[i] >> 32;
    change = ((int64_t)curve->value[passed] - curve->value[i]) * (int64_t)share;
    return limited(curve, (int32_t)(curve->value[i] + fixed_shift_right(change, 30u)));
}

/* A jump that comes `late` after the beginning of the step, -1 to 1 steps in Q30: what the step has of it beyond the
 * value at its middle, in Q30. */
static int64_t share_of_jump(int64_t late)
{
    const int64_t one = INT64_C(1) << 30;
    const int64_t into = late >= 0 ? late : late + one; /* the step in which it comes, or the one before */
    const int64_t share = (2 * one - into) * (late >= 0 ? one - into : one + into);

    return fixed_shift_right(share, 31u) - (2 * late > one ? 0 : one);
}

/* Way from the step's begin to a point; with a period, to the nearest of its like. */
static int64_t distance(const struct curve *curve, uint64_t point, uint64_t time)
{
    const int64_t way = (int64_t)(point - time);

    if (curve->period == 0u || (way < (int64_t)(curve->period / 2u) && way >= -(int64_t)(curve->period / 2u))) {
        return way;
    }
    return way > 0 ? way - (int64_t)curve->period : way + (int64_t)curve->period;
}

static int32_t jumps_nearby(const struct curve *curve, uint32_t passed, uint64_t time)
{
    const uint32_t first = passed > NEAR_BELOW ? passed - NEAR_BELOW : 1u;
    int32_t sum = 0;

    for (uint32_t i = first; i < curve->count && i < passed + NEAR_ABOVE; i++) {
        const int64_t late = distance(curve, curve->at[i], time);

        if (curve->at[i] == curve->at[i - 1u] && late < (int64_t)STEP && late >= -(int64_t)STEP) {
            const int64_t jump = (int64_t)limited(curve, curve->value[i]) - limited(curve, curve->value[i - 1u]);

            sum += (int32_t)fixed_shift_right(jump * share_of_jump(late), 30u);
        }
    }
    return sum;
}

/* Time since the first point at the beginning of a step, or since that of this period. False: nothing has begun. */
static bool place_of(const struct curve *curve, uint64_t step, uint64_t *time)
{
    const bool is_far = step >= UINT64_C(1) << (63 - CURVE_TIME_BITS);
    const uint64_t now = step << CURVE_TIME_BITS;

    if (!is_far && now + STEP <= curve->start) {
        return false;
    }
    *time = curve->period != 0u ? turns_part(step * curve->turns_per_step - curve->start_turns, curve->period)
            : is_far            ? UINT64_MAX / 2u
                                : now - curve->start;
    return true;
}

int32_t curve_value(const struct curve *curve, uint64_t step)
{
    uint64_t time = 0u;
    uint64_t middle;
    uint32_t passed;
    int32_t value;

    if (!place_of(curve, step, &time)) {
        return limited(curve, curve->value[0]);
    }
    middle = time + STEP / 2u;
    middle -= curve->period != 0u && middle >= curve->period ? curve->period : 0u;
    passed = points_until(curve, middle);
    value = line_value(curve, passed, middle);
    return curve->has_shared_jumps ? value + jumps_nearby(curve, passed, time) : value;
}
