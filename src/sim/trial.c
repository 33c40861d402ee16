/* One set, from its start to a verdict. */
#include "sim/trial.h"

#include "base/fmath.h"

enum {
    FRAMES_SURE = 2,   /* that must promise the same end */
    SETTLED_LEAST = 2, /* frames after which nothing of a moving profile is left in a second difference */
    LINE_LEAST = 6,    /* frames without which a line proves nothing */
    LINE_BRIEF = 16,   /* frames that may end a brief trial */
    LINE_UNIT = 16,    /* from Q16 to Q12: the squares of many frames fit 64 bits */
    LINE_MAX = 1 << 16 /* frames; more change nothing */
};

#define LN2 0.693147181f
#define ERROR_DEVIATIONS 3.0f
#define WANDER_LEAST 0.02f /* of the ratio: beyond it so few frames say nothing more */

static uint64_t periods_to_steps(const struct trial *trial, uint32_t periods)
{
    return (uint64_t)periods * trial->plan.scale.steps_per_period;
}

/* Step from which on load and speed stand still; what is periodic never does, and what takes for ever is not waited
 * for. */
static uint64_t settled_step(const struct trial *trial, const struct params *params)
{
    const uint64_t most = periods_to_steps(trial, TRIAL_PERIODS_MAX);
    const uint64_t load = acting_settled_step(&trial->plan.load, params, &trial->plan.scale);
    const uint64_t speed = acting_settled_step(&trial->plan.speed, params, &trial->plan.scale);
    const uint64_t last = load > speed ? load : speed;

    return last < most ? last : most;
}

struct params_problem trial_begin(struct trial *trial, const struct params *params, const struct trial_span *span)
{
    struct params_problem problem = params_check(params);

    if (problem.error == ERROR_OK) {
        problem = sim_plan_make(&trial->plan, params, NULL);
    }
    if (problem.error != ERROR_OK) {
        return problem;
    }
    sim_reset(&trial->sim, &trial->plan);
    trial->span = *span;
    trial->end = TRIAL_RUNS;
    trial->promised = TRIAL_RUNS;
    trial->sure = 0u;
    trial->settled = 0u;
    trial->is_measuring = false;
    trial->is_over = false;
    trial->line = (struct trial_line){0};
    trial->has_event = false;
    trial->has_flag = false;
    trial->has_onset = false;
    trial->onset_step = 0u;
    trial->until = settled_step(trial, params) + periods_to_steps(trial, span->transient);
    return problem;
}

/* Load and speed have come to rest, and stay there. */
static bool is_settled(const struct trial *trial)
{
    const struct sim_plan *plan = &trial->plan;
    const struct sim *sim = &trial->sim;
    const bool is_q27 = plan->arithmetic == ARITH_Q27;

    return acting_is_steady(&plan->load, &sim->load, sim->step, is_q27) &&
           acting_is_steady(&plan->speed, &sim->speed, sim->step, is_q27);
}

static bool slips_on(const struct trial *trial)
{
    return !trial->has_event || trial->sim.step - trial->event_step > periods_to_steps(trial, TRIAL_PAUSE_PERIODS);
}

/* Logarithms join the line only while nothing but the free motion is in them. */
static void book_growth(struct trial *trial)
{
    const int32_t log2_q16 = trial->sim.detector.verdict.free_log2_q16;
    struct trial_line *line = &trial->line;
    int64_t value;

    if (log2_q16 < 0 || trial->settled < SETTLED_LEAST || !slips_on(trial) || line->count >= LINE_MAX) {
        return;
    }
    if (line->count == 0u) {
        line->first_log2_q16 = log2_q16;
    }
    value = (log2_q16 - line->first_log2_q16) / LINE_UNIT;
    line->change_square += (value - line->last) * (value - line->last);
    line->last = value;
    line->sum += value;
    line->sum_square += value * value;
    line->sum_place += value * (int64_t)line->count;
    line->count++;
}

/* A pad that rides along with a moving disc is still, but the spring will break it loose. */
static bool decays(const struct detector_verdict *verdict)
{
    return (verdict->stick == 0u || verdict->disc == 0) &&
           (!verdict->has_growth || verdict->growth_q16 < -verdict->growth_error_q16);
}

/* The steady motion that the load forces is far from touching the disc, or the disc stands: only then is decay the
 * whole story. */
static bool stays_off(const struct trial *trial)
{
    const struct prediction *prediction = &trial->plan.prediction;

    return prediction->verdict == PREDICTION_UNKNOWN || prediction->touch_ratio < PREDICTOR_TOUCH_MARGIN;
}

/* The end that this frame promises, if it does. */
static uint8_t promise(const struct trial *trial)
{
    const struct detector_verdict *verdict = &trial->sim.detector.verdict;

    if (trial->settled <= DETECTOR_WINDOW_FRAMES) {
        return TRIAL_RUNS;
    }
    if (verdict->propensity == PROPENSITY_SQUEAL && verdict->period != 0u) {
        return TRIAL_SQUEALED;
    }
    if (verdict->propensity == PROPENSITY_QUIET && trial->plan.prediction.rate < 0.0f && stays_off(trial) &&
        decays(verdict)) {
        return TRIAL_DECAYED;
    }
    return TRIAL_RUNS;
}

static void open_window(struct trial *trial, enum trial_end end)
{
    const uint64_t steps = periods_to_steps(trial, trial->span.window);

    trial->end = (uint8_t)end;
    trial->is_measuring = true;
    trial->until = trial->sim.step + steps;
    sim_measure(&trial->sim, steps);
}

/* The line says by now whether the motion grows. */
static void end_if_growth_is_sure(struct trial *trial)
{
    float growth;
    float error;

    if (slips_on(trial) && trial->line.count >= LINE_BRIEF && trial_growth(trial, &growth, &error) &&
        fmath_abs(growth) > error && (growth > 0.0f || stays_off(trial))) {
        trial->end = growth > 0.0f ? TRIAL_GREW : TRIAL_DECAYED;
        trial->is_over = true;
    }
}

/* A frame has its verdict and its class. */
static void take_frame(struct trial *trial)
{
    const uint8_t promised = promise(trial);

    trial->settled = is_settled(trial) ? trial->settled + 1u : 0u;
    book_growth(trial);
    if (trial->span.is_brief && !trial->span.is_whole && !trial->is_measuring) {
        end_if_growth_is_sure(trial);
    }
    if (trial->is_over) {
        return;
    }
    trial->sure = promised == trial->promised ? trial->sure + 1u : 1u;
    trial->promised = promised;
    if (promised != TRIAL_RUNS && trial->sure >= FRAMES_SURE && !trial->span.is_whole && !trial->is_measuring) {
        open_window(trial, (enum trial_end)promised);
    }
}

/* Remembers when the pad began to touch, and when it was called squeal. */
static void watch_onset(struct trial *trial)
{
    const struct sim *sim = &trial->sim;

    if (!trial->has_flag && sim->detector.verdict.propensity == PROPENSITY_SQUEAL) {
        trial->has_flag = true;
        trial->flag_step = sim->step;
        trial->has_onset = !slips_on(trial);
    }
    if (plant_notes(sim_output(sim)).events == 0u) {
        return;
    }
    if (slips_on(trial) && !trial->has_flag) {
        trial->onset_step = sim->step;
    }
    trial->has_event = true;
    trial->event_step = sim->step;
}

static void advance(struct trial *trial)
{
    struct sim *sim = &trial->sim;
    const bool has_news = sim_step_unhashed(sim);

    watch_onset(trial);
    if (sim->fault != SIM_FAULT_NONE) {
        trial->end = TRIAL_DIVERGED;
        trial->is_over = true;
        return;
    }
    if (has_news && sim->detector.search.stage == STAGE_IDLE) {
        take_frame(trial);
    }
    if (sim->step < trial->until) {
        return;
    }
    if (trial->is_measuring) {
        trial->is_over = true;
    } else {
        open_window(trial, TRIAL_WAS_WHOLE);
    }
}

bool trial_go_on(struct trial *trial, uint32_t steps)
{
    for (uint32_t i = 0u; i < steps && !trial->is_over; i++) {
        advance(trial);
    }
    return trial->is_over;
}

float trial_periods(const struct trial *trial)
{
    return fmath_from_u64(trial->sim.step) / (float)trial->plan.scale.steps_per_period;
}

static float from_i64(int64_t value)
{
    return value < 0 ? -fmath_from_u64(0u - (uint64_t)value) : fmath_from_u64((uint64_t)value);
}

/* How much longer the error of a slope is where a residue resembles the one before: noise near a border wanders slowly.
 * By the ratio of Durbin and Watson, 2 (1 - r) where r is the correlation from one frame to the next. */
static float wander(const struct trial_line *line, float slope, float rest)
{
    const float frames = (float)(line->count - 1u);
    const float change = from_i64(line->change_square) - 2.0f * slope * from_i64(line->last) + frames * slope * slope;
    const float ratio = rest > 0.0f ? change / rest : 2.0f;

    return fmath_sqrt(fmath_max(4.0f - ratio, 0.0f) / fmath_max(ratio, WANDER_LEAST));
}

bool trial_growth(const struct trial *trial, float *growth, float *error)
{
    const struct trial_line *line = &trial->line;
    const float to_period = LN2 / 4096.0f / (float)DETECTOR_FRAME_PERIODS;
    const float count = (float)line->count;
    const float spread =
        count * (count * count - 1.0f) / 12.0f; /* of the places about their mean, squared and summed */
    const float sum = from_i64(line->sum);
    float slope;
    float rest;

    if (line->count < LINE_LEAST) {
        return false;
    }
    slope = (from_i64(line->sum_place) - 0.5f * (count - 1.0f) * sum) / spread;
    rest = fmath_max(from_i64(line->sum_square) - sum * (sum / count) - slope * slope * spread, 0.0f);
    *growth = slope * to_period;
    *error = ERROR_DEVIATIONS * fmath_sqrt(rest / ((count - 2.0f) * spread)) *
             fmath_max(wander(line, slope, rest), 1.0f) * to_period;
    return true;
}

bool trial_is_loud(const struct trial *trial)
{
    float growth;
    float error;

    /* A brief trial that ended by its growth, without a window, knows more than the verdict of the moment. */
    if (!trial->is_measuring && (trial->end == TRIAL_GREW || trial->end == TRIAL_DECAYED)) {
        return trial->end == TRIAL_GREW;
    }
    return trial->sim.detector.verdict.propensity == PROPENSITY_SQUEAL ||
           (slips_on(trial) && trial_growth(trial, &growth, &error) && growth > error);
}

bool trial_is_undecided(const struct trial *trial)
{
    float growth;
    float error;

    return trial->end == TRIAL_WAS_WHOLE && trial->sim.detector.verdict.propensity != PROPENSITY_SQUEAL &&
           slips_on(trial) && trial_growth(trial, &growth, &error) && fmath_abs(growth) <= error;
}

const char *trial_end_name(uint8_t end)
{
    static const char *const names[] = {"running", "whole", "squealed", "decayed", "diverged", "grew"};

    return end < sizeof names / sizeof names[0] ? names[end] : "?";
}
