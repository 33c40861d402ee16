/* Verdict and self-test over the link: what the console says of the same plant, as numbers. */
#include "base/fmath.h"
#include "controller.h"
#include "protocol/report.h"
#include "tap.h"
#include "tests.h"

/* The fields in their order. */
static bool are_values_said(void)
{
    static const char *const keys[] = {
        "amplitude_um", "velocity_mm_s",          "velocity_mm_s_rms",     "level_db",           "acceleration_g",
        "frequency_hz", "level_dba_estimate",     "growth_per_s",          "growth_error_per_s", "stick",
        "slipminus",    "predicted_growth_per_s", "predicted_touch_ratio", "onset_touch_ratio",  "t_v10",
        "sigma"};
    bool ok = true;

    for (size_t i = 0u; i < sizeof keys / sizeof keys[0]; i++) {
        ok = holds_value(bench.last, keys[i], bytes_get_f32(&answer)) && ok;
    }
    return ok && bytes_is_spent(&answer);
}

static bool are_words(uint8_t propensity, uint8_t class, uint8_t period, uint8_t band, uint8_t predicted, uint8_t flags)
{
    return is_done(LINK_VERDICT) && bytes_get_u8(&answer) == propensity && bytes_get_u8(&answer) == class &&
           bytes_get_u8(&answer) == period && bytes_get_u8(&answer) == band && bytes_get_u8(&answer) == predicted &&
           bytes_get_u8(&answer) == flags;
}

static void check_verdict(void)
{
    bench_open();
    (void)bench_say("verdict\r");
    tap_check(are_words(PROPENSITY_UNKNOWN, CLASS_UNSETTLED, 0u, REPORT_NO_BAND, PREDICTION_QUIET, 0u) &&
                  are_values_said(),
              "nothing is known at the start, and NaN says so");
    answer = (struct bytes_reader){.bytes = reply.payload, .size = reply.size, .offset = 6u};
    tap_check(bytes_get_u32(&answer) == 0x7fc00000u, "always the same NaN");
    (void)bench_say("preset brake\rset substeps 64\rmeasure 600\rverdict\r");
    tap_check(are_words(PROPENSITY_SQUEAL, CLASS_LIMITCYCLE_STICKSLIP, 1u, REPORT_SQUEAL, PREDICTION_SQUEAL, 1u),
              "a brake that squeals, audibly: the words");
    tap_check(are_values_said(), "and the numbers of the console");
}

/* --- Self-test ---------------------------------------------------------------------------------------------------- */

static bool has_tested(uint8_t passed, uint8_t failed, uint32_t failures)
{
    return is_done(LINK_SELFTEST) && bytes_get_u8(&answer) == passed && bytes_get_u8(&answer) == failed &&
           bytes_get_u32(&answer) == failures && bytes_is_spent(&answer);
}

static void check_selftest(void)
{
    bench_open();
    bench.work.ticks_counted = 1000u;
    bench.work.ticks_expected = 1001u;
    tap_check(has_tested(SELFTEST_COUNT, 0u, 0u), "the self-test passes");
    bench.work.ticks_expected = 1002u;
    tap_check(has_tested(SELFTEST_COUNT - 1u, 1u, 1u << SELFTEST_TICKS), "lost ticks fail it, by number");
    bench.work.ticks_expected = 1001u;
    tap_check(has_tested(SELFTEST_COUNT, 0u, 0u), "and are forgotten with the next");
}

static void check_turns(void)
{
    bool is_busy;

    bench_open();
    say(LINK_SELFTEST, 1u, 0u);
    request.size = 0u;
    tap_check(!bench_ask(&request, &reply, 4u) && bench.turn.holder == TURN_LINK, "a self-test takes its time");
    (void)console_receive(&bench.console, (const uint8_t *)"stop\r", 5u);
    tap_check(bench_link_turns((const uint8_t *)"", 0u, 10u, &reply) && reply.type == LINK_ERROR &&
                  reply.payload[1] == ERROR_STOPPED,
              "a stop of the console ends it");
    bench_wait(10u);
    tap_check(bench_starts(bench.last, "ok stop ") && bench.turn.holder == TURN_NOBODY, "and gets the turn");
    (void)bench_turn("selftest\r", 9u, SIZE_MAX, &is_busy);
    tap_check(bench.console.task == CONSOLE_TASK_SELFTEST && !is_done(LINK_SELFTEST) && reply.payload[1] == ERROR_BUSY,
              "while the console tests, the link does not");
    bench_wait(2000u);
    tap_check_text(bench.last, "ok selftest passed=9 failed=0", "nor does it disturb");
}

void test_link_verdict(void)
{
    check_verdict();
    check_selftest();
    check_turns();
}
