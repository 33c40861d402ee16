/* What the device says of the plant's motion, and of itself. */
#include "base/fmath.h"
#include "protocol/link_parts.h"
#include "protocol/report.h"

void link_put_value(struct bytes_writer *writer, float value)
{
    bytes_put_f32(writer, fmath_is_finite(value) ? value : fmath_from_bits(0x7fc00000u));
}

static void put_judged(struct bytes_writer *reply, const struct report_verdict *judged)
{
    link_put_value(reply, judged->amplitude_um);
    link_put_value(reply, judged->velocity_mm_s);
    link_put_value(reply, judged->velocity_mm_s_rms);
    link_put_value(reply, judged->level_db);
    link_put_value(reply, judged->acceleration_g);
    link_put_value(reply, judged->frequency_hz);
    link_put_value(reply, judged->level_dba_estimate);
    link_put_value(reply, judged->growth_per_s);
    link_put_value(reply, judged->growth_error_per_s);
    link_put_value(reply, judged->stick);
    link_put_value(reply, judged->slip_minus);
}

enum link_progress link_verdict(struct link *link)
{
    struct bytes_writer *reply = &link->reply;
    struct executive_report report;
    struct report_answer answer;

    executive_report(link->executive, &report);
    answer = report_answer(&report, executive_plan(link->executive));
    bytes_put_u8(reply, answer.judged.propensity);
    bytes_put_u8(reply, answer.judged.motion);
    bytes_put_u8(reply, answer.judged.period);
    bytes_put_u8(reply, answer.judged.band);
    bytes_put_u8(reply, answer.predicted);
    bytes_put_u8(reply, (uint8_t)((answer.judged.is_audible ? LINK_IS_AUDIBLE : 0) |
                                  (answer.is_bistable ? LINK_IS_BISTABLE : 0)));
    put_judged(reply, &answer.judged);
    link_put_value(reply, answer.predicted_growth_per_s);
    link_put_value(reply, answer.predicted_touch_ratio);
    link_put_value(reply, answer.onset_touch_ratio);
    link_put_value(reply, answer.v10_s);
    link_put_value(reply, answer.sigma);
    return link_answer(link);
}

static enum link_progress begin_selftest(struct link *link)
{
    if (!turn_take(link->turn, TURN_LINK)) {
        return link_refuse_plain(link, ERROR_BUSY);
    }
    selftest_start(&link->work->selftest);
    link->phase = 1u;
    return LINK_ADVANCES;
}

enum link_progress link_selftest(struct link *link)
{
    struct work *work = link->work;
    struct selftest *selftest = &work->selftest;

    if (link->phase == 0u) {
        return begin_selftest(link);
    }
    if (link->turn->is_wanted) {
        return link_refuse_plain(link, ERROR_STOPPED);
    }
    (void)selftest_go_on(selftest, work->ticks_counted, work->ticks_expected);
    if (!selftest_is_done(selftest)) {
        return LINK_ADVANCES;
    }
    bytes_put_u8(&link->reply, (uint8_t)selftest->passed);
    bytes_put_u8(&link->reply, (uint8_t)selftest->failed);
    bytes_put_u32(&link->reply, selftest->failures);
    return link_answer(link);
}
