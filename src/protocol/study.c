/* Trials for a study: reading how long, running them in slices, telling what they came to. */
#include "base/fmath.h"
#include "protocol/report.h"
#include "protocol/study_parts.h"
#include "protocol/values.h"

const struct params_info *study_read_parameter(struct console *console, struct token word)
{
    const struct params_info *info = params_find(word.start, word.length);

    if (word.length == 0u) {
        console_refuse_usage(console);
    } else if (info == NULL) {
        console_refuse(console, ERROR_UNKNOWN_NAME, word, "no parameter has this name; list shows them");
    }
    return info;
}

bool study_read_value(struct console *console, const struct params_info *info, struct token word, float *value)
{
    enum error error;

    if (word.length == 0u) {
        console_refuse_usage(console);
        return false;
    }
    error = params_parse(info, word.start, word.length, value);
    if (error == ERROR_OK && !params_accepts(info, *value)) {
        error = ERROR_OUT_OF_RANGE;
    }
    if (error != ERROR_OK) {
        settings_refuse_value(console, error, info, word);
    }
    return error == ERROR_OK;
}

bool study_read_count(struct console *console, const char *key, struct token word, uint32_t low, uint32_t high,
                      uint32_t *count)
{
    if (word.length == 0u) {
        console_refuse_usage(console);
        return false;
    }
    if (!token_number(word, low, high, count)) {
        console_refuse_count(console, key, word, low, high);
        return false;
    }
    return true;
}

bool study_is_span(struct token word)
{
    return token_is(word, "transient") || token_is(word, "window") || token_is(word, "whole");
}

bool study_read_span(struct console *console, struct token word, struct trial_span *span)
{
    for (; word.length != 0u; word = token_next(word)) {
        if (token_is(word, "whole")) {
            span->is_whole = true;
        } else if (token_is(word, "transient")) {
            word = token_next(word);
            if (!study_read_count(console, "transient", word, 0u, TRIAL_PERIODS_MAX, &span->transient)) {
                return false;
            }
        } else if (token_is(word, "window")) {
            word = token_next(word);
            if (!study_read_count(console, "window", word, TRIAL_WINDOW_MIN, TRIAL_PERIODS_MAX, &span->window)) {
                return false;
            }
        } else {
            console_refuse_usage(console);
            return false;
        }
    }
    return true;
}

void study_start(struct console *console, enum console_task task)
{
    console->study.is_trying = false;
    console->study.tally = (struct study_tally){0};
    console_start_task(console, task);
}

static void book_trial(struct study_tally *tally, const struct trial *trial)
{
    const struct sim *sim = &trial->sim;

    tally->by_propensity[sim->detector.verdict.propensity]++;
    tally->loud += trial_is_loud(trial) ? 1u : 0u;
    tally->undecided += trial_is_undecided(trial) ? 1u : 0u;
    tally->diverged += trial->end == TRIAL_DIVERGED ? 1u : 0u;
    tally->caps += sim->counters.caps;
    tally->saturations += sim->counters.saturations;
    tally->gap_held += sim->counters.gap_held;
    tally->steps += sim->step;
}

bool study_try(struct study *study, const struct params *params, struct params_problem *problem)
{
    if (!study->is_trying) {
        study->tally.trials++;
        *problem = trial_begin(&study->trial, params, &study->span);
        if (problem->error != ERROR_OK) {
            study->tally.refused++;
            return true;
        }
        study->is_trying = true;
    }
    if (!trial_go_on(&study->trial, STUDY_SLICE_STEPS)) {
        return false;
    }
    study->is_trying = false;
    problem->error = ERROR_OK;
    book_trial(&study->tally, &study->trial);
    return true;
}

static void write_trial(struct text *text, const struct trial *trial)
{
    const struct report_motion motion = report_motion(&trial->sim.measure, &trial->plan.scale);
    const struct report_verdict judged = report_judge(&trial->sim.detector.verdict, &trial->plan.scale);
    const struct prediction *prediction = &trial->plan.prediction;

    text_key_text(text, "propensity", detector_propensity_name(judged.propensity));
    report_write_class(text, &judged);
    report_field(text, "amplitude_um", motion.amplitude_um);
    report_field(text, "velocity_mm_s", motion.velocity_mm_s);
    report_field(text, "frequency_hz", motion.frequency_hz);
    report_field(text, "growth_per_s", judged.growth_per_s);
    text_key_text(text, "predicted", predictor_verdict_name(prediction->verdict));
    report_field(text, "predicted_growth_per_s", prediction->rate * trial->plan.scale.omega_rad_per_s);
    text_key_text(text, "end", trial_end_name(trial->end));
    report_field(text, "periods", trial_periods(trial));
}

void study_write_outcome(struct text *text, const struct trial *trial, const struct params_problem *problem)
{
    if (problem->error == ERROR_OK) {
        write_trial(text, trial);
    } else {
        text_key_text(text, "error", error_name(problem->error));
    }
}

void study_write_tally(struct text *text, const struct study_tally *tally)
{
    text_key_u64(text, "trials", tally->trials);
    for (uint8_t i = 0u; i < 4u; i++) {
        text_key_u64(text, detector_propensity_name(i), tally->by_propensity[i]);
    }
    text_key_u64(text, "loud", tally->loud);
    text_key_u64(text, "undecided", tally->undecided);
    text_key_u64(text, "refused", tally->refused);
    text_key_u64(text, "diverged", tally->diverged);
    text_key_u64(text, "caps", tally->caps);
    text_key_u64(text, "saturations", tally->saturations);
    text_key_u64(text, "gap_held", tally->gap_held);
    text_key_u64(text, "steps", tally->steps);
}

bool study_is_under_way(const struct console *console)
{
    return console->task == CONSOLE_TASK_SCAN || console->task == CONSOLE_TASK_MARGIN ||
           console->task == CONSOLE_TASK_OCCURRENCE;
}

void study_cut_short(struct console *console)
{
    console_begin_error(console, ERROR_STOPPED);
    study_write_tally(console->text, &console->study.tally);
    text_write(console->text, ": ");
    text_write(console->text, error_text(ERROR_STOPPED));
    console_end(console);
    console->study.is_trying = false;
    console->has_spent_stop = true;
    console_end_task(console);
}
