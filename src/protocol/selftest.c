/* The tests in the order of enum test; those with a plant are spread over many slices. */
#include "protocol/selftest.h"

#include "base/assert.h"
#include "base/decimal.h"
#include "base/fmath.h"
#include "base/hash.h"
#include "model/presets.h"
#include "model/sine.h"

enum test {
    TEST_DECIMAL,
    TEST_NORMAL,
    TEST_EQUILIBRIUM,
    TEST_FORWARD,
    TEST_MIRROR,
    TEST_AGAIN,
    TEST_TICKS,
    TEST_COUNT
};

enum { PERIODS = 20, DIGITS = 3 };

/* RK4 at 64 steps a period turns the phase by 2 pi h^4/120 a period: 1e-4 of the amplitude after 20. */
#define NORMAL_TOLERANCE 2e-4f
#define EQUILIBRIUM_TOLERANCE 1e-6f

void selftest_start(struct selftest *selftest)
{
    selftest->test = 0u;
    selftest->is_set = false;
    selftest->passed = 0u;
    selftest->failed = 0u;
}

/* Nine digits carry any float through text: a sequence of bit patterns, printed and read back. */
static uint32_t decimal_failures(void)
{
    uint32_t bits = 1u;
    uint32_t failures = 0u;

    for (unsigned i = 0u; i < 64u; i++) {
        char number[DECIMAL_SIZE_MAX];
        float back = 0.0f;

        bits = bits * 1664525u + 1013904223u;
        if (fmath_is_finite(fmath_from_bits(bits))) {
            const size_t length = decimal_format_f32(fmath_from_bits(bits), DECIMAL_DIGITS_EXACT, number);

            failures += decimal_parse_f32(number, length, &back) && fmath_bits(back) == bits ? 0u : 1u;
        }
    }
    return failures;
}

/* What a test's plant is, on top of Table 1. The equilibrium is x = mu(v0) N / (k + kt), y = N / ke. */
static const char *assignments_of(enum test test)
{
    switch (test) {
    case TEST_EQUILIBRIUM:
        return "alpha 0 x0 0.15 y0 1";
    case TEST_FORWARD:
    case TEST_AGAIN:
        return "N0 10 alpha -0.02 x0 0.1";
    case TEST_MIRROR:
        return "N0 10 alpha -0.02 x0 -0.1 v0 -1";
    case TEST_DECIMAL:
    case TEST_NORMAL:
    case TEST_TICKS:
    case TEST_COUNT:
    default:
        return "";
    }
}

static void set_plant(struct selftest *selftest)
{
    const struct params_info *info;
    const char *bad;
    size_t bad_length;
    struct params params;
    enum error error;

    params_default(&params);
    error = presets_assign(&params, assignments_of((enum test)selftest->test), &info, &bad, &bad_length);
    BASE_ASSERT(error == ERROR_OK);
    error = sim_plan_make(&selftest->plan, &params, NULL).error;
    BASE_ASSERT(error == ERROR_OK);
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

/* How far the plant is from what it should be, relative to the brake force's or the friction force's deflection. */
static float deviation(const struct selftest *selftest)
{
    const struct sim *sim = &selftest->sim;
    const float n = sim->f32.normal.n;

    if (selftest->test == TEST_NORMAL) {
        const uint32_t grid = SINE_GRID / selftest->plan.scale.steps_per_period;

        return fmath_abs(sim->f32.normal.y / n - (1.0f - sine_cosine_f32((uint32_t)sim->step * grid)));
    }
    return fmath_abs(sim->f32.x * selftest->plan.scale.stiffness / (selftest->plan.scale.friction * n) - 1.0f);
}

/* Returns true when all steps of the test are made. */
static bool run_plant(struct selftest *selftest)
{
    const uint32_t steps = PERIODS * selftest->plan.scale.steps_per_period;

    for (unsigned i = 0u; i < SELFTEST_SLICE_STEPS && selftest->step < steps; i++) {
        (void)sim_step(&selftest->sim);
        selftest->step++;
        selftest->hash = hash_state(selftest->hash, &selftest->sim.f32, selftest->test == TEST_MIRROR);
        selftest->worst = fmath_max(selftest->worst, deviation(selftest));
    }
    return selftest->step == steps;
}

static void conclude(struct selftest *selftest, struct text *text, bool has_passed, const char *name)
{
    selftest->passed += has_passed ? 1u : 0u;
    selftest->failed += has_passed ? 0u : 1u;
    selftest->test++;
    selftest->is_set = false;
    text_write(text, has_passed ? "- pass " : "- fail ");
    text_write(text, name);
    text_put(text, ' ');
}

static void conclude_deviation(struct selftest *selftest, struct text *text, float tolerance, const char *name)
{
    /* A plant that has become NaN is never within tolerance: fmath_max lets it pass, the state does not. */
    const bool is_finite = fmath_is_finite(selftest->sim.f32.x) && fmath_is_finite(selftest->sim.f32.normal.y);

    conclude(selftest, text, is_finite && selftest->worst <= tolerance, name);
    text_write(text, "largest deviation ");
    text_f32(text, selftest->worst, DIGITS);
    text_write(text, ", allowed ");
    text_f32(text, tolerance, DIGITS);
    text_end_line(text);
}

static void conclude_hash(struct selftest *selftest, struct text *text, bool has_passed, const char *name)
{
    conclude(selftest, text, has_passed, name);
    text_write(text, "hash ");
    text_hex32(text, selftest->hash);
    text_write(text, ", expected ");
    text_hex32(text, selftest->hash_forward);
    text_end_line(text);
}

static void conclude_plant(struct selftest *selftest, struct text *text)
{
    switch ((enum test)selftest->test) {
    case TEST_NORMAL:
        conclude_deviation(selftest, text, NORMAL_TOLERANCE, "normal-oscillation");
        break;
    case TEST_EQUILIBRIUM:
        conclude_deviation(selftest, text, EQUILIBRIUM_TOLERANCE, "equilibrium-stays");
        break;
    case TEST_FORWARD:
        selftest->hash_forward = selftest->hash;
        selftest->hash_sim = selftest->sim.hash;
        conclude(selftest, text, selftest->sim.counters.events > 0u, "stick-slip");
        text_u64(text, selftest->sim.counters.events);
        text_write(text, " events located");
        text_end_line(text);
        break;
    case TEST_MIRROR:
        conclude_hash(selftest, text, selftest->hash == selftest->hash_forward, "mirror-symmetry");
        break;
    case TEST_AGAIN:
        conclude_hash(selftest, text,
                      selftest->hash == selftest->hash_forward && selftest->sim.hash == selftest->hash_sim,
                      "same-bits-again");
        break;
    case TEST_DECIMAL:
    case TEST_TICKS:
    case TEST_COUNT:
    default:
        break;
    }
}

static void conclude_decimal(struct selftest *selftest, struct text *text)
{
    const uint32_t failures = decimal_failures();

    conclude(selftest, text, failures == 0u, "decimal-round-trip");
    text_u64(text, failures);
    text_write(text, " floats came back changed");
    text_end_line(text);
}

static void conclude_ticks(struct selftest *selftest, struct text *text, uint32_t counted, uint32_t expected)
{
    const uint32_t apart = counted - expected + 1u; /* 0, 1, 2 for one less, equal, one more */

    conclude(selftest, text, apart <= 2u, "ticks");
    text_u64(text, counted);
    text_write(text, " counted, ");
    text_u64(text, expected);
    text_write(text, " expected by the other clock");
    text_end_line(text);
}

bool selftest_continue(struct selftest *selftest, struct text *text, uint32_t counted, uint32_t expected)
{
    if (selftest->test == TEST_DECIMAL) {
        conclude_decimal(selftest, text);
    } else if (selftest->test == TEST_TICKS) {
        conclude_ticks(selftest, text, counted, expected);
    } else if (!selftest->is_set) {
        set_plant(selftest);
    } else if (run_plant(selftest)) {
        conclude_plant(selftest, text);
    }
    return selftest->test == TEST_COUNT;
}
