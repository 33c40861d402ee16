/* The plants of the self-tests: each is set, stepped a slice at a time and compared with what it should be. */
#include "base/assert.h"
#include "base/fixed.h"
#include "base/fmath.h"
#include "base/hash.h"
#include "model/presets.h"
#include "model/sine.h"
#include "protocol/selftest_parts.h"

enum { PERIODS = 20 };

/* What a test's plant is, on top of Table 1. The equilibrium is x = mu(v0) N / (k + kt), y = N / ke. */
static const char *assignments_of(enum selftest_test test)
{
    switch (test) {
    case SELFTEST_EQUILIBRIUM:
        return "alpha 0 x0 0.15 y0 1";
    case SELFTEST_FORWARD:
    case SELFTEST_AGAIN:
        return "N0 10 alpha -0.02 x0 0.1";
    case SELFTEST_MIRROR:
        return "N0 10 alpha -0.02 x0 -0.1 v0 -1";
    case SELFTEST_FORCED_F32:
        return "spp 256 normal exact";
    case SELFTEST_FORCED_Q27:
        return "spp 256 normal exact arith q27";
    case SELFTEST_DECIMAL:
    case SELFTEST_NORMAL:
    case SELFTEST_TICKS:
    case SELFTEST_COUNT:
    default:
        return "";
    }
}

static void make_plan(struct selftest *selftest, const struct params *params)
{
    const enum error error = sim_plan_make(&selftest->plan, params, NULL).error;

    BASE_ASSERT(error == ERROR_OK);
}

/* Puts the pad onto the orbit that it is to follow: from rest the transient would be most of the motion. */
static void start_on_orbit(struct selftest *selftest, struct params *params)
{
    const struct scale *scale = &selftest->plan.scale;
    struct perturbation_state start;

    perturbation_derive(&selftest->orbit, params, scale, PERTURBATION_CORRECTED, PERTURBATION_ORDER_MAX);
    start = perturbation_forced(&selftest->orbit, 0u);
    params->x_initial_m = start.x * scale->length_m;
    params->xd_initial_m_per_s = start.v * scale->speed_m_per_s;
    make_plan(selftest, params);
}

static bool is_forced(unsigned test) { return test == SELFTEST_FORCED_F32 || test == SELFTEST_FORCED_Q27; }

void selftest_set_plant(struct selftest *selftest)
{
    const struct params_info *info;
    const char *bad;
    size_t bad_length;
    struct params params;
    enum error error;

    params_default(&params);
    error = presets_assign(&params, assignments_of((enum selftest_test)selftest->test), &info, &bad, &bad_length);
    BASE_ASSERT(error == ERROR_OK);
    make_plan(selftest, &params);
    if (is_forced(selftest->test)) {
        start_on_orbit(selftest, &params);
    }
    sim_reset(&selftest->sim, &selftest->plan);
    selftest->step = 0u;
    selftest->worst = 0.0f;
    selftest->hash = HASH_INIT;
    selftest->is_set = true;
}

/* Hashes a state as seen in a mirror or not. 0 is added so that -0 counts as 0. */
static uint32_t hash_state(uint32_t hash, const struct step_f32 *state, bool is_mirrored)
{
    const float sign = is_mirrored ? -1.0f : 1.0f;

    hash = hash_word(hash, fmath_bits(sign * state->x + 0.0f));
    hash = hash_word(hash, fmath_bits(sign * state->v + 0.0f));
    hash = hash_word(hash, fmath_bits(state->normal.y + 0.0f));
    return hash_word(hash, (uint32_t)(is_mirrored ? -state->mode : state->mode));
}

/* Of the normal direction from the cosine, over the brake force's deflection. */
static float normal_deviation(const struct sim *sim, const struct scale *scale)
{
    const uint32_t turns = (uint32_t)sim->step * (SINE_GRID / scale->steps_per_period);

    return fmath_abs(sim->f32.normal.y / sim->f32.normal.n - (1.0f - sine_cosine_f32(turns)));
}

/* Of the pad from where friction holds it, over that. */
static float equilibrium_deviation(const struct sim *sim, const struct scale *scale)
{
    return fmath_abs(sim->f32.x * scale->stiffness / (scale->friction * sim->f32.normal.n) - 1.0f);
}

/* Of the pad from the analytic solution, over its amplitude; as either arithmetic gives it out. */
static float forced_deviation(const struct selftest *selftest)
{
    const struct sim *sim = &selftest->sim;
    const uint32_t step_turns = 0x80000000u / selftest->plan.scale.steps_per_period * 2u; /* a power of two */
    const float unit = (float)(1u << selftest->plan.scale.length_shift) / (float)(1u << PLANT_FRACTION_BITS);
    const float x = (float)sim_output(sim)->x * unit;

    return fmath_abs(x - perturbation_forced(&selftest->orbit, (uint32_t)sim->step * step_turns).x) /
           fmath_sqrt(complex32_square(selftest->orbit.harmonic[0]));
}

/* How far the plant is from what it should be. */
static float deviation(const struct selftest *selftest)
{
    const struct scale *scale = &selftest->plan.scale;

    if (is_forced(selftest->test)) {
        return forced_deviation(selftest);
    }
    return selftest->test == SELFTEST_NORMAL ? normal_deviation(&selftest->sim, scale)
                                             : equilibrium_deviation(&selftest->sim, scale);
}

bool selftest_run_plant(struct selftest *selftest)
{
    const uint32_t steps = PERIODS * selftest->plan.scale.steps_per_period;

    for (unsigned i = 0u; i < SELFTEST_SLICE_STEPS && selftest->step < steps; i++) {
        (void)sim_step(&selftest->sim);
        selftest->step++;
        selftest->hash = hash_state(selftest->hash, &selftest->sim.f32, selftest->test == SELFTEST_MIRROR);
        selftest->worst = fmath_max(selftest->worst, deviation(selftest));
    }
    return selftest->step == steps;
}
