/* Piecewise profiles, evaluated from the step's index alone. */
#include "sim/profile.h"

#include "base/fixed.h"
#include "base/fmath.h"

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
    if (profile->kind == PROFILE_RAMP && profile->per_step == 0.0f) {
        profile->kind = PROFILE_STEP;
    }
}

/* A ramp ends two steps late at most: rounding may make it a step longer than it is. */
static void set_end(struct profile *profile)
{
    const uint64_t start = profile->start;

    profile->last = profile->kind == PROFILE_CONSTANT ? profile->from : profile->to;
    switch (profile->kind) {
    case PROFILE_STEP:
        profile->end = start + 2u;
        break;
    case PROFILE_RAMP:
        profile->end = start + (uint32_t)fmath_min(1.0f / profile->per_step, STEPS_MAX) + 3u;
        break;
    case PROFILE_SINE:
        profile->end = UINT64_MAX;
        break;
    case PROFILE_CONSTANT:
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

void profile_load(struct profile *profile, const struct params *params, const struct scale *scale)
{
    float late;

    profile->kind = (enum profile_kind)(int)params->load_profile;
    profile->from = params->load_n / scale->load_n;
    profile->to = params->load_end_n / scale->load_n;
    set_times(profile, params->load_start_s, params->load_end_s, scale);
    jump_if_sudden(profile);
    late = profile->start_fraction;
    profile->first = 0.5f * (2.0f - late) * (1.0f - late);
    profile->second = 0.5f * (2.0f - late) * (1.0f + late);
    if (profile->kind == PROFILE_SINE) {
        const float turns = params->load_frequency_hz * scale->step_s;
        const uint32_t whole = (uint32_t)turns;
        const float scaled = (turns - (float)whole) * 4294967296.0f; /* in 2^-32 turns, exact but for its own bits */
        const uint32_t high = (uint32_t)scaled;

        profile->turns_per_step = ((uint64_t)high << 32) | (uint32_t)((scaled - (float)high) * 4294967296.0f);
    }
    set_end(profile);
}

void profile_speed(struct profile *profile, const struct params *params, const struct scale *scale)
{
    profile->kind = (enum profile_kind)(int)params->speed_profile;
    profile->from = params->speed_m_per_s / scale->speed_m_per_s;
    profile->to = params->speed_end_m_per_s / scale->speed_m_per_s;
    set_times(profile, params->speed_start_s, params->speed_end_s, scale);
    jump_if_sudden(profile);
    profile->first = profile->start_fraction < 0.5f ? 1.0f : 0.0f;
    profile->second = 1.0f;
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
    const uint64_t turns = step * profile->turns_per_step + (profile->turns_per_step >> 1);

    return profile->from + profile->to * fmath_sine_turns((uint32_t)(turns >> 32)) * share_at(profile, step);
}

float profile_moving_value(const struct profile *profile, uint64_t step)
{
    if (step < profile->start) {
        return profile->from;
    }
    switch (profile->kind) {
    case PROFILE_RAMP:
        return ramp_value(profile, step);
    case PROFILE_SINE:
        return sine_value(profile, step);
    case PROFILE_STEP:
        return between(profile, share_at(profile, step));
    case PROFILE_CONSTANT:
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
    const uint64_t turns = step * profile->turns_per_step + (profile->turns_per_step >> 1);
    const int32_t swing = share_of(profile->to, fmath_sine_turns_q30((uint32_t)(turns >> 32)));

    return profile->from + share_of(swing, share_at_q27(profile, step));
}

int32_t profile_q27_moving_value(const struct profile_q27 *profile, uint64_t step)
{
    if (step < profile->start) {
        return profile->from;
    }
    switch (profile->kind) {
    case PROFILE_RAMP:
        return ramp_value_q27(profile, step);
    case PROFILE_SINE:
        return sine_value_q27(profile, step);
    case PROFILE_STEP:
        return profile->from + share_of((int64_t)profile->to - profile->from, share_at_q27(profile, step));
    case PROFILE_CONSTANT:
    default:
        return profile->from;
    }
}
