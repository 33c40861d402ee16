/* The acting process of a set, read out of its parameters. */
#include "model/demand.h"

#include "base/fmath.h"

#define NO_LIMIT 1e10f

/* How the parameters of the two are called in a refusal. */
struct symbols {
    const char *kind, *end, *high, *every;
};

static const struct symbols load_symbols = {"load", "t2", "N_high", "every"};
static const struct symbols speed_symbols = {"speed", "tv2", "v_high", "v_every"};

static const struct params_problem no_problem = {ERROR_OK, NULL, 0.0f, 0.0f};

struct demand demand_of_load(const struct params *params)
{
    return (struct demand){.kind = (enum demand_kind)(int)params->load_profile,
                           .from = params->load_n,
                           .to = params->load_end_n,
                           .start_s = params->load_start_s,
                           .end_s = params->load_end_s,
                           .frequency_hz = params->load_frequency_hz,
                           .rise_s = params->load_rise_s,
                           .hold_s = params->load_hold_s,
                           .fall_s = params->load_fall_s,
                           .every_s = params->load_every_s,
                           .offset = params->load_offset_n,
                           .low = params->load_low_n,
                           .high = params->load_high_n,
                           .lag_s = params->load_lag_s,
                           .dither = params->load_dither_n,
                           .dither_hz = params->load_dither_hz,
                           .table = &params->tables[PARAMS_TABLE_LOAD]};
}

struct demand demand_of_speed(const struct params *params)
{
    return (struct demand){.kind = (enum demand_kind)(int)params->speed_profile,
                           .from = params->speed_m_per_s,
                           .to = params->speed_end_m_per_s,
                           .start_s = params->speed_start_s,
                           .end_s = params->speed_end_s,
                           .frequency_hz = params->speed_frequency_hz,
                           .rise_s = params->speed_rise_s,
                           .hold_s = params->speed_hold_s,
                           .fall_s = params->speed_fall_s,
                           .every_s = params->speed_every_s,
                           .offset = params->speed_offset_m_per_s,
                           .low = params->speed_low_m_per_s,
                           .high = params->speed_high_m_per_s,
                           .lag_s = params->speed_lag_s,
                           .dither = params->speed_dither_m_per_s,
                           .dither_hz = params->speed_dither_hz,
                           .table = &params->tables[PARAMS_TABLE_SPEED]};
}

float demand_limit(const struct demand *demand, float base)
{
    const float value = base + demand->offset;

    return value < demand->low ? demand->low : value > demand->high ? demand->high : value;
}

static float first_base(const struct demand *demand)
{
    return demand->kind == DEMAND_TABLE ? demand->table->points[0].value : demand->from;
}

static float last_base(const struct demand *demand)
{
    switch (demand->kind) {
    case DEMAND_STEP:
    case DEMAND_RAMP:
    case DEMAND_PULSES:
        return demand->to;
    case DEMAND_TABLE:
        return demand->table->points[demand->table->count - 1u].value;
    case DEMAND_INERTIA:
        return 0.0f;
    case DEMAND_CONSTANT:
    case DEMAND_SINE:
    default:
        return demand->from;
    }
}

float demand_begin(const struct demand *demand) { return demand_limit(demand, first_base(demand)); }

float demand_end(const struct demand *demand)
{
    return demand->kind == DEMAND_INERTIA ? 0.0f : demand_limit(demand, last_base(demand));
}

float demand_load_end_n(const struct params *params)
{
    const struct demand load = demand_of_load(params);

    return demand_end(&load);
}

float demand_speed_end_m_per_s(const struct params *params)
{
    const struct demand speed = demand_of_speed(params);
    const bool is_braked = demand_load_end_n(params) > 0.0f && params->friction_static_ratio > 0.0f;

    return speed.kind == DEMAND_INERTIA && !is_braked ? demand_begin(&speed) : demand_end(&speed);
}

/* Least and largest value of the base. */
static void base_span(const struct demand *demand, float *low, float *high)
{
    *low = fmath_min(first_base(demand), last_base(demand));
    *high = fmath_max(first_base(demand), last_base(demand));
    if (demand->kind == DEMAND_SINE) {
        *low -= fmath_abs(demand->to);
        *high += fmath_abs(demand->to);
    }
    for (uint32_t i = 0u; demand->kind == DEMAND_TABLE && i < demand->table->count; i++) {
        *low = fmath_min(*low, demand->table->points[i].value);
        *high = fmath_max(*high, demand->table->points[i].value);
    }
}

float demand_peak(const struct demand *demand)
{
    float low;
    float high;

    if (demand->kind == DEMAND_INERTIA) {
        return fmath_abs(demand_begin(demand)) + demand->dither;
    }
    base_span(demand, &low, &high);
    return fmath_max(fmath_abs(demand_limit(demand, low)), fmath_abs(demand_limit(demand, high))) + demand->dither;
}

float demand_reach(const struct demand *demand)
{
    const bool is_line = demand->kind == DEMAND_RAMP || demand->kind == DEMAND_SINE || demand->kind == DEMAND_PULSES ||
                         demand->kind == DEMAND_TABLE;
    float low;
    float high;

    base_span(demand, &low, &high);
    return is_line ? fmath_max(fmath_abs(low + demand->offset), fmath_abs(high + demand->offset)) : 0.0f;
}

float demand_inertia_ratio(const struct params *params)
{
    return params->pads * params->mass_kg * (params->radius_m * params->radius_m / params->inertia_kg_m2);
}

float demand_stop_s(const struct params *params)
{
    const struct demand speed = demand_of_speed(params);
    const float force_n = 0.5f * params->pads * params->friction_static_ratio * demand_load_end_n(params);
    const float mass_kg = params->inertia_kg_m2 / (params->radius_m * params->radius_m);

    return speed.kind == DEMAND_INERTIA && force_n > 0.0f ? mass_kg * fmath_abs(demand_begin(&speed)) / force_n : 0.0f;
}

void demand_hold_load(struct params *params, float force_n)
{
    params->load_profile = (float)LOAD_CONSTANT;
    params->load_n = force_n;
    params->load_offset_n = 0.0f;
    params->load_low_n = 0.0f;
    params->load_high_n = NO_LIMIT;
    params->load_lag_s = 0.0f;
    params->load_dither_n = 0.0f;
}

void demand_hold_speed(struct params *params, float speed_m_per_s)
{
    params->speed_profile = (float)SPEED_CONSTANT;
    params->speed_m_per_s = speed_m_per_s;
    params->speed_offset_m_per_s = 0.0f;
    params->speed_low_m_per_s = -NO_LIMIT;
    params->speed_high_m_per_s = NO_LIMIT;
    params->speed_lag_s = 0.0f;
    params->speed_dither_m_per_s = 0.0f;
}

static struct params_problem check_one(const struct demand *demand, const struct symbols *symbols)
{
    const float pulse_s = demand->rise_s + demand->hold_s + demand->fall_s;

    if (demand->kind == DEMAND_RAMP && demand->end_s < demand->start_s) {
        return params_blame(ERROR_OUT_OF_RANGE, symbols->end, demand->start_s, PARAMS_TIME_MAX);
    }
    if (demand->kind == DEMAND_PULSES && demand->every_s > 0.0f && demand->every_s < pulse_s) {
        return params_blame(ERROR_OUT_OF_RANGE, symbols->every, pulse_s, PARAMS_TIME_MAX);
    }
    if (demand->kind == DEMAND_TABLE && demand->table->count == 0u) {
        return params_blame(ERROR_NO_TABLE, symbols->kind, 0.0f, 0.0f);
    }
    if (demand->high < demand->low) {
        return params_blame(ERROR_OUT_OF_RANGE, symbols->high, demand->low, NO_LIMIT);
    }
    return no_problem;
}

struct params_problem demand_check(const struct params *params)
{
    const struct demand load = demand_of_load(params);
    const struct demand speed = demand_of_speed(params);
    struct params_problem problem = check_one(&load, &load_symbols);

    if (problem.error == ERROR_OK) {
        problem = check_one(&speed, &speed_symbols);
    }
    if (problem.error == ERROR_OK && speed.kind == DEMAND_INERTIA && demand_inertia_ratio(params) > 1.0f) {
        /* A disc lighter than its pads would have to be integrated with them. */
        problem = params_blame(ERROR_OUT_OF_RANGE, "J", params->inertia_kg_m2 * demand_inertia_ratio(params), 1e9f);
    }
    return problem;
}
