/* margin: how far from the border of squeal, parameter by parameter. */
#include "protocol/report.h"
#include "protocol/study_parts.h"
#include "protocol/values.h"

enum { BORDER_DIGITS = 6 };

#define FACTOR_LOW 1.001f
#define FACTOR_HIGH 1e6f

/* The parameter that was asked for; NULL for all. False if it is refused. */
static bool read_parameter(struct console *console, struct token *word, const struct params_info **info)
{
    *info = NULL;
    if (word->length == 0u || token_is(*word, "within") || study_is_span(*word)) {
        return true;
    }
    *info = study_read_parameter(console, *word);
    if (*info == NULL) {
        return false;
    }
    if (!margin_covers(executive_params(console->executive), *info)) {
        console_refuse(console, ERROR_NOT_SERVED, *word,
                       "margin takes the amounts that act once the profiles have come to rest");
        return false;
    }
    *word = token_next(*word);
    return true;
}

/* The parameter after the given one whose border is asked for, NULL if there is none. */
static const struct params_info *next_parameter(const struct params *params, const struct params_info *info)
{
    for (info = info == NULL ? params_table : info + 1; info < params_table + params_count; info++) {
        if (margin_covers(params, info)) {
            return info;
        }
    }
    return NULL;
}

void study_margin_obey(struct console *console)
{
    struct token word = token_first(console->arguments);
    struct study_margin study = {.base = *executive_params(console->executive), .factor = MARGIN_FACTOR_DEFAULT};
    struct trial_span span = {.transient = TRIAL_TRANSIENT_BRIEF, .window = TRIAL_WINDOW_DEFAULT, .is_brief = true};

    if (!read_parameter(console, &word, &study.only)) {
        return;
    }
    if (token_is(word, "within")) {
        word = token_next(word);
        if (!console_read_number(console, "within", word, FACTOR_LOW, FACTOR_HIGH, &study.factor)) {
            return;
        }
        word = token_next(word);
    }
    if (!study_read_span(console, word, &span)) {
        return;
    }
    for (const struct params_info *info = NULL; (info = next_parameter(&study.base, info)) != NULL;) {
        study.of++;
    }
    study.of = study.only != NULL ? 1u : study.of;
    console->study.margin = study;
    console->study.span = span;
    study_start(console, CONSOLE_TASK_MARGIN);
}

static void write_value(struct text *text, const char *prefix, const char *suffix, const struct params_info *info,
                        float value)
{
    text_put(text, ' ');
    text_write(text, prefix);
    text_write(text, suffix);
    text_put(text, '=');
    values_write(text, info, value);
}

/* " below=2000.2 below_quiet=1999.4 below_squeal=2001.1", or " below=none below_searched=187.5" */
static void write_side(struct text *text, const char *name, const struct margin *margin, const struct margin_side *side)
{
    if (side->has_border) {
        text_put(text, ' ');
        text_write(text, name);
        text_put(text, '=');
        text_f32(text, margin_border(side), BORDER_DIGITS);
        write_value(text, name, "_quiet", margin->info, side->quiet);
        write_value(text, name, "_squeal", margin->info, side->loud);
    } else {
        text_key_text(text, name, "none");
        write_value(text, name, "_searched", margin->info, side->searched);
    }
}

static void write_margin(struct console *console)
{
    const struct study_margin *study = &console->study.margin;
    const struct margin *margin = &study->margin;
    struct text *text = console->text;

    console_begin_body(console);
    text_write(text, "margin");
    text_key_u64(text, "done", study->done);
    text_key_u64(text, "of", study->of);
    write_value(text, margin->info->symbol, "", margin->info, margin->value);
    text_key_text(text, "unit", "");
    values_write_unit_word(text, margin->info);
    text_key_text(text, "now", margin->is_loud ? "squeal" : "quiet");
    write_side(text, "below", margin, &margin->sides[0]);
    write_side(text, "above", margin, &margin->sides[1]);
    text_key_text(text, "quiets", margin_way_name(margin_quiets(margin)));
    console_end(console);
}

static void answer(struct console *console)
{
    console_begin_ok(console);
    text_key_u64(console->text, "parameters", console->study.margin.done);
    text_key_text(console->text, "now", console->study.margin.is_loud ? "squeal" : "quiet");
    study_write_tally(console->text, &console->study.tally);
    console_end(console);
    console_end_task(console);
}

/* The set itself comes first; if it cannot be had, nothing can. */
static bool try_base(struct console *console)
{
    struct study *study = &console->study;
    struct params_problem problem;

    if (!study_try(study, &study->margin.base, &problem)) {
        return true;
    }
    if (problem.error != ERROR_OK) {
        console_begin_error(console, problem.error);
        values_write_problem(console->text, &problem, &study->margin.base, token_first(""));
        console_end(console);
        console_end_task(console);
        return true;
    }
    study->margin.has_base = true;
    study->margin.is_loud = trial_is_loud(&study->trial);
    return true;
}

/* Begins with the next parameter; false if there is none. */
static bool begin_next(struct study *study)
{
    struct study_margin *search = &study->margin;
    const struct params_info *before = search->done == 0u ? NULL : search->margin.info;
    const struct params_info *info = search->only != NULL ? search->only : next_parameter(&search->base, before);

    if (search->done == search->of) {
        return false;
    }
    margin_begin(&search->margin, &search->base, info, search->factor, search->is_loud);
    search->is_searching = margin_next(&search->margin, &study->wanted);
    return true;
}

static void end_parameter(struct console *console)
{
    console->study.margin.done++;
    console->study.margin.is_searching = false;
    write_margin(console);
}

bool study_margin_continue(struct console *console)
{
    struct study *study = &console->study;
    struct study_margin *search = &study->margin;
    struct params_problem problem;
    enum margin_answer answered;

    if (!search->has_base) {
        return try_base(console);
    }
    if (!search->is_searching) {
        if (!begin_next(study)) {
            answer(console);
        } else if (!search->is_searching) {
            end_parameter(console);
        }
        return true;
    }
    if (!study_try(study, &study->wanted, &problem)) {
        return true;
    }
    answered = problem.error != ERROR_OK ? MARGIN_REFUSED : trial_is_loud(&study->trial) ? MARGIN_LOUD : MARGIN_QUIET;
    margin_take(&search->margin, answered);
    if (!margin_next(&search->margin, &study->wanted)) {
        end_parameter(console);
    }
    return true;
}
