/* Samples as SI text. */
#include "protocol/signals.h"

#include "base/fmath.h"
#include "bench.h"
#include "model/params.h"
#include "sim/watch.h"
#include "tap.h"
#include "tests.h"

static struct text text;
static uint8_t storage[64];
static char out[65];

static const char *written(enum signal signal, const struct sample *sample, const struct scale *scale)
{
    size_t size;
    const uint8_t *bytes;

    text_init(&text, storage, sizeof storage);
    signals_append(&text, signal, sample, scale);
    bytes = text_peek(&text, &size);
    for (size_t i = 0u; i < size; i++) {
        out[i] = (char)bytes[i];
    }
    out[size] = '\0';
    return out;
}

/* Units with which every value is told from every other. */
static const struct scale scale = {.omega_rad_per_s = 2.0f,
                                   .speed_m_per_s = 3.0f,
                                   .length_m = 5.0f,
                                   .load_n = 7.0f,
                                   .normal_m = 11.0f,
                                   .force_n = 13.0f,
                                   .step_s = 0.25f};

static const struct sample sample = {.step = 10u,
                                     .x = 0x3f800000u,        /* 1 */
                                     .v = 0x40000000u,        /* 2 */
                                     .y = 0xc0400000u,        /* -3 */
                                     .w = 0x40800000u,        /* 4 */
                                     .load = 0x40a00000u,     /* 5 */
                                     .disc = 0x40c00000u,     /* 6 */
                                     .friction = 0xc0e00000u, /* -7 */
                                     .mode = -1,
                                     .propensity = PROPENSITY_SQUEAL,
                                     .watch = WATCH_SAFE,
                                     .hash = 0xbeefu};

static void check_values(void)
{
    static const char *const expected[SIGNAL_COUNT] = {"10",  "2.5",        "5",        "6",     "-33",    "88",
                                                       "35",  "-91",        "12",       "slip-", "squeal", "18",
                                                       "-21", "4.33333349", "0000beef", "safe"};

    struct scale no_pull = scale;
    struct scale lift = scale;

    for (unsigned i = 0u; i < SIGNAL_COUNT; i++) {
        tap_check_text(written((enum signal)i, &sample, &scale), expected[i], signals_table[i].name);
    }
    no_pull.contact = CONTACT_NO_PULL;
    tap_check_text(written(SIGNAL_P, &sample, &no_pull), "0", "contact that cannot pull does not");
    lift.contact = CONTACT_LIFT;
    tap_check_text(written(SIGNAL_MU, &sample, &lift), "nan", "friction over no force is no number");
}

/* The same values in Q4.27, where x counts units of 2^length_shift. */
static void check_integers(void)
{
    struct sample other = sample;
    struct scale soft = scale;

    other.arithmetic = ARITH_Q27;
    other.x = 1u << 25;
    other.v = 2u << 27;
    other.y = (uint32_t) - (3 << 27);
    other.w = 4u << 27;
    other.load = 5u << 27;
    other.disc = 6u << 27;
    other.friction = (uint32_t) - (7 << 27);
    soft.length_shift = 2u;
    for (unsigned i = SIGNAL_X; i <= SIGNAL_VR; i++) {
        char expected[32];
        size_t size = 0u;

        for (const char *c = written((enum signal)i, &sample, &scale); *c != '\0'; c++) {
            expected[size++] = *c;
        }
        expected[size] = '\0';
        tap_check_text(written((enum signal)i, &other, &soft), expected, signals_table[i].name);
    }
}

static void check_modes(void)
{
    struct sample other = sample;

    other.mode = 0;
    tap_check_text(written(SIGNAL_MODE, &other, &scale), "stick", "stick");
    other.mode = 1;
    tap_check_text(written(SIGNAL_MODE, &other, &scale), "slip+", "slip+");
    other.is_fault = 1u;
    tap_check_text(written(SIGNAL_MODE, &other, &scale), "fault", "fault");
    other.x = 0x7f800000u;
    tap_check_text(written(SIGNAL_X, &other, &scale), "nan", "an infinity is no number");
}

static void check_names(void)
{
    bool ok = true;

    for (unsigned i = 0u; i < SIGNAL_COUNT; i++) {
        size_t length = 0u;

        while (signals_table[i].name[length] != '\0') {
            length++;
        }
        ok = ok && signals_find(signals_table[i].name, length) == (enum signal)i;
        ok = ok && signals_find(signals_table[i].name, length + 1u) == SIGNAL_COUNT;
    }
    tap_check(ok, "every signal is found by its name, and by nothing longer");
    tap_check(signals_find("v", 1u) == SIGNAL_COUNT && signals_find("", 0u) == SIGNAL_COUNT, "nor by less");
}

/* The line load relies on it. */
static void check_widths(void)
{
    uint32_t random = 12345u;
    const unsigned rounds = tap_is_hosted() ? 20000u : 300u;
    bool ok = true;

    for (unsigned i = 0u; i < rounds && ok; i++) {
        struct sample any = {.step = ((uint64_t)tap_random(&random) << 32) | tap_random(&random),
                             .x = tap_random(&random),
                             .v = tap_random(&random),
                             .y = fmath_bits(-1.23456789e-5f),
                             .w = tap_random(&random),
                             .load = fmath_bits(-1.23456789e-5f),
                             .disc = tap_random(&random),
                             .friction = tap_random(&random),
                             .mode = (int8_t)(i % 3u) - 1,
                             .propensity = (uint8_t)(i % 4u),
                             .watch = (uint8_t)(i / 4u % 4u),
                             .hash = tap_random(&random)};
        static const struct scale units = {.omega_rad_per_s = 1.0f,
                                           .speed_m_per_s = 1.0f,
                                           .length_m = 1.0f,
                                           .load_n = 1.0f,
                                           .normal_m = 1.0f,
                                           .force_n = 1.0f,
                                           .step_s = 1.23456789e-9f};

        any.step >>= i % 64u;
        for (unsigned signal = 0u; signal < SIGNAL_COUNT; signal++) {
            (void)written((enum signal)signal, &any, &units);
            ok = ok && text.head <= signals_table[signal].width;
        }
    }
    tap_check(ok, "no text is longer than its width");
}

void test_signals(void)
{
    check_values();
    check_integers();
    check_modes();
    check_names();
    check_widths();
}
