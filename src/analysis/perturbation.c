#include "analysis/perturbation.h"

#include "base/fmath.h"
#include "model/demand.h"

#define TURN 4294967296.0f
#define LOG2_E 1.44269504f

/* Response to exp(i k tau) of x'' + d x' + Z2 x. */
static struct complex32 response(float stiffness, float damping, unsigned k)
{
    const float order = (float)k;

    return complex32_inverse((struct complex32){stiffness - order * order, order * damping});
}

/* The print's arctg, which does not see the sign of Z2 - k^2: half a turn off where that is negative. */
static struct complex32 response_printed(float stiffness, float damping, unsigned k)
{
    const struct complex32 right = response(stiffness, damping, k);

    return stiffness < (float)(k * k) ? complex32_scaled(right, -1.0f) : right;
}

bool perturbation_is_served(const struct params *params, const struct scale *scale)
{
    const struct demand load = demand_of_load(params);
    const struct demand speed = demand_of_speed(params);

    return load.kind == DEMAND_CONSTANT && load.dither == 0.0f && speed.kind == DEMAND_CONSTANT &&
           speed.dither == 0.0f && demand_end(&load) == load.from && demand_end(&speed) == speed.from &&
           params->y_initial_m == 0.0f && params->yd_initial_m_per_s == 0.0f && params->speed_m_per_s != 0.0f &&
           scale->normal_damping == 0.0f && scale->stiffness > 0.0f && !scale->has_floor;
}

/* One by one, what multiplies exp(i k tau); order n brings in harmonic n + 1. */
struct terms {
    struct complex32 first, second, third, back; /* H1; H1 H2; H1 H2 H3; the order-2 part at tau itself */
    float drift;                                 /* mean of order 1 */
};

static struct terms corrected_terms(float stiffness, float damping)
{
    const struct complex32 h1 = response(stiffness, damping, 1u);
    const struct complex32 h12 = complex32_times(h1, response(stiffness, damping, 2u));

    return (struct terms){.first = h1,
                          .second = h12,
                          .third = complex32_times(h12, response(stiffness, damping, 3u)),
                          .back = complex32_times(h12, h1),
                          .drift = h1.im / stiffness};
}

static struct terms printed_terms(float stiffness, float damping)
{
    const struct complex32 h1 = response_printed(stiffness, damping, 1u);
    const struct complex32 h12 = complex32_times(h1, response_printed(stiffness, damping, 2u));
    const struct complex32 turned =
        complex32_scaled(h1, 1.0f / fmath_sqrt(complex32_square(h1))); /* by phi_0 once more */

    return (struct terms){.first = h1,
                          .second = h12,
                          .third =
                              complex32_times(complex32_times(h12, response_printed(stiffness, damping, 3u)), turned),
                          .back = complex32_times(h12, h1),
                          .drift = h1.im / stiffness};
}

/* sin is Re(-i exp). */
static struct complex32 as_sine(struct complex32 a) { return (struct complex32){a.im, -a.re}; }

/* Under 1 - cos: cos times the speed of what is there drives the next order. */
static void put_cosine(struct perturbation *solution, const struct terms *terms, float force, float slope,
                       unsigned order)
{
    solution->mean = force / solution->stiffness + (order >= 1u ? 0.5f * slope * force * terms->drift : 0.0f);
    solution->harmonic[0] = complex32_scaled(terms->first, -force);
    if (order >= 1u) {
        solution->harmonic[1] = complex32_scaled(as_sine(terms->second), 0.5f * slope * force);
    }
    if (order >= 2u) {
        const float size = 0.5f * slope * slope * force;

        solution->harmonic[2] = complex32_scaled(terms->third, size);
        solution->harmonic[0] = complex32_plus(solution->harmonic[0], complex32_scaled(terms->back, size));
    }
}

/* Under 1 - sin, as printed. */
static void put_sine(struct perturbation *solution, const struct terms *terms, float force, float slope, unsigned order)
{
    solution->mean = force / solution->stiffness + (order >= 1u ? 0.5f * slope * force * terms->drift : 0.0f);
    solution->harmonic[0] = complex32_scaled(as_sine(terms->first), -force);
    if (order >= 1u) {
        solution->harmonic[1] = complex32_scaled(as_sine(terms->second), -0.5f * slope * force);
    }
    if (order >= 2u) {
        const float size = 0.5f * slope * slope * force;

        solution->harmonic[2] = complex32_scaled(as_sine(terms->third), -size);
        solution->harmonic[0] = complex32_plus(solution->harmonic[0], complex32_scaled(as_sine(terms->back), size));
    }
}

void perturbation_derive(struct perturbation *solution, const struct params *params, const struct scale *scale,
                         enum perturbation_form form, unsigned order)
{
    const float load = params->load_n / scale->load_n;
    const float slope = scale->friction_slope * load;
    const float disc = params->speed_m_per_s / scale->speed_m_per_s;
    const float force =
        (scale->friction + scale->friction_slope * fmath_abs(disc)) * load * (disc < 0.0f ? -1.0f : 1.0f);
    const bool is_corrected = form == PERTURBATION_CORRECTED;
    struct terms terms;

    *solution =
        (struct perturbation){.damping = scale->damping + (is_corrected ? slope : 0.0f), .stiffness = scale->stiffness};
    terms = is_corrected ? corrected_terms(solution->stiffness, solution->damping)
                         : printed_terms(solution->stiffness, solution->damping);
    if (form == PERTURBATION_PRINTED) {
        put_sine(solution, &terms, force, slope, order);
    } else {
        put_cosine(solution, &terms, force, slope, order);
    }
}

struct perturbation_state perturbation_forced(const struct perturbation *solution, uint32_t turns)
{
    struct perturbation_state state = {solution->mean, 0.0f};

    for (unsigned k = 1u; k <= PERTURBATION_HARMONICS; k++) {
        const struct complex32 *part = &solution->harmonic[k - 1u];
        const float sine = fmath_sine_turns(k * turns);
        const float cosine = fmath_sine_turns(k * turns + (1u << 30));

        state.x += part->re * cosine - part->im * sine;
        state.v -= (float)k * (part->re * sine + part->im * cosine);
    }
    return state;
}

/* The fraction of a count of turns, not negative. */
static uint32_t fraction_of(float turns)
{
    const float fraction = turns - (float)(uint32_t)turns;

    return (uint32_t)(fraction * (TURN - 256.0f));
}

struct perturbation_state perturbation_from(const struct perturbation *solution, struct perturbation_state start,
                                            float periods)
{
    const struct perturbation_state forced = perturbation_forced(solution, fraction_of(periods));
    const struct perturbation_state first = perturbation_forced(solution, 0u);
    const float half = 0.5f * solution->damping;
    const float frequency = fmath_sqrt(solution->stiffness - half * half);
    const float cosine_part = start.x - first.x;
    const float sine_part = (start.v - first.v + half * cosine_part) / frequency;
    const uint32_t turns = fraction_of(frequency * periods);
    const float sine = fmath_sine_turns(turns);
    const float cosine = fmath_sine_turns(turns + (1u << 30));
    const float left = fmath_exp2(-half * LOG2_E * 2.0f * FMATH_PI * periods);
    const float x = left * (cosine_part * cosine + sine_part * sine);
    const float v = left * frequency * (sine_part * cosine - cosine_part * sine);

    return (struct perturbation_state){forced.x + x, forced.v + v - half * x};
}

float perturbation_speed(const struct perturbation *solution)
{
    enum { PARTS = 256 };
    float largest = 0.0f;

    for (uint32_t i = 0u; i < PARTS; i++) {
        largest = fmath_max(largest, fmath_abs(perturbation_forced(solution, i << 24).v));
    }
    return largest;
}
