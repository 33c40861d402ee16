/* Trials of one row. */
#include "run.h"

#include <math.h>

enum { MEMORY_PERIODS = 192 }; /* the window, and what the detector needs to forget squeal */

/* Flagged, with no touch in all that the detector remembers. */
static bool is_flash(const struct trial *trial)
{
    const struct sim *sim = &trial->sim;
    const uint64_t memory = (uint64_t)MEMORY_PERIODS * trial->plan.scale.steps_per_period;

    return sim->detector.verdict.propensity == PROPENSITY_SQUEAL && sim->fault == SIM_FAULT_NONE &&
           (!trial->has_event || sim->step - trial->event_step > memory);
}

/* To its end, with a look at the verdict every frame. */
static void run_trial(struct trial *trial, struct run *run)
{
    const uint32_t steps = DETECTOR_FRAME_PERIODS * trial->plan.scale.steps_per_period;

    while (!trial_go_on(trial, steps)) {
        run->has_flash = run->has_flash || is_flash(trial);
    }
}

static void book_latency(struct run *run, const struct trial *trial)
{
    const struct scale *scale = &trial->plan.scale;
    const float steps = (float)(trial->flag_step - trial->onset_step);

    run->has_onset = trial->has_onset;
    run->latency_periods = steps / (float)scale->steps_per_period;
    run->latency_ms = steps * scale->step_s * 1e3f;
}

struct run run_row(const struct set *set, int arith)
{
    static struct trial trial; /* larger than a stack frame should be */
    const struct params params = set_params(set, arith);
    struct trial_span span = {.transient = (uint32_t)set->ntrans, .window = (uint32_t)set->nwin, .is_whole = true};
    struct run run = {0};
    const struct detector_verdict *verdict = &trial.sim.detector.verdict;

    if (trial_begin(&trial, &params, &span).error != ERROR_OK) {
        run.is_refused = true;
        return run;
    }
    run_trial(&trial, &run);
    run.propensity = verdict->propensity;
    run.motion = verdict->motion;
    run.period = verdict->period;
    run.predicted = (uint8_t)trial.plan.prediction.verdict;
    run.speed_vref = 0.5f * ((float)verdict->v_max - (float)verdict->v_min) / (float)(1 << PLANT_FRACTION_BITS);
    run.speed_ratio = run.speed_vref * trial.plan.scale.speed_m_per_s / fabsf(params.speed_m_per_s);
    run.saturations = trial.sim.counters.saturations;
    run.caps = trial.sim.counters.caps;
    run.periods = trial_periods(&trial);
    book_latency(&run, &trial);

    span.is_whole = false;
    (void)trial_begin(&trial, &params, &span);
    run_trial(&trial, &run);
    run.cut_propensity = verdict->propensity;
    run.cut_end = trial.end;
    run.cut_periods = trial_periods(&trial);
    return run;
}
