/* A driver, a vehicle, a score. */
#include "stop.h"

#include "base/fmath.h"
#include "sim/detector.h"

struct stop_settings stop_usual(float speed_m_per_s)
{
    return (struct stop_settings){
        .speed_m_per_s = speed_m_per_s,
        .mass_kg = 400.0f,
        .faces = 2.0f,
        .demand_pa = 13e5f,
        .apply_s = 0.1f,
        .limit_s = 10.0f,
    };
}

struct stop stop_start(const struct stop_settings *settings, const struct brake *brake)
{
    return (struct stop){.speed_m_per_s = settings->speed_m_per_s, .friction_ratio = brake->friction_ratio};
}

float stop_time_s(const struct stop *stop, const struct brake *brake)
{
    return (float)stop->turns * brake_turn_s(brake);
}

float stop_demand_pa(const struct stop_settings *settings, const struct stop *stop, const struct brake *brake)
{
    const float time_s = stop_time_s(stop, brake);

    return time_s < settings->apply_s ? settings->demand_pa * (time_s / settings->apply_s) : settings->demand_pa;
}

struct stop stop_next(const struct stop_settings *settings, const struct stop *now, const struct brake *brake,
                      const struct master_state *state)
{
    const float turn_s = brake_turn_s(brake);
    const float demand_n = stop_demand_pa(settings, now, brake) * brake->piston_area_m2;
    const float lever_ratio = brake->radius_m / brake->tyre_radius_m;
    struct stop next = *now;

    next.turns++;
    next.loud_turns += state->propensity == PROPENSITY_SQUEAL ? 1u : 0u;
    if (state->load_n > 0.0f) {
        next.friction_ratio = state->friction_n / state->load_n;
    }
    next.kept_n_s += state->friction_n * turn_s;
    next.demanded_n_s += next.friction_ratio * demand_n * turn_s;
    next.speed_m_per_s -= settings->faces * state->friction_n * lever_ratio / settings->mass_kg * turn_s;
    next.speed_m_per_s = fmath_max(next.speed_m_per_s, 0.0f);
    return next;
}

bool stop_is_over(const struct stop_settings *settings, const struct stop *stop, const struct brake *brake)
{
    return !(stop->speed_m_per_s > 0.0f) || stop_time_s(stop, brake) >= settings->limit_s;
}

static float ratio(float part, float whole) { return whole > 0.0f ? part / whole : 0.0f; }

float stop_kept_ratio(const struct stop *stop) { return ratio(stop->kept_n_s, stop->demanded_n_s); }

float stop_squeal_ratio(const struct stop *stop) { return ratio((float)stop->loud_turns, (float)stop->turns); }

float stop_amplitude_m(const struct brake *brake, const struct master_state *state)
{
    const float stiffness_n_per_m = brake->contact_n_per_m + brake->caliper_n_per_m;
    const float away_m = state->x_m - state->friction_n / stiffness_n_per_m;
    const float omega_squared = stiffness_n_per_m / brake->pad_kg;

    return fmath_sqrt(away_m * away_m + state->xd_m_per_s * state->xd_m_per_s / omega_squared);
}
