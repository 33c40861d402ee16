/* scan: a map over one parameter or two. */
#include "protocol/study_parts.h"
#include "protocol/values.h"

/* "<symbol> <from> <to> <points> [log]"; *word moves past it. */
static bool read_axis(struct console *console, struct token *word, struct scan_axis *axis)
{
    axis->info = study_read_parameter(console, *word);
    if (axis->info == NULL) {
        return false;
    }
    *word = token_next(*word);
    if (!study_read_value(console, axis->info, *word, &axis->from)) {
        return false;
    }
    *word = token_next(*word);
    if (!study_read_value(console, axis->info, *word, &axis->to)) {
        return false;
    }
    *word = token_next(*word);
    if (!study_read_count(console, "points", *word, 1u, SCAN_POINTS_MAX, &axis->points)) {
        return false;
    }
    *word = token_next(*word);
    axis->is_log = token_is(*word, "log");
    if (axis->is_log) {
        *word = token_next(*word);
    }
    if (scan_axis_check(axis) != ERROR_OK) {
        console_refuse(console, ERROR_USAGE, token_first(axis->info->symbol),
                       "log needs two ends of one sign, neither of them 0");
        return false;
    }
    return true;
}

void study_scan_obey(struct console *console)
{
    struct token word = token_first(console->arguments);
    struct trial_span span = {.transient = TRIAL_TRANSIENT_DEFAULT, .window = TRIAL_WINDOW_DEFAULT};
    struct scan scan = {.base = *executive_params(console->executive), .axis_count = 1u};

    if (!read_axis(console, &word, &scan.axes[0])) {
        return;
    }
    if (word.length != 0u && !study_is_span(word)) {
        scan.axis_count = 2u;
        if (!read_axis(console, &word, &scan.axes[1])) {
            return;
        }
        if (scan.axes[0].info == scan.axes[1].info) {
            console_refuse(console, ERROR_USAGE, token_first(scan.axes[1].info->symbol), "one axis for a parameter");
            return;
        }
    }
    if (!study_read_span(console, word, &span)) {
        return;
    }
    console->study.scan.scan = scan;
    console->study.span = span;
    console->study.scan.point = 0u;
    study_start(console, CONSOLE_TASK_SCAN);
}

static void write_point(struct console *console, const struct params_problem *problem)
{
    const struct study *study = &console->study;
    const struct scan *scan = &study->scan.scan;
    const uint32_t point = study->scan.point;
    struct text *text = console->text;

    console_begin_body(console);
    text_write(text, "point");
    text_key_u64(text, "done", point + 1u);
    text_key_u64(text, "of", scan_points(scan));
    text_key_u64(text, "i", scan_place(scan, point, 0u));
    text_key_u64(text, "j", scan_place(scan, point, 1u));
    for (uint32_t i = 0u; i < scan->axis_count; i++) {
        text_key_text(text, scan->axes[i].info->symbol, "");
        values_write(text, scan->axes[i].info, params_value(&study->wanted, scan->axes[i].info));
    }
    study_write_outcome(text, &study->trial, problem);
    console_end(console);
}

bool study_scan_continue(struct console *console)
{
    struct study *study = &console->study;
    struct study_scan *scan = &study->scan;
    struct params_problem problem;

    if (!study->is_trying) {
        scan_params(&scan->scan, scan->point, &study->wanted);
    }
    if (!study_try(study, &study->wanted, &problem)) {
        return true;
    }
    write_point(console, &problem);
    scan->point++;
    if (scan->point == scan_points(&scan->scan)) {
        console_begin_ok(console);
        study_write_tally(console->text, &study->tally);
        console_end(console);
        console_end_task(console);
    }
    return true;
}
