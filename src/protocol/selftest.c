/* The tests in the order of their table; those with a plant are spread over many slices. */
#include "base/assert.h"
#include "base/decimal.h"
#include "base/fmath.h"
#include "protocol/selftest_parts.h"

const struct selftest_info selftest_table[SELFTEST_COUNT] = {
#define SELFTEST(number, field, name, help) {name, help},
#include "protocol/selftest.def"
#undef SELFTEST
};

#define SELFTEST(number, field, name, help) \
    BASE_STATIC_ASSERT((number) == (int)SELFTEST_##field && (number) < 32, selftest_##number##_is_a_bit);
#include "protocol/selftest.def"
#undef SELFTEST

enum { DIGITS = 3 };

/* RK4 at 64 steps a period turns the phase by 2 pi h^4/120 a period: 1e-4 of the amplitude after 20. */
#define NORMAL_TOLERANCE 2e-4f
#define EQUILIBRIUM_TOLERANCE 1e-6f
#define FORCED_TOLERANCE 1e-5f

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
    /* A plant that has become NaN is never within tolerance: fmath_max lets it pass, the fault does not. */
    const bool is_sound = selftest->sim.fault == SIM_FAULT_NONE;

    selftest->allowed = allowed;
    return conclude(selftest, is_sound && selftest->worst <= allowed);
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
    case SELFTEST_FORCED_F32:
    case SELFTEST_FORCED_Q27:
        return conclude_deviation(selftest, FORCED_TOLERANCE);
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
        selftest_set_plant(selftest);
        return false;
    }
    return selftest_run_plant(selftest) && conclude_plant(selftest);
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
    case SELFTEST_FORCED_F32:
    case SELFTEST_FORCED_Q27:
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
