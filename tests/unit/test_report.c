/* Verdict and measurement in SI. */
#include "protocol/report.h"

#include "base/decimal.h"
#include "base/fmath.h"
#include "bench.h"
#include "tap.h"
#include "tests.h"

static struct sim_plan plan;
static struct executive_report report;

static bool is_nan(float value) { return value != value; }

static void set_plan(void)
{
    plan = (struct sim_plan){
        .scale = {
            .speed_m_per_s = 2.0f, .length_m = 1e-3f, .length_shift = 1u, .step_s = 1e-5f, .steps_per_period = 64u}};
    report = (struct executive_report){.verdict = {.propensity = PROPENSITY_SQUEAL,
                                                   .motion = CLASS_STICKSLIP,
                                                   .period = 1u,
                                                   .has_growth = true,
                                                   .growth_q16 = 65536,
                                                   .growth_error_q16 = 6554,
                                                   .x_max = 1 << 26,
                                                   .x_min = -(1 << 26),
                                                   .v_max = 1 << 25,
                                                   .v_min = -(1 << 25),
                                                   .acceleration = 1 << 20,
                                                   .variance = UINT64_C(1) << 22, /* rms 2^-5 */
                                                   .stick = PLANT_SHARE_ONE / 4,
                                                   .slip_minus = PLANT_SHARE_ONE / 8,
                                                   .cycles = 10u,
                                                   .cycle_steps_q15 = UINT64_C(500) << 15}};
}

static void check_verdict(void)
{
    struct report_verdict judged;

    set_plan();
    judged = report_judge(&report.verdict, &plan.scale);
    tap_check_close(judged.amplitude_um, 1000.0f, 1e-2f, "amplitude: half the range of x, shift included");
    tap_check_close(judged.velocity_mm_s, 500.0f, 1e-3f, "velocity: half the range of v");
    tap_check_close(judged.velocity_mm_s_rms, 62.5f, 1e-4f, "rms velocity");
    tap_check_close(judged.level_db, 155.9176f, 1e-3f, "level: 20 log10(0.0625 / 1e-9)");
    tap_check_close(judged.acceleration_g, 159.3277f, 1e-2f, "acceleration: 2^-7 * 2 m/s in 10 us");
    tap_check_close(judged.frequency_hz, 2000.0f, 1e-2f, "frequency: 10 cycles in 500 steps");
    tap_check_text(report_band_name(judged.band), "squeal", "band");
    tap_check(judged.is_audible, "audible");
    tap_check_close(judged.stick, 0.25f, 0.0f, "share of sticking");
    tap_check_close(judged.slip_minus, 0.125f, 0.0f, "share of slipping back");
    tap_check_close(judged.growth_per_s, 135.3803f, 1e-2f, "growth: ln 2 in 8 periods of 640 us");
    tap_check_close(judged.growth_error_per_s, 13.5385f, 1e-2f, "and its error");
    report.verdict.cycle_steps_q15 = UINT64_C(12600) << 15;
    tap_check_text(report_band_name(report_judge(&report.verdict, &plan.scale).band), "groan", "a slower one groans");
    tap_check(is_nan(report_judge(&report.verdict, &plan.scale).level_dba_estimate), "and has no loudness estimate");
    report.verdict.cycle_steps_q15 = UINT64_C(126000) << 15;
    judged = report_judge(&report.verdict, &plan.scale);
    tap_check(!judged.is_audible && judged.band == REPORT_NO_BAND, "8 Hz is neither audible nor in a band");
    report.verdict.has_growth = false;
    tap_check(is_nan(report_judge(&report.verdict, &plan.scale).growth_per_s), "no growth, no number");
    report.verdict.motion = CLASS_REST;
    tap_check(is_nan(report_judge(&report.verdict, &plan.scale).frequency_hz), "rest has no frequency");
    report.verdict.variance = 0u;
    tap_check(is_nan(report_judge(&report.verdict, &plan.scale).level_db), "no motion has no level");
}

static void check_unknown(void)
{
    struct report_verdict judged;

    set_plan();
    report.verdict.propensity = PROPENSITY_UNKNOWN;
    judged = report_judge(&report.verdict, &plan.scale);
    tap_check(judged.motion == CLASS_UNSETTLED && judged.period == 0u, "before the window is full: unsettled");
    tap_check(is_nan(judged.amplitude_um) && is_nan(judged.velocity_mm_s) && is_nan(judged.velocity_mm_s_rms) &&
                  is_nan(judged.level_db) && is_nan(judged.acceleration_g) && is_nan(judged.frequency_hz) &&
                  is_nan(judged.growth_per_s) && is_nan(judged.stick) && is_nan(judged.slip_minus),
              "and nothing has been measured");
}

static void check_sound(void)
{
    tap_check_close(report_sound_level(1e-4f, 2000.0f), 44.0f, 0.5f, "0.1 mm/s are some 44 dB");
    tap_check_close(report_sound_level(1e-3f, 2000.0f), 64.0f, 0.5f, "1 mm/s are some 64 dB");
    tap_check_close(report_sound_level(1e-2f, 2000.0f), 84.0f, 0.5f, "10 mm/s are some 84 dB");
    tap_check(is_nan(report_sound_level(1e-2f, 79.0f)) && is_nan(report_sound_level(0.0f, 2000.0f)) &&
                  is_nan(report_sound_level(1e-2f, report_sound_level(0.0f, 0.0f))),
              "a groan, silence and no frequency have none");
}

static float field(const char *answer, const char *key)
{
    float value = fmath_from_bits(0x7fc00000u);

    for (; *answer != '\0'; answer++) {
        size_t length = 0u;

        if (answer[0] == ' ' && bench_starts(answer + 1, key)) {
            for (; *answer != '='; answer++) {
            }
            answer++;
            while (answer[length] != '\0' && answer[length] != ' ') {
                length++;
            }
            (void)decimal_parse_f32(answer, length, &value);
            break;
        }
    }
    return value;
}

/* The measured values of the brake at 3000 N that the reference solver gave. */
static void check_brake(void)
{
    const char *answer;

    bench_open();
    (void)bench_say("preset brake\rset substeps 64\rmeasure 600\r");
    answer = bench_say("verdict\r");
    tap_check(bench_starts(answer, "ok verdict propensity=squeal class=limitcycle-stickslip-p1 period=1 "),
              "the brake at 3000 N squeals");
    tap_check_close(field(answer, "amplitude_um="), 8.15f, 0.02f, "by 8.15 um");
    tap_check_close(field(answer, "frequency_hz="), 1999.5f, 0.5f, "at 1999.5 Hz");
    tap_check_close(field(answer, "stick="), 0.051f, 1e-3f, "sticking 5.1 % of the time");
    tap_check_close(field(answer, "acceleration_g="), 130.0f, 5.0f, "with 130 g");
    tap_check_close(field(answer, "predicted_growth_per_s="), 100.0f, 0.01f, "as the closed form predicts");
    answer = bench_say("measure 100\r");
    tap_check_close(field(answer, "f_up="), 1999.5f, 0.5f, "a measurement finds the same frequency");
    tap_check_close(field(answer, "xpp="), 16.3e-6f, 0.04e-6f, "and the same amplitude");
    tap_check_close(field(answer, "vmax="), 0.1f, 1e-6f, "the pad is never faster than the disc it sticks to");
}

void test_report(void)
{
    check_verdict();
    check_unknown();
    check_sound();
    check_brake();
}
