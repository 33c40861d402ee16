/* The console's studies: reading what they share, going on, telling what their trials came to. */
#include "protocol/report.h"
#include "protocol/studying_parts.h"
#include "protocol/values.h"

const struct params_info *studying_read_parameter(struct console *console, struct token word)
{
    const struct params_info *info = params_find(word.start, word.length);

    if (word.length == 0u) {
        console_refuse_usage(console);
    } else if (info == NULL) {
        console_refuse(console, ERROR_UNKNOWN_NAME, word, "no parameter has this name; list shows them");
    }
    return info;
}

bool studying_read_value(struct console *console, const struct params_info *info, struct token word, float *value)
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

bool studying_read_count(struct console *console, const char *key, struct token word, uint32_t low, uint32_t high,
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

bool studying_is_span(struct token word)
{
    return token_is(word, "transient") || token_is(word, "window") || token_is(word, "whole");
}

bool studying_read_span(struct console *console, struct token word, struct trial_span *span)
{
    for (; word.length != 0u; word = token_next(word)) {
        if (token_is(word, "whole")) {
            span->is_whole = true;
        } else if (token_is(word, "transient")) {
            word = token_next(word);
            if (!studying_read_count(console, "transient", word, 0u, TRIAL_PERIODS_MAX, &span->transient)) {
                return false;
            }
        } else if (token_is(word, "window")) {
            word = token_next(word);
            if (!studying_read_count(console, "window", word, TRIAL_WINDOW_MIN, TRIAL_PERIODS_MAX, &span->window)) {
                return false;
            }
        } else {
            console_refuse_usage(console);
            return false;
        }
    }
    return true;
}

bool studying_start(struct console *console)
{
    if (!turn_take_study(console->turn, TURN_CONSOLE)) {
        console_refuse(console, ERROR_BUSY, token_first(console->command), "a study of the link is under way");
        return false;
    }
    console_start_task(console, CONSOLE_TASK_STUDY);
    return true;
}

/* --- Results ------------------------------------------------------------------------------------------------------ */

static void write_trial(struct text *text, const struct trial *trial)
{
    const struct report_trial report = report_trial(trial);

    text_key_text(text, "propensity", detector_propensity_name(report.judged.propensity));
    report_write_class(text, &report.judged);
    report_field(text, "amplitude_um", report.motion.amplitude_um);
    report_field(text, "velocity_mm_s", report.motion.velocity_mm_s);
    report_field(text, "frequency_hz", report.motion.frequency_hz);
    report_field(text, "growth_per_s", report.judged.growth_per_s);
    text_key_text(text, "predicted", predictor_verdict_name((enum predictor_verdict)report.predicted));
    report_field(text, "predicted_growth_per_s", report.predicted_growth_per_s);
    text_key_text(text, "end", trial_end_name(trial->end));
    report_field(text, "periods", report.periods);
}

void studying_write_outcome(struct text *text, const struct study *study)
{
    if (study->problem.error == ERROR_OK) {
        write_trial(text, &study->trial);
    } else {
        text_key_text(text, "error", error_name(study->problem.error));
    }
}

void studying_write_tally(struct text *text, const struct study_tally *tally)
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

static void end(struct console *console)
{
    turn_leave_study(console->turn, TURN_CONSOLE);
    console_end_task(console);
}

static void write_result(struct console *console)
{
    switch ((enum study_kind)console->work->study.kind) {
    case STUDY_MARGIN:
        studying_write_borders(console);
        break;
    case STUDY_OCCURRENCE:
        studying_write_draw(console);
        break;
    case STUDY_SCAN:
    default:
        studying_write_point(console);
        break;
    }
}

static void answer(struct console *console)
{
    const struct study *study = &console->work->study;

    console_begin_ok(console);
    if (study->kind == STUDY_MARGIN) {
        studying_write_margin_answer(console->text, study);
    } else if (study->kind == STUDY_OCCURRENCE) {
        studying_write_share(console->text, study);
    }
    studying_write_tally(console->text, &study->tally);
    console_end(console);
    end(console);
}

static void refuse(struct console *console)
{
    const struct study *study = &console->work->study;

    console_begin_error(console, study->problem.error);
    values_write_problem(console->text, &study->problem, &study->its.margin.base, token_first(""));
    console_end(console);
    end(console);
}

bool studying_continue(struct console *console)
{
    switch (study_go_on(&console->work->study)) {
    case STUDY_HAS_RESULT:
        write_result(console);
        break;
    case STUDY_IS_DONE:
        answer(console);
        break;
    case STUDY_IS_REFUSED:
        refuse(console);
        break;
    case STUDY_TRIES:
    default:
        break;
    }
    return true;
}

void studying_cut_short(struct console *console)
{
    console_begin_error(console, ERROR_STOPPED);
    studying_write_tally(console->text, &console->work->study.tally);
    text_write(console->text, ": ");
    text_write(console->text, error_text(ERROR_STOPPED));
    console_end(console);
    console->has_spent_stop = true;
    end(console);
}
