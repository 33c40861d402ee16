/* Profile or curve, lag, inertia, dither. */
#include "sim/acting.h"

#include "base/fixed.h"
#include "base/fmath.h"
#include "sim/turns.h"

enum { FRACTION_BITS = 27, SUM_BITS = 56, FACTOR_BITS = 30, FACTOR_SHIFT_MAX = 90 };

#define ONE_Q27 (1 << FRACTION_BITS)
#define LAG_DONE 2.44140625e-4f /* 2^-12 of a unit */
#define LAGS_TO_SETTLE 9.0f     /* e^-9 is less than that */

/* --- Derived in main ---------------------------------------------------------------------------------------------- */

/* As many bits as fit; what is below 2^-90 is nothing. factor in 0 ... 1. */
static struct acting_factor factor_of(float factor)
{
    struct acting_factor result = {0, FACTOR_BITS};

    while (result.shift < FACTOR_SHIFT_MAX && fixed_times_float(1, factor, (int)result.shift + 1) < 1 << FACTOR_BITS) {
        result.shift++;
    }
    result.mantissa = fixed_from_float(factor, (int)result.shift);
    return result;
}

/* What pulses and tables lead to, in place of the profile's own end: the curve's, to the bit. */
static void end_by_curve(struct acting *acting)
{
    const struct curve *curve = &acting->curve;

    acting->end = curve->end;
    if (curve->end != UINT64_MAX) {
        acting->profile_q27.last = curve_value(curve, curve->end);
        acting->profile.last = (float)acting->profile_q27.last / (float)ONE_Q27;
    }
}

static void derive(struct acting *acting, const struct demand *demand, const struct scale *scale, float unit)
{
    const bool is_curve = demand->kind == DEMAND_PULSES || demand->kind == DEMAND_TABLE;
    const float lags = demand->lag_s > 0.0f ? scale->step_s / demand->lag_s : 0.0f;

    profile_derive(&acting->profile, demand, scale, unit, acting->is_force);
    profile_q27_derive(&acting->profile_q27, &acting->profile);
    curve_derive(&acting->curve, demand, scale, unit, acting->is_force);
    acting->kind = demand->kind;
    acting->begin = demand_begin(demand) / unit;
    acting->begin_q27 = fixed_from_float(acting->begin, FRACTION_BITS);
    acting->end = acting->profile.end;
    if (is_curve) {
        end_by_curve(acting);
    }
    acting->has_lag = demand->lag_s > 0.0f;
    acting->lag_half = fmath_decay(0.5f * lags);
    acting->lag_whole = fmath_decay(lags);
    acting->lag_half_q27 = factor_of(acting->lag_half);
    acting->lag_whole_q27 = factor_of(acting->lag_whole);
    acting->has_dither = demand->dither > 0.0f;
    acting->dither = demand->dither / unit;
    acting->dither_q27 = fixed_from_float(acting->dither, FRACTION_BITS);
    acting->dither_turns = turns_in_step(demand->dither_hz * scale->step_s);
    acting->has_state = acting->has_lag || acting->kind == DEMAND_INERTIA;
    acting->is_plain = !is_curve && !acting->has_state && !acting->has_dither;
    if (acting->has_state || acting->has_dither) {
        acting->end = UINT64_MAX;
    }
}

void acting_of_load(struct acting *acting, const struct params *params, const struct scale *scale)
{
    const struct demand demand = demand_of_load(params);

    acting->is_force = true;
    acting->slowing = 0.0f;
    acting->slowing_q27 = (struct acting_factor){0, FACTOR_BITS};
    derive(acting, &demand, scale, scale->load_n);
}

/* Of m v' = -pads m R^2/J F in the model's units, for one step. */
void acting_of_speed(struct acting *acting, const struct params *params, const struct scale *scale)
{
    const struct demand demand = demand_of_speed(params);

    acting->is_force = false;
    acting->slowing = demand.kind == DEMAND_INERTIA ? scale->step * demand_inertia_ratio(params) : 0.0f;
    acting->slowing_q27 = factor_of(acting->slowing);
    derive(acting, &demand, scale, scale->speed_m_per_s);
}

/* Of what is asked for. */
static uint64_t base_end(const struct acting *acting)
{
    return acting->kind == DEMAND_PULSES || acting->kind == DEMAND_TABLE ? acting->curve.end : acting->profile.end;
}

uint64_t acting_settled_step(const struct acting *acting, const struct params *params, const struct scale *scale)
{
    const struct demand demand = acting->is_force ? demand_of_load(params) : demand_of_speed(params);
    const uint64_t base = base_end(acting);
    const float wait_s = LAGS_TO_SETTLE * demand.lag_s + (acting->is_force ? 0.0f : demand_stop_s(params));
    const float wait = wait_s / scale->step_s;

    if (!(wait < 4294967040.0f)) {
        return UINT64_MAX;
    }
    return (base == UINT64_MAX ? 0u : base) + (uint32_t)wait;
}

/* --- What is asked for -------------------------------------------------------------------------------------------- */

static int32_t rounded(int64_t sum_q56) { return (int32_t)fixed_shift_right(sum_q56, SUM_BITS - FRACTION_BITS); }

static float demand_f32(const struct acting *acting, const struct acting_state *state, uint64_t step)
{
    switch (acting->kind) {
    case DEMAND_PULSES:
    case DEMAND_TABLE:
        return (float)curve_value(&acting->curve, step) * (1.0f / (float)ONE_Q27);
    case DEMAND_INERTIA:
        return state->inertia.value;
    case DEMAND_CONSTANT:
    case DEMAND_STEP:
    case DEMAND_RAMP:
    case DEMAND_SINE:
    default:
        return profile_value(&acting->profile, step);
    }
}

static int32_t demand_q27(const struct acting *acting, const struct acting_state *state, uint64_t step)
{
    switch (acting->kind) {
    case DEMAND_PULSES:
    case DEMAND_TABLE:
        return curve_value(&acting->curve, step);
    case DEMAND_INERTIA:
        return rounded(state->inertia.value_q56);
    case DEMAND_CONSTANT:
    case DEMAND_STEP:
    case DEMAND_RAMP:
    case DEMAND_SINE:
    default:
        return profile_q27_value(&acting->profile_q27, step);
    }
}

/* --- What becomes of it ------------------------------------------------------------------------------------------- */

/* Up to 2^32 times 2^30, by 2^1 to 2^61. */
static int64_t times_q56(int64_t value_q27, const struct acting_factor *factor)
{
    return fixed_shift_right(value_q27 * factor->mantissa, FRACTION_BITS + factor->shift - SUM_BITS);
}

/* A value as a sum, and back. */
static int64_t sum_of(int32_t value_q27) { return (int64_t)value_q27 * (INT64_C(1) << (SUM_BITS - FRACTION_BITS)); }

void acting_reset(struct acting_state *state, const struct acting *acting)
{
    *state = (struct acting_state){0};
    state->lag.value = acting->begin;
    state->lag.value_q56 = sum_of(acting->begin_q27);
    if (acting->kind == DEMAND_INERTIA) {
        state->inertia = state->lag;
    }
}

float acting_base_f32(const struct acting *acting, const struct acting_state *state, uint64_t step)
{
    const float value = demand_f32(acting, state, step);

    return acting->has_lag ? state->lag.value + acting->lag_half * (value - state->lag.value) : value;
}

int32_t acting_base_q27(const struct acting *acting, const struct acting_state *state, uint64_t step)
{
    const int32_t value = demand_q27(acting, state, step);
    int64_t way;

    if (!acting->has_lag) {
        return value;
    }
    way = (int64_t)value - rounded(state->lag.value_q56);
    return rounded(state->lag.value_q56 + times_q56(way, &acting->lag_half_q27));
}

float acting_moving_f32(const struct acting *acting, const struct acting_state *state, uint64_t step)
{
    float value = acting_base_f32(acting, state, step);

    if (acting->has_dither) {
        value += acting->dither * fmath_sine_turns(turns_at_middle(acting->dither_turns, step));
        value = acting->is_force ? fmath_max(value, 0.0f) : value;
    }
    return value;
}

int32_t acting_moving_q27(const struct acting *acting, const struct acting_state *state, uint64_t step)
{
    int32_t value = acting_base_q27(acting, state, step);

    if (acting->has_dither) {
        const int32_t sine = fmath_sine_turns_q30(turns_at_middle(acting->dither_turns, step));

        value += fixed_product(acting->dither_q27, sine, 30u);
        value = acting->is_force && value < 0 ? 0 : value;
    }
    return value;
}

/* A disc that stands, or would turn round within the step, stands; one that the pad pushes is not pushed beyond the
 * scale. */
static void slow_down_f32(struct acting_sum *sum, float loss)
{
    const float before = sum->value;

    sum->value = fmath_add_kept(before, -loss, &sum->rest);
    if (before * sum->value <= 0.0f) {
        sum->value = 0.0f;
        sum->rest = 0.0f;
    } else if (fmath_abs(sum->value) > 1.0f) {
        sum->value = sum->value > 0.0f ? 1.0f : -1.0f;
        sum->rest = 0.0f;
    }
}

static void slow_down_q27(struct acting_sum *sum, int64_t loss)
{
    const int64_t one = INT64_C(1) << SUM_BITS;
    const int64_t before = sum->value_q56;
    const int64_t after = before - loss;

    if (before == 0 || (before > 0) != (after > 0)) {
        sum->value_q56 = 0;
    } else {
        sum->value_q56 = after > one ? one : after < -one ? -one : after;
    }
}

void acting_advance_f32(const struct acting *acting, struct acting_state *state, uint64_t step, float friction)
{
    if (acting->has_lag) {
        const float way = demand_f32(acting, state, step) - state->lag.value;

        state->lag.value = fmath_add_kept(state->lag.value, acting->lag_whole * way, &state->lag.rest);
    }
    if (acting->kind == DEMAND_INERTIA) {
        slow_down_f32(&state->inertia, acting->slowing * friction);
    }
}

void acting_advance_q27(const struct acting *acting, struct acting_state *state, uint64_t step, int32_t friction)
{
    if (acting->has_lag) {
        const int64_t way = (int64_t)demand_q27(acting, state, step) - rounded(state->lag.value_q56);

        state->lag.value_q56 += times_q56(way, &acting->lag_whole_q27);
    }
    if (acting->kind == DEMAND_INERTIA) {
        slow_down_q27(&state->inertia, times_q56(friction, &acting->slowing_q27));
    }
}

void acting_take_f32(struct acting_state *state, float value)
{
    state->lag = (struct acting_sum){.value = value};
    state->inertia = state->lag;
}

void acting_take_q27(struct acting_state *state, int32_t value)
{
    state->lag = (struct acting_sum){.value_q56 = sum_of(value)};
    state->inertia = state->lag;
}

static bool lags_behind(const struct acting *acting, const struct acting_state *state, uint64_t step, bool is_q27)
{
    const float way = is_q27 ? (float)(demand_q27(acting, state, step) - rounded(state->lag.value_q56)) / (float)ONE_Q27
                             : demand_f32(acting, state, step) - state->lag.value;

    return acting->has_lag && fmath_abs(way) > LAG_DONE;
}

bool acting_is_steady(const struct acting *acting, const struct acting_state *state, uint64_t step, bool is_q27)
{
    const bool stands = is_q27 ? state->inertia.value_q56 == 0 : state->inertia.value == 0.0f;

    return step >= base_end(acting) && !acting->has_dither && (acting->kind != DEMAND_INERTIA || stands) &&
           !lags_behind(acting, state, step, is_q27);
}
