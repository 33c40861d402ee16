/* Verdict and measurement in SI. */
#include "protocol/report.h"

#include "base/compiler.h"
#include "base/decimal.h"
#include "base/fmath.h"
#include "model/demand.h"

#define NOT_A_NUMBER (fmath_from_bits(0x7fc00000u))

#define DB_PER_LOG2 6.02059991f      /* 20 log10(2) */
#define LOG2_PER_M_PER_S 29.8973529f /* log2(1 m/s / 1 nm/s) */
#define LN2 0.693147181f
#define GRAVITY_M_PER_S2 9.80665f

#define GROAN_LOW_HZ 20.0f
#define GROAN_HIGH_HZ 500.0f
#define SQUEAL_LOW_HZ 1250.0f
#define SQUEAL_HIGH_HZ 16000.0f

/* An assumption: the ear hears 20 Hz to 20 kHz, and a pad slower than 0.1 mm/s (44 dB by the estimate) drowns in a
 * car. */
#define AUDIBLE_LOW_HZ 20.0f
#define AUDIBLE_HIGH_HZ 20000.0f
#define AUDIBLE_M_PER_S 1e-4f

#define WEIGHTING_LOW_HZ 800.0f
#define WEIGHTING_HIGH_HZ 9000.0f
#define PRESSURE_PER_VELOCITY 32.95f /* 413 sqrt(0.01/(2 pi 0.5^2)), Pa s/m */
#define LOG2_PER_PA 15.6096405f      /* log2(1 Pa / 20 uPa) */

/* Metres and metres per second of one unit of an integer reader. */
static float metres(const struct scale *scale)
{
    return scale->length_m * (float)(1u << scale->length_shift) / (float)(1 << PLANT_FRACTION_BITS);
}

static float metres_per_s(const struct scale *scale)
{
    return scale->speed_m_per_s / (float)(1 << PLANT_FRACTION_BITS);
}

static float range(int32_t high, int32_t low) { return (float)(uint32_t)((int64_t)high - low); }

static float share(uint32_t part) { return (float)part / (float)PLANT_SHARE_ONE; }

float report_sound_level(float velocity_m_per_s_rms, float frequency_hz)
{
    if (!(frequency_hz >= WEIGHTING_LOW_HZ && frequency_hz <= WEIGHTING_HIGH_HZ) || !(velocity_m_per_s_rms > 0.0f)) {
        return NOT_A_NUMBER;
    }
    return DB_PER_LOG2 * (fmath_log2(velocity_m_per_s_rms * PRESSURE_PER_VELOCITY) + LOG2_PER_PA);
}

static uint8_t band_of(float frequency_hz)
{
    if (frequency_hz >= GROAN_LOW_HZ && frequency_hz <= GROAN_HIGH_HZ) {
        return REPORT_GROAN;
    }
    return frequency_hz >= SQUEAL_LOW_HZ && frequency_hz <= SQUEAL_HIGH_HZ ? REPORT_SQUEAL : REPORT_NO_BAND;
}

const char *report_band_name(uint8_t band)
{
    static const char *const names[] = {"none", "groan", "squeal"};

    return names[band < BASE_COUNT(names) ? band : REPORT_NO_BAND];
}

static float frequency(const struct detector_verdict *verdict, const struct scale *scale)
{
    if (verdict->motion == CLASS_REST || verdict->cycles == 0u || verdict->cycle_steps_q15 == 0u) {
        return NOT_A_NUMBER;
    }
    return (float)verdict->cycles * 32768.0f / fmath_from_u64(verdict->cycle_steps_q15) / scale->step_s;
}

static void judge_motion(struct report_verdict *judged, const struct detector_verdict *verdict,
                         const struct scale *scale)
{
    const float rms = fmath_sqrt(fmath_from_u64(verdict->variance)) / 65536.0f * scale->speed_m_per_s;
    const float hz = frequency(verdict, scale);

    judged->amplitude_um = 0.5e6f * range(verdict->x_max, verdict->x_min) * metres(scale);
    judged->velocity_mm_s = 0.5e3f * range(verdict->v_max, verdict->v_min) * metres_per_s(scale);
    judged->velocity_mm_s_rms = 1e3f * rms;
    judged->level_db = rms > 0.0f ? DB_PER_LOG2 * (fmath_log2(rms) + LOG2_PER_M_PER_S) : NOT_A_NUMBER;
    judged->acceleration_g = (float)verdict->acceleration * metres_per_s(scale) / scale->step_s / GRAVITY_M_PER_S2;
    judged->frequency_hz = hz;
    judged->band = band_of(hz);
    judged->is_audible = hz >= AUDIBLE_LOW_HZ && hz <= AUDIBLE_HIGH_HZ && rms >= AUDIBLE_M_PER_S;
    judged->level_dba_estimate = report_sound_level(rms, hz);
    judged->stick = share(verdict->stick);
    judged->slip_minus = share(verdict->slip_minus);
}

struct report_verdict report_judge(const struct detector_verdict *verdict, const struct scale *scale)
{
    const float frame_s = (float)DETECTOR_FRAME_PERIODS * (float)scale->steps_per_period * scale->step_s;
    const float none = NOT_A_NUMBER;
    struct report_verdict judged = {verdict->propensity,
                                    verdict->motion,
                                    verdict->period,
                                    none,
                                    none,
                                    none,
                                    none,
                                    none,
                                    none,
                                    REPORT_NO_BAND,
                                    false,
                                    none,
                                    none,
                                    none,
                                    none,
                                    none};

    if (verdict->propensity == PROPENSITY_UNKNOWN) {
        judged.motion = CLASS_UNSETTLED;
        judged.period = 0u;
        return judged;
    }
    judge_motion(&judged, verdict, scale);
    if (verdict->has_growth) {
        judged.growth_per_s = (float)verdict->growth_q16 / 65536.0f * LN2 / frame_s;
        judged.growth_error_per_s = (float)verdict->growth_error_q16 / 65536.0f * LN2 / frame_s;
    }
    return judged;
}

struct report_motion report_motion(const struct measure *measure, const struct scale *scale)
{
    const float frequency_steps = measure_frequency(measure);
    const float none = NOT_A_NUMBER;
    struct report_motion motion = {none, none, none};

    if (measure->done == 0u) {
        return motion;
    }
    motion.amplitude_um = 0.5e6f * range(measure->x_max, measure->x_min) * metres(scale);
    motion.velocity_mm_s = 0.5e3f * range(measure->v_max, measure->v_min) * metres_per_s(scale);
    motion.frequency_hz = frequency_steps > 0.0f ? frequency_steps / scale->step_s : none;
    return motion;
}

void report_field(struct text *text, const char *key, float value)
{
    if (fmath_is_finite(value)) {
        text_key_f32(text, key, value, DECIMAL_DIGITS_EXACT);
    } else {
        text_key_text(text, key, "nan");
    }
}

void report_write_class(struct text *text, const struct report_verdict *judged)
{
    text_key_text(text, "class", detector_class_name(judged->motion));
    if (judged->period > 0u) {
        text_write(text, "-p");
        text_u64(text, judged->period);
    }
    text_key_u64(text, "period", judged->period);
}

/* What the closed form says of the set, or where a controller holds force or speed, of what it holds. */
static struct prediction predict(const struct executive_report *report, const struct sim_plan *plan)
{
    struct params params = plan->params;

    if (!report->input.holds_load && !report->input.holds_speed) {
        return plan->prediction;
    }
    if (report->input.holds_load) {
        demand_hold_load(&params, report->input.load * plan->scale.load_n);
    }
    if (report->input.holds_speed) {
        demand_hold_speed(&params, report->input.speed * plan->scale.speed_m_per_s);
    }
    return predictor_predict(&params, &plan->scale);
}

struct report_answer report_answer(const struct executive_report *report, const struct sim_plan *plan)
{
    const struct scale *scale = &plan->scale;
    const struct prediction prediction = predict(report, plan);
    const bool has_ratio = prediction.verdict != PREDICTION_UNKNOWN;
    const float v10_steps = fmath_from_u64(report->v10_step) + (float)report->v10_fraction_q15 / 32768.0f;

    return (struct report_answer){
        .judged = report_judge(&report->verdict, scale),
        .predicted = (uint8_t)prediction.verdict,
        .is_bistable = prediction.is_bistable,
        .predicted_growth_per_s = prediction.rate * scale->omega_rad_per_s,
        .predicted_touch_ratio = has_ratio ? prediction.touch_ratio : NOT_A_NUMBER,
        .onset_touch_ratio = has_ratio ? prediction.onset_touch_ratio : NOT_A_NUMBER,
        .v10_s = report->has_v10 ? v10_steps * scale->step_s : NOT_A_NUMBER,
        .sigma = plan->params.tick_hz * plan->params.steps_per_tick * scale->step_s,
    };
}

struct report_trial report_trial(const struct trial *trial)
{
    const struct prediction *prediction = &trial->plan.prediction;
    const struct scale *scale = &trial->plan.scale;

    return (struct report_trial){
        .judged = report_judge(&trial->sim.detector.verdict, scale),
        .motion = report_motion(&trial->sim.measure, scale),
        .predicted = (uint8_t)prediction->verdict,
        .predicted_growth_per_s = prediction->rate * scale->omega_rad_per_s,
        .periods = trial_periods(trial),
    };
}

void report_write_verdict(struct text *text, const struct executive_report *report, const struct sim_plan *plan)
{
    const struct report_answer answer = report_answer(report, plan);
    const struct report_verdict judged = answer.judged;

    text_key_text(text, "propensity", detector_propensity_name(judged.propensity));
    report_write_class(text, &judged);
    report_field(text, "amplitude_um", judged.amplitude_um);
    report_field(text, "velocity_mm_s", judged.velocity_mm_s);
    report_field(text, "velocity_mm_s_rms", judged.velocity_mm_s_rms);
    report_field(text, "level_db", judged.level_db);
    report_field(text, "acceleration_g", judged.acceleration_g);
    report_field(text, "frequency_hz", judged.frequency_hz);
    text_key_text(text, "band", report_band_name(judged.band));
    text_key_text(text, "audible", judged.is_audible ? "yes" : "no");
    report_field(text, "level_dba_estimate", judged.level_dba_estimate);
    report_field(text, "growth_per_s", judged.growth_per_s);
    report_field(text, "growth_error_per_s", judged.growth_error_per_s);
    report_field(text, "stick", judged.stick);
    report_field(text, "slipminus", judged.slip_minus);
    text_key_text(text, "predicted", predictor_verdict_name((enum predictor_verdict)answer.predicted));
    report_field(text, "predicted_growth_per_s", answer.predicted_growth_per_s);
    report_field(text, "predicted_touch_ratio", answer.predicted_touch_ratio);
    report_field(text, "onset_touch_ratio", answer.onset_touch_ratio);
    text_key_text(text, "bistable", answer.is_bistable ? "yes" : "no");
    report_field(text, "t_v10", answer.v10_s);
    report_field(text, "sigma", answer.sigma);
}

void report_write_measure(struct text *text, const struct executive_report *report, const struct sim_plan *plan)
{
    const struct measure *measure = &report->measure;
    const struct scale *scale = &plan->scale;

    text_key_u64(text, "step", report->now.step);
    text_key_product(text, "t", report->now.step, scale->step_s, DECIMAL_DIGITS_EXACT);
    report_field(text, "x", sample_displacement(&report->now, scale) * scale->length_m);
    report_field(text, "xd", sample_value(&report->now, report->now.v) * scale->speed_m_per_s);
    report_field(text, "xmax", (float)measure->x_max * metres(scale));
    report_field(text, "xmin", (float)measure->x_min * metres(scale));
    report_field(text, "xpp", range(measure->x_max, measure->x_min) * metres(scale));
    report_field(text, "vmax", (float)measure->v_max * metres_per_s(scale));
    report_field(text, "vmin", (float)measure->v_min * metres_per_s(scale));
    report_field(text, "stick", measure_share(measure, measure->stick));
    report_field(text, "slipminus", measure_share(measure, measure->slip_minus));
    report_field(text, "f_up", report_motion(measure, scale).frequency_hz);
}
