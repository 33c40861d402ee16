/* The host as a platform of the unit tests, and the tests that need what a board has not: a C library to compare with,
 * double precision, and signals that interrupt at any instruction. */
#define _XOPEN_SOURCE 600

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/time.h>

#include "base/assert.h"
#include "base/decimal.h"
#include "base/fmath.h"
#include "base/handoff.h"
#include "base/ring.h"
#include "tap.h"

void tap_write(const char *text)
{
    (void)fputs(text, stdout);
    (void)fflush(stdout);
}

void base_assert_failed(const char *file, unsigned line)
{
    printf("Bail out! %s:%u: assertion failed\n", file, line);
    exit(1);
}

/* --- decimal against the C library ----------------------------------------------------------------------------------
 */

static bool reads_like_strtof(const char *text)
{
    const float expected = strtof(text, NULL);
    float value = 0.0f;
    const bool is_read = decimal_parse_f32(text, strlen(text), &value);
    const bool ok = is_read == fmath_is_finite(expected) && (!is_read || fmath_bits(value) == fmath_bits(expected));

    if (!ok) {
        tap_note(text);
        tap_note_bits("strtof", fmath_bits(expected));
        tap_note_bits("here", fmath_bits(value));
    }
    return ok;
}

/* Random digits of random length with a point anywhere and an exponent that often leaves the range of float. */
static void make_text(char *text, uint32_t *state)
{
    const unsigned digits = 1u + tap_random(state) % (tap_random(state) % 4u == 0u ? 160u : 20u);
    const unsigned point = tap_random(state) % (digits + 1u);

    if (tap_random(state) % 2u == 0u) {
        *text++ = '-';
    }
    for (unsigned i = 0u; i < digits; i++) {
        if (i == point) {
            *text++ = '.';
        }
        *text++ = (char)('0' + tap_random(state) % 10u);
    }
    (void)sprintf(text, "e%d", (int)(tap_random(state) % 120u) - 65 - (int)(point / 2u));
}

/* The exact point between a float and the next, its digits cut, raised or continued. */
static bool reads_ties_like_strtof(uint32_t bits, uint32_t *state)
{
    const double middle = ((double)fmath_from_bits(bits) + (double)fmath_from_bits(bits + 1u)) / 2.0;
    char text[200];
    char *last;
    bool ok;

    (void)sprintf(text, "%.*e", 112, middle);
    ok = reads_like_strtof(text);
    last = strchr(text, 'e') - 1 - tap_random(state) % 100u;
    if (*last >= '0' && *last <= '9') {
        *last = (char)('0' + (*last - '0' + 1) % 10);
    }
    return reads_like_strtof(text) && ok;
}

/* printf gives the digits; the layout is this project's own, so the texts are compared after printf has laid out both.
 */
static bool writes_like_printf(double exact, unsigned digits, const char *text)
{
    char expected[40];
    char actual[40];

    (void)snprintf(expected, sizeof(expected), "%.*e", (int)digits - 1, exact);
    (void)snprintf(actual, sizeof(actual), "%.*e", (int)digits - 1, strtod(text, NULL));
    if (strcmp(expected, actual) != 0) {
        tap_note(text);
        tap_note(expected);
        return false;
    }
    return true;
}

static bool is_shortest(float value)
{
    char text[DECIMAL_SIZE_MAX];
    char rival[40];
    unsigned digits = 0u;

    (void)decimal_format_shortest(value, text);
    for (const char *next = text; *next != '\0' && *next != 'e'; next++) {
        digits += *next >= '0' && *next <= '9' && (digits > 0u || *next != '0') ? 1u : 0u;
    }
    if (strchr(text, '.') == NULL) {
        for (const char *next = text + strcspn(text, "e"); next > text && next[-1] == '0'; next--) {
            digits--;
        }
    }
    if (fmath_bits(strtof(text, NULL)) != fmath_bits(value)) {
        return false;
    }
    /* With one digit less, neither of the two neighbours in decimal reads back. */
    for (int side = -1; side <= 1 && digits > 1u; side++) {
        double step;

        (void)snprintf(rival, sizeof(rival), "%.*e", (int)digits - 2, (double)value);
        step = strtod(rival, NULL);
        (void)snprintf(rival, sizeof(rival), "1e%d", atoi(strchr(rival, 'e') + 1) - (int)digits + 2);
        step += side * strtod(rival, NULL);
        (void)snprintf(rival, sizeof(rival), "%.*e", (int)digits - 2, step);
        if (strtof(rival, NULL) == value) {
            tap_note(text);
            tap_note(rival);
            return false;
        }
    }
    return true;
}

static void test_decimal_against_library(void)
{
    uint32_t state = 1u;
    bool reads = true;
    bool reads_ties = true;
    bool writes = true;
    bool multiplies = true;
    bool shortens = true;

    for (unsigned i = 0u; i < 100000u; i++) {
        char text[200];
        const uint32_t bits = tap_random(&state) & 0x7fffffffu;
        const float value = fmath_from_bits(bits);
        const unsigned digits = 1u + tap_random(&state) % 9u;

        make_text(text, &state);
        reads = reads && reads_like_strtof(text);
        if (bits < 0x7f7fffffu) {
            const uint64_t count = tap_random(&state) >> tap_random(&state) % 32u; /* 24 + 29 bits fit a double */

            reads_ties = reads_ties && reads_ties_like_strtof(bits, &state);
            (void)decimal_format_f32(value, digits, text);
            writes = writes && writes_like_printf((double)value, digits, text);
            (void)decimal_format_product(count >> 3, value, digits, text);
            multiplies = multiplies && writes_like_printf((double)(count >> 3) * (double)value, digits, text);
        }
    }
    for (uint32_t bits = 1u; bits < 0x7f800000u; bits += bits < 0x00800000u ? bits : 0x00800000u) {
        shortens = shortens && is_shortest(fmath_from_bits(bits)) && is_shortest(fmath_from_bits(bits + 1u));
    }
    for (unsigned i = 0u; i < 20000u; i++) {
        shortens = shortens && is_shortest(fmath_from_bits(tap_random(&state) % 0x7f800000u));
    }
    tap_module("decimal");
    tap_check(reads, "random texts are read like strtof reads them");
    tap_check(reads_ties, "points between two floats too");
    tap_check(writes, "random floats are written with the digits of printf");
    tap_check(multiplies, "random products too");
    tap_check(shortens, "no shorter text reads back, at powers of two and elsewhere");
}

/* --- fmath against double precision ---------------------------------------------------------------------------------
 */

static double sine_series(double x)
{
    double term = x;
    double sum = x;

    for (int n = 2; n < 30; n += 2) {
        term *= -x * x / (n * (n + 1));
        sum += term;
    }
    return sum;
}

/* log2 of 1 to 2 by the series of the inverse hyperbolic tangent. */
static double log2_series(double x)
{
    const double ratio = (x - 1.0) / (x + 1.0);
    double power = ratio;
    double sum = 0.0;

    for (int n = 1; n < 60; n += 2, power *= ratio * ratio) {
        sum += power / n;
    }
    return 2.0 * sum / 0.69314718055994530942;
}

static void test_fmath_against_double(void)
{
    uint32_t state = 4711u;
    double worst_sine = 0.0;
    double worst_log2 = 0.0;

    for (unsigned i = 0u; i < 200000u; i++) {
        const uint32_t turns = tap_random(&state) >> tap_random(&state) % 32u;
        const double angle =
            6.28318530717958647693 * (turns < 0x80000000u ? turns : turns - 4294967296.0) / 4294967296.0;
        const float mantissa = fmath_from_bits(0x3f800000u | (turns & 0x7fffffu));
        const double sine_error = (double)fmath_sine_turns(turns) - sine_series(angle);
        const double log2_error = (double)fmath_log2(mantissa) - log2_series((double)mantissa);

        worst_sine = sine_error * sine_error > worst_sine * worst_sine ? sine_error : worst_sine;
        worst_log2 = log2_error * log2_error > worst_log2 * worst_log2 ? log2_error : worst_log2;
    }
    tap_module("fmath");
    tap_check_close((float)worst_sine, 0.0f, 4e-8f, "sine is off by hardly more than its rounding");
    tap_check_close((float)worst_log2, 0.0f, 2e-7f, "log2 is off by less than 2e-7");
}

/* --- hand-offs under interruption ------------------------------------------------------------------------------------
 */

enum { WORDS = 2048, RING_CAPACITY = 8 }; /* records so large that most signals hit a copy */

struct record {
    uint32_t words[WORDS];
};

static struct record latest_storage;
static struct record set_storage[2];
static struct record ring_storage[RING_CAPACITY];
static struct handoff latest;
static struct publish sets;
static struct ring ring;
static struct record made_by_handler;
static volatile sig_atomic_t interrupts;
static volatile sig_atomic_t torn_in_handler;

static void make_record(struct record *record, uint32_t number)
{
    for (unsigned i = 0u; i < WORDS; i++) {
        record->words[i] = number;
    }
}

static bool is_torn(const struct record *record)
{
    bool ok = true;

    for (unsigned i = 1u; i < WORDS; i++) {
        ok = ok && record->words[i] == record->words[0];
    }
    return !ok;
}

static void interrupt(int signal_number)
{
    const struct record *set = publish_take(&sets);

    (void)signal_number;
    interrupts = interrupts + 1;
    make_record(&made_by_handler, (uint32_t)interrupts);
    handoff_write(&latest, &made_by_handler);
    (void)ring_push(&ring, &made_by_handler);
    if (set != NULL && is_torn(set)) {
        torn_in_handler = torn_in_handler + 1;
    }
}

static void set_timer(long period_us)
{
    const struct itimerval timer = {{0, period_us}, {0, period_us}};

    (void)setitimer(ITIMER_REAL, &timer, NULL);
}

static void test_handoffs_under_interruption(void)
{
    static struct record seen;
    static struct record popped;
    struct sigaction action;
    uint32_t expected = 0u;
    uint32_t published = 0u;
    bool is_whole = true;
    bool is_rising = true;
    bool is_in_order = true;
    unsigned unguarded = 0u;

    handoff_init(&latest, &latest_storage, sizeof(latest_storage));
    publish_init(&sets, set_storage, sizeof(set_storage[0]));
    ring_init(&ring, ring_storage, sizeof(ring_storage[0]), RING_CAPACITY);
    memset(&action, 0, sizeof(action));
    action.sa_handler = interrupt;
    (void)sigaction(SIGALRM, &action, NULL);
    set_timer(100);
    while (interrupts < 500 || (unguarded == 0u && interrupts < 20000)) {
        const uint32_t before = seen.words[0];
        struct record *back = publish_back(&sets);

        if (handoff_read(&latest, &seen)) {
            is_whole = is_whole && !is_torn(&seen);
            is_rising = is_rising && seen.words[0] >= before;
        }
        /* The same copy without the counter: shows that signals do land inside. */
        memcpy(&popped, &latest_storage, sizeof(popped));
        unguarded += is_torn(&popped) ? 1u : 0u;
        while (ring_pop(&ring, &popped)) {
            is_in_order = is_in_order && !is_torn(&popped) && popped.words[0] > expected;
            expected = popped.words[0];
        }
        if (back != NULL) {
            make_record(back, ++published);
            (void)publish_commit(&sets);
        }
    }
    set_timer(0);
    tap_module("handoff");
    tap_check(unguarded > 0u, "a bare copy of the latest value is torn by signals");
    tap_check(is_whole && is_rising, "a guarded one never is, and never goes back");
    tap_check(is_in_order, "records pass the ring whole and in order under signals");
    tap_check(torn_in_handler == 0 && published > 100u, "the handler never sees a set half filled");
}

int main(void)
{
    test_decimal_against_library();
    test_fmath_against_double();
    test_handoffs_under_interruption();
    return unit_main();
}
