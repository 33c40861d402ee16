/* The tests in the order of their table; those with a plant are spread over many slices. */
#include "protocol/selftest.h"

#include "base/assert.h"
#include "base/compiler.h"
#include "base/decimal.h"
#include "base/fmath.h"
#include "base/hash.h"
#include "model/presets.h"
#include "model/sine.h"

const struct selftest_info selftest_table[SELFTEST_COUNT] = {
#define SELFTEST(number, field, name, help) {name, help},
#include "protocol/selftest.def"
#undef SELFTEST
};

#define SELFTEST(number, field, name, help) \
    BASE_STATIC_ASSERT((number) == (int)SELFTEST_##field && (number) < 32, selftest_##number##_is_a_bit);
#include "protocol/selftest.def"
#undef SELFTEST

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
    selftest->failures = 0u;
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
    case SELFTEST_DECIMAL:
    case SELFTEST_NORMAL:
    case SELFTEST_TICKS:
    case SELFTEST_COUNT:
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
    error = presets_assign(&params, assignments_of((enum selftest_test)selftest->test), &info, &bad, &bad_length);
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

    if (selftest->test == SELFTEST_NORMAL) {
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
        selftest->hash = hash_state(selftest->hash, &selftest->sim.f32, selftest->test == SELFTEST_MIRROR);
        selftest->worst = fmath_max(selftest->worst, deviation(selftest));
    }
    return selftest->step == steps;
}

static bool conclude(struct selftest *selftest, bool has_passed)
{
    selftest->passed += has_passed ? 1u : 0u;
    selftest->failed += has_passed ? 0u : 1u;
    selftest->failures |= has_passed ? 0u : 1u << selftest->test;
    selftest->test++;
    selftest->is_set = false;
    return true;
}

static bool conclude_deviation(struct selftest *selftest, float allowed)
{
    /* A plant that has become NaN is never within tolerance: fmath_max lets it pass, the state does not. */
    const bool is_finite = fmath_is_finite(selftest->sim.f32.x) && fmath_is_finite(selftest->sim.f32.normal.y);

    selftest->allowed = allowed;
    return conclude(selftest, is_finite && selftest->worst <= allowed);
}

static bool conclude_forward(struct selftest *selftest)
{
    selftest->hash_forward = selftest->hash;
    selftest->hash_sim = selftest->sim.hash;
    selftest->counted = selftest->sim.counters.events;
    return conclude(selftest, selftest->counted > 0u);
}

static bool conclude_decimal(struct selftest *selftest)
{
    selftest->counted = decimal_failures();
    return conclude(selftest, selftest->counted == 0u);
}

static bool conclude_ticks(struct selftest *selftest, uint32_t counted, uint32_t expected)
{
    const uint32_t apart = counted - expected + 1u; /* 0, 1, 2 for one less, equal, one more */

    selftest->counted = counted;
    selftest->expected = expected;
    return conclude(selftest, apart <= 2u);
}

/* All steps of the test are made. */
static bool conclude_plant(struct selftest *selftest)
{
    switch ((enum selftest_test)selftest->test) {
    case SELFTEST_NORMAL:
        return conclude_deviation(selftest, NORMAL_TOLERANCE);
    case SELFTEST_EQUILIBRIUM:
        return conclude_deviation(selftest, EQUILIBRIUM_TOLERANCE);
    case SELFTEST_FORWARD:
        return conclude_forward(selftest);
    case SELFTEST_MIRROR:
        return conclude(selftest, selftest->hash == selftest->hash_forward);
    case SELFTEST_AGAIN:
        return conclude(selftest, selftest->hash == selftest->hash_forward && selftest->sim.hash == selftest->hash_sim);
    case SELFTEST_DECIMAL:
    case SELFTEST_TICKS:
    case SELFTEST_COUNT:
    default:
        return conclude(selftest, false);
    }
}

bool selftest_go_on(struct selftest *selftest, uint32_t ticks_counted, uint32_t ticks_expected)
{
    if (selftest->test == SELFTEST_DECIMAL) {
        return conclude_decimal(selftest);
    }
    if (selftest->test == SELFTEST_TICKS) {
        return conclude_ticks(selftest, ticks_counted, ticks_expected);
    }
    if (!selftest->is_set) {
        set_plant(selftest);
        return false;
    }
    return run_plant(selftest) && conclude_plant(selftest);
}

bool selftest_is_done(const struct selftest *selftest) { return selftest->test == SELFTEST_COUNT; }

static void write_hashes(struct text *text, const struct selftest *selftest)
{
    text_write(text, "hash ");
    text_hex32(text, selftest->hash);
    text_write(text, ", expected ");
    text_hex32(text, selftest->hash_forward);
}

static void write_deviation(struct text *text, const struct selftest *selftest)
{
    text_write(text, "largest deviation ");
    text_f32(text, selftest->worst, DIGITS);
    text_write(text, ", allowed ");
    text_f32(text, selftest->allowed, DIGITS);
}

static void write_ticks(struct text *text, const struct selftest *selftest)
{
    text_u64(text, selftest->counted);
    text_write(text, " counted, ");
    text_u64(text, selftest->expected);
    text_write(text, " expected by the other clock");
}

void selftest_write(struct text *text, const struct selftest *selftest)
{
    const unsigned test = selftest->test - 1u;

    text_write(text, (selftest->failures >> test & 1u) != 0u ? "fail " : "pass ");
    text_write(text, selftest_table[test].name);
    text_put(text, ' ');
    switch ((enum selftest_test)test) {
    case SELFTEST_DECIMAL:
        text_u64(text, selftest->counted);
        text_write(text, " floats came back changed");
        break;
    case SELFTEST_NORMAL:
    case SELFTEST_EQUILIBRIUM:
        write_deviation(text, selftest);
        break;
    case SELFTEST_FORWARD:
        text_u64(text, selftest->counted);
        text_write(text, " events located");
        break;
    case SELFTEST_MIRROR:
    case SELFTEST_AGAIN:
        write_hashes(text, selftest);
        break;
    case SELFTEST_TICKS:
        write_ticks(text, selftest);
        break;
    case SELFTEST_COUNT:
    default:
        break;
    }
}
