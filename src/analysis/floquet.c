#include "analysis/floquet.h"

#include "base/fmath.h"

enum { STEPS = 256 }; /* a period */

#define LN_2 0.693147181f

struct disturbance {
    float x, v;
};

/* turns: of the normal oscillation. */
static struct disturbance slope_at(const struct floquet_problem *problem, uint32_t turns, struct disturbance at)
{
    const float cosine = fmath_sine_turns(turns + (1u << 30));
    const float damping = problem->damping + problem->slope * (1.0f - problem->share * cosine);

    return (struct disturbance){at.v, -damping * at.v - problem->stiffness * at.x};
}

static struct disturbance moved(struct disturbance from, struct disturbance slope, float time)
{
    return (struct disturbance){from.x + time * slope.x, from.v + time * slope.v};
}

static struct disturbance over_one_period(const struct floquet_problem *problem, struct disturbance at)
{
    const float step = 2.0f * FMATH_PI / (float)STEPS;
    const uint32_t turns_per_step = (uint32_t)(0x100000000u / STEPS);
    struct disturbance rest = {0.0f, 0.0f};

    for (uint32_t i = 0u; i < STEPS; i++) {
        const uint32_t turns = i * turns_per_step;
        const struct disturbance k1 = slope_at(problem, turns, at);
        const struct disturbance k2 = slope_at(problem, turns + turns_per_step / 2u, moved(at, k1, 0.5f * step));
        const struct disturbance k3 = slope_at(problem, turns + turns_per_step / 2u, moved(at, k2, 0.5f * step));
        const struct disturbance k4 = slope_at(problem, turns + turns_per_step, moved(at, k3, step));

        at.x = fmath_add_kept(at.x, step / 6.0f * (k1.x + 2.0f * (k2.x + k3.x) + k4.x), &rest.x);
        at.v = fmath_add_kept(at.v, step / 6.0f * (k1.v + 2.0f * (k2.v + k3.v) + k4.v), &rest.v);
    }
    return at;
}

/* The larger multiplier's modulus, from trace and determinant of the map. The determinant is known exactly from
 * Liouville: what friction and damping take from the area in a period. */
static float largest_multiplier(float trace, float determinant)
{
    const float half = 0.5f * trace;
    const float inside = half * half - determinant;

    return inside > 0.0f ? fmath_abs(half) + fmath_sqrt(inside) : fmath_sqrt(determinant);
}

float floquet_rate(const struct floquet_problem *problem)
{
    const struct disturbance first = over_one_period(problem, (struct disturbance){1.0f, 0.0f});
    const struct disturbance second = over_one_period(problem, (struct disturbance){0.0f, 1.0f});
    const float period = 2.0f * FMATH_PI;
    const float determinant = fmath_exp2(-(problem->damping + problem->slope) * period / LN_2);

    return fmath_log2(largest_multiplier(first.x + second.v, determinant)) * LN_2 / period;
}

float floquet_rate_closed(const struct floquet_problem *problem)
{
    const float detuning = fmath_sqrt(problem->stiffness) - 0.5f;
    const float pump = problem->share * problem->slope * 0.25f;
    const float inside = pump * pump - detuning * detuning;

    return -0.5f * (problem->damping + problem->slope) + (inside > 0.0f ? fmath_sqrt(inside) : 0.0f);
}
