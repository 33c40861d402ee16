/* scan: a map over one parameter or two. */
#include "protocol/studying_parts.h"
#include "protocol/values.h"

/* "<symbol> <from> <to> <points> [log]"; *word moves past it. */
static bool read_axis(struct console *console, struct token *word, struct scan_axis *axis)
{
    axis->info = studying_read_parameter(console, *word);
    if (axis->info == NULL) {
        return false;
    }
    *word = token_next(*word);
    if (!studying_read_value(console, axis->info, *word, &axis->from)) {
        return false;
    }
    *word = token_next(*word);
    if (!studying_read_value(console, axis->info, *word, &axis->to)) {
        return false;
    }
    *word = token_next(*word);
    if (!studying_read_count(console, "points", *word, 1u, SCAN_POINTS_MAX, &axis->points)) {
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

void studying_scan(struct console *console)
{
    struct token word = token_first(console->arguments);
    struct trial_span span = {.transient = TRIAL_TRANSIENT_DEFAULT, .window = TRIAL_WINDOW_DEFAULT};
    struct scan scan = {.base = *executive_params(console->executive), .axis_count = 1u};

    if (!read_axis(console, &word, &scan.axes[0])) {
        return;
    }
    if (word.length != 0u && !studying_is_span(word)) {
        scan.axis_count = 2u;
        if (!read_axis(console, &word, &scan.axes[1])) {
            return;
        }
        if (scan.axes[0].info == scan.axes[1].info) {
            console_refuse(console, ERROR_USAGE, token_first(scan.axes[1].info->symbol), "one axis for a parameter");
            return;
        }
    }
    if (!studying_read_span(console, word, &span)) {
        return;
    }
    if (studying_start(console)) {
        study_begin_scan(&console->work->study, &scan, &span);
    }
}

void studying_write_point(struct console *console)
{
    const struct study *study = &console->work->study;
    const struct scan *scan = &study->its.scan;
    const uint32_t point = study->done - 1u;
    struct text *text = console->text;

    console_begin_body(console);
    text_write(text, "point");
    text_key_u64(text, "done", study->done);
    text_key_u64(text, "of", study->of);
    text_key_u64(text, "i", scan_place(scan, point, 0u));
    text_key_u64(text, "j", scan_place(scan, point, 1u));
    for (uint32_t i = 0u; i < scan->axis_count; i++) {
        text_key_text(text, scan->axes[i].info->symbol, "");
        values_write(text, scan->axes[i].info, params_value(&study->wanted, scan->axes[i].info));
    }
    studying_write_outcome(text, study);
    console_end(console);
}
