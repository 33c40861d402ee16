/* Piecewise profiles, evaluated from the step's index alone. */
#include "sim/profile.h"

#include "base/fixed.h"
#include "base/fmath.h"
#include "sim/turns.h"

#define STEPS_MAX 4.0e9f /* later than this is never */

static float in_steps(float time_s, const struct scale *scale) { return fmath_min(time_s / scale->step_s, STEPS_MAX); }

static void set_times(struct profile *profile, float start_s, float end_s, const struct scale *scale)
{
    const float start = in_steps(start_s, scale);
    const float length = in_steps(end_s - start_s, scale);

    profile->start = (uint32_t)start;
    profile->start_fraction = start - (float)profile->start;
    profile->per_step = length > 0.0f ? 1.0f / length : 0.0f;
}

/* A ramp without length is a step. */
static void jump_if_sudden(struct profile *profile)
{
    if (profile->kind == DEMAND_RAMP && profile->per_step == 0.0f) {
        profile->kind = DEMAND_STEP;
    }
}

/* Leaves a value that is within them as it is, to the bit. */
static float limited(const struct profile *profile, float value)
{
    return value < profile->low ? profile->low : value > profile->high ? profile->high : value;
}

/* A ramp ends two steps late at most: rounding may make it a step longer than it is. */
static void set_end(struct profile *profile)
{
    const uint64_t start = profile->start;

    profile->last = limited(profile, profile->kind == DEMAND_CONSTANT ? profile->from : profile->to);
    switch (profile->kind) {
    case DEMAND_STEP:
        profile->end = start + 2u;
        break;
    case DEMAND_RAMP:
        profile->end = start + (uint32_t)fmath_min(1.0f / profile->per_step, STEPS_MAX) + 3u;
        break;
    case DEMAND_SINE:
        profile->end = UINT64_MAX;
        break;
    case DEMAND_CONSTANT:
    case DEMAND_PULSES:
    case DEMAND_TABLE:
    case DEMAND_INERTIA:
    default:
        profile->end = 0u;
        break;
    }
}

/* The last value itself where the share is whole: rounded by a bit it would be a change of the load later on. */
static float between(const struct profile *profile, float share)
{
    return share == 1.0f ? profile->to : profile->from + (profile->to - profile->from) * share;
}

/* How much of a change at t1 counts in this step, which is not before it. */
static float share_at(const struct profile *profile, uint64_t step)
{
    return step == profile->start ? profile->first : step == profile->start + 1u ? profile->second : 1.0f;
}

static void set_shares(struct profile *profile, bool is_shared)
{
    const float late = profile->start_fraction;

    profile->first = is_shared ? 0.5f * (2.0f - late) * (1.0f - late) : late < 0.5f ? 1.0f : 0.0f;
    profile->second = is_shared ? 0.5f * (2.0f - late) * (1.0f + late) : 1.0f;
}

/* The ends of a ramp may lie beyond the limits, and so may a sine. */
static void set_values(struct profile *profile, const struct demand *demand, float unit)
{
    const bool is_sine = profile->kind == DEMAND_SINE;
    const bool goes_on = profile->kind == DEMAND_RAMP || is_sine;

    profile->from = (goes_on ? demand->from + demand->offset : demand_begin(demand)) / unit;
    profile->to = (is_sine   ? demand->to
                   : goes_on ? demand->to + demand->offset
                             : demand_limit(demand, demand->to)) /
                  unit;
    profile->low = demand->low / unit;
    profile->high = demand->high / unit;
}

void profile_derive(struct profile *profile, const struct demand *demand, const struct scale *scale, float unit,
                    bool is_shared)
{
    profile->kind = demand->kind <= DEMAND_SINE ? demand->kind : DEMAND_CONSTANT;
    set_times(profile, demand->start_s, demand->end_s, scale);
    jump_if_sudden(profile);
    set_values(profile, demand, unit);
    set_shares(profile, is_shared);
    profile->turns_per_step = profile->kind == DEMAND_SINE ? turns_in_step(demand->frequency_hz * scale->step_s) : 0u;
    set_end(profile);
}

static float ramp_value(const struct profile *profile, uint64_t step)
{
    const uint64_t passed = step - profile->start;
    const float position = ((float)(uint32_t)passed + (0.5f - profile->start_fraction)) * profile->per_step;

    if (passed > (uint64_t)STEPS_MAX || position >= 1.0f) {
        return profile->to;
    }
    return position > 0.0f ? profile->from + (profile->to - profile->from) * position : profile->from;
}

/* The sine sets in as a step does, with what it is worth at that time. */
static float sine_value(const struct profile *profile, uint64_t step)
{
    const uint32_t turns = turns_at_middle(profile->turns_per_step, step);

    return profile->from + profile->to * fmath_sine_turns(turns) * share_at(profile, step);
}

float profile_moving_value(const struct profile *profile, uint64_t step)
{
    if (step < profile->start) {
        return limited(profile, profile->from);
    }
    switch (profile->kind) {
    case DEMAND_RAMP:
        return limited(profile, ramp_value(profile, step));
    case DEMAND_SINE:
        return limited(profile, sine_value(profile, step));
    case DEMAND_STEP:
        return between(profile, share_at(profile, step));
    case DEMAND_CONSTANT:
    case DEMAND_PULSES:
    case DEMAND_TABLE:
    case DEMAND_INERTIA:
    default:
        return profile->from;
    }
}

void profile_q27_derive(struct profile_q27 *derived, const struct profile *profile)
{
    const float per_step = fmath_min(profile->per_step, 2.0f);
    const float steps = per_step > 0.0f ? fmath_min(1.0f / per_step, STEPS_MAX) : 0.0f;
    const float place = (0.5f - profile->start_fraction) * profile->per_step;

    derived->kind = profile->kind;
    derived->from = fixed_from_float(profile->from, 27);
    derived->to = fixed_from_float(profile->to, 27);
    derived->low = fixed_from_float(profile->low, 27);
    derived->high = fixed_from_float(profile->high, 27);
    derived->first = fixed_from_float(profile->first, 30);
    derived->second = fixed_from_float(profile->second, 30);
    derived->start = profile->start;
    derived->length = (uint32_t)steps + 1u;
    derived->place = fixed_times_float(1, fmath_max(fmath_min(place, 1.0f), -1.0f), 60);
    derived->per_step = fixed_times_float(1, per_step, 60);
    derived->turns_per_step = profile->turns_per_step;
    derived->last = fixed_from_float(profile->last, 27);
    derived->end = profile->end;
}

/* A share of a value, Q30. */
static int32_t share_of(int64_t value, int32_t share) { return (int32_t)fixed_shift_right(value * share, 30u); }

static int32_t share_at_q27(const struct profile_q27 *profile, uint64_t step)
{
    return step == profile->start ? profile->first : step == profile->start + 1u ? profile->second : 1 << 30;
}

/* Within the ramp's length a place stays below 1 + 1 + 2, which Q60 holds. */
static int32_t ramp_value_q27(const struct profile_q27 *profile, uint64_t step)
{
    const uint64_t passed = step - profile->start;
    int64_t place;

    if (passed > profile->length) {
        return profile->to;
    }
    place = profile->place + (int64_t)passed * profile->per_step;
    if (place <= 0) {
        return profile->from;
    }
    if (place >= INT64_C(1) << 60) {
        return profile->to;
    }
    return profile->from + share_of((int64_t)profile->to - profile->from, (int32_t)fixed_floor(place, 30u));
}

static int32_t sine_value_q27(const struct profile_q27 *profile, uint64_t step)
{
    const uint32_t turns = turns_at_middle(profile->turns_per_step, step);
    const int32_t swing = share_of(profile->to, fmath_sine_turns_q30(turns));

    return profile->from + share_of(swing, share_at_q27(profile, step));
}

static int32_t limited_q27(const struct profile_q27 *profile, int32_t value)
{
    return value < profile->low ? profile->low : value > profile->high ? profile->high : value;
}

int32_t profile_q27_moving_value(const struct profile_q27 *profile, uint64_t step)
{
    if (step < profile->start) {
        return limited_q27(profile, profile->from);
    }
    switch (profile->kind) {
    case DEMAND_RAMP:
        return limited_q27(profile, ramp_value_q27(profile, step));
    case DEMAND_SINE:
        return limited_q27(profile, sine_value_q27(profile, step));
    case DEMAND_STEP:
        return profile->from + share_of((int64_t)profile->to - profile->from, share_at_q27(profile, step));
    case DEMAND_CONSTANT:
    case DEMAND_PULSES:
    case DEMAND_TABLE:
    case DEMAND_INERTIA:
    default:
        return profile->from;
    }
}
