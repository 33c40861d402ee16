/* The commands that show and change the set. */
#include "base/compiler.h"
#include "model/presets.h"
#include "protocol/console_parts.h"
#include "protocol/values.h"

static const char no_parameter[] = "no parameter has this name; list shows them";

static void list_one(struct console *console, const struct params_info *info)
{
    struct text *text = console->text;

    console_begin_body(console);
    text_write(text, info->symbol);
    text_write(text, " = ");
    values_write(text, info, params_value(executive_params(console->executive), info));
    values_write_unit(text, info);
    text_write(text, " [");
    values_write_range(text, info, info->low, info->high);
    text_write(text, info->change == PARAMS_LIVE ? "] live  " : "] restart  ");
    text_write(text, info->help);
    console_end(console);
}

void settings_list(struct console *console)
{
    const struct token part = token_first(console->arguments);
    uint32_t count = 0u;
    bool by_symbol = false;

    if (token_next(part).length != 0u) {
        console_refuse_usage(console);
        return;
    }
    for (size_t i = 0u; i < params_count; i++) {
        by_symbol = by_symbol || token_is_held(part, params_table[i].symbol);
    }
    for (size_t i = 0u; i < params_count; i++) {
        if (token_is_held(part, by_symbol ? params_table[i].symbol : params_table[i].help)) {
            list_one(console, &params_table[i]);
            count++;
        }
    }
    console_begin_ok(console);
    text_key_u64(console->text, "parameters", count);
    console_end(console);
}

void settings_get(struct console *console)
{
    const struct token word = token_first(console->arguments);
    const struct params_info *info = params_find(word.start, word.length);

    if (!token_count_is(console->arguments, 1u)) {
        console_refuse_usage(console);
        return;
    }
    if (info == NULL) {
        console_refuse(console, ERROR_UNKNOWN_NAME, word, no_parameter);
        return;
    }
    console_begin_ok(console);
    text_key_text(console->text, info->symbol, "");
    values_write(console->text, info, params_value(executive_params(console->executive), info));
    text_key_text(console->text, "unit", "");
    values_write_unit_word(console->text, info);
    console_end(console);
}

/* What was typed for a parameter; empty if it was not named. */
static struct token typed_value(const struct console *console, const struct params_info *info)
{
    struct token word = token_first(token_is(token_first(console->command), "set") ? console->arguments : "");

    for (; word.length != 0u; word = token_next(token_next(word))) {
        if (params_find(word.start, word.length) == info) {
            return token_next(word);
        }
    }
    return word;
}

/* A parameter that is named twice leaves open what is wanted. Returns it where it comes first, or nothing. */
static struct token named_twice(const struct console *console)
{
    struct token word = token_first(console->arguments);

    for (; word.length != 0u; word = token_next(token_next(word))) {
        const struct params_info *info = params_find(word.start, word.length);

        for (struct token later = token_next(token_next(word)); later.length != 0u;
             later = token_next(token_next(later))) {
            if (info != NULL && params_find(later.start, later.length) == info) {
                return word;
            }
        }
    }
    return word;
}

static void refuse_problem(struct console *console, const struct params_problem *problem, const struct params *wanted)
{
    console_begin_error(console, problem->error);
    values_write_problem(console->text, problem, wanted, typed_value(console, problem->info));
    console_end(console);
}

void settings_refuse_value(struct console *console, enum error error, const struct params_info *info, struct token word)
{
    console_begin_error(console, error);
    text_key_text(console->text, info->symbol, "");
    token_write(console->text, word);
    text_write(console->text, ": ");
    if (error == ERROR_BAD_NUMBER) {
        text_write(console->text, error_text(error));
        text_write(console->text, "; ");
    }
    values_write_allowed(console->text, info, info->low, info->high);
    console_end(console);
}

/* A word that cannot be read as a parameter or as its value. */
static void refuse_word(struct console *console, enum error error, const struct params_info *info, struct token bad)
{
    if (error == ERROR_USAGE) {
        console_refuse_usage(console);
        return;
    }
    if (info == NULL) {
        console_refuse(console, error, bad, no_parameter);
        return;
    }
    settings_refuse_value(console, error, info, bad);
}

void settings_order(struct console *console, const struct params *params)
{
    struct params_problem problem = params_check(params); /* a pace out of all range has no load */

    if (problem.error != ERROR_OK) {
        refuse_problem(console, &problem, params);
        return;
    }
    if (!streaming_admits(console, params)) {
        return;
    }
    problem = executive_change(console->executive, params, true, &console->was_reset);
    if (problem.error != ERROR_OK) {
        refuse_problem(console, &problem, params);
        return;
    }
    console_start_task(console, CONSOLE_TASK_SETTING);
}

void settings_set(struct console *console)
{
    struct params params = *executive_params(console->executive);
    const struct params_info *info;
    struct token bad;
    enum error error;

    if (console_is_in_fault(console)) {
        console_refuse_fault(console);
        return;
    }
    bad = named_twice(console);
    if (bad.length != 0u) {
        console_refuse(console, ERROR_USAGE, bad, "named twice; once is enough");
        return;
    }
    error = presets_assign(&params, console->arguments, &info, &bad.start, &bad.length);
    if (error != ERROR_OK || token_count_is(console->arguments, 0u)) {
        refuse_word(console, error == ERROR_OK ? ERROR_USAGE : error, info, bad);
        return;
    }
    settings_order(console, &params);
}

/* Stops and resets to a set, the counters of the run included. */
static void restart(struct console *console, const struct params *params)
{
    struct params_problem problem;

    if (!streaming_admits(console, params)) {
        return;
    }
    problem = executive_reset(console->executive, params);
    if (problem.error != ERROR_OK) {
        refuse_problem(console, &problem, params);
        return;
    }
    console->was_reset = true;
    console_start_task(console, CONSOLE_TASK_SETTING);
}

static void list_presets(struct console *console)
{
    for (size_t i = 0u; i < presets_count; i++) {
        console_begin_body(console);
        text_write(console->text, presets_table[i].name);
        text_write(console->text, "  ");
        text_write(console->text, presets_table[i].help);
        console_end(console);
    }
    console_begin_ok(console);
    text_key_u64(console->text, "presets", presets_count);
    console_end(console);
}

void settings_preset(struct console *console)
{
    const struct token word = token_first(console->arguments);
    const struct preset *preset = presets_find(word.start, word.length);
    struct params params;

    if (word.length == 0u) {
        list_presets(console);
        return;
    }
    if (token_next(word).length != 0u) {
        console_refuse_usage(console);
        return;
    }
    if (preset == NULL) {
        console_refuse(console, ERROR_UNKNOWN_NAME, word, "no preset has this name; preset lists them");
        return;
    }
    presets_load(preset, &params);
    params.arithmetic = console->executive->arithmetic;
    restart(console, &params);
}

void settings_defaults(struct console *console)
{
    struct params params;

    params_default(&params);
    params.arithmetic = console->executive->arithmetic;
    restart(console, &params);
}

void settings_reset(struct console *console)
{
    const struct params params = *executive_params(console->executive);

    restart(console, &params);
}

/* What has been set, as it was understood. */
static void write_assigned(struct console *console, const struct params *params)
{
    for (struct token word = token_first(console->arguments); word.length != 0u; word = token_next(token_next(word))) {
        const struct params_info *info = params_find(word.start, word.length);

        text_key_text(console->text, info->symbol, "");
        values_write(console->text, info, params_value(params, info));
    }
}

void settings_answer(struct console *console, const struct executive_report *report)
{
    const struct token name = token_first(console->command);

    if (console->was_reset) {
        stream_count_anew(&console->stream, console->executive);
    }
    console_begin_ok(console);
    if (token_is(name, "set")) {
        write_assigned(console, executive_params(console->executive));
    } else if (token_is(name, "table")) {
        settings_write_table(console);
    } else if (token_is(name, "preset")) {
        text_put(console->text, ' ');
        token_write(console->text, token_first(console->arguments));
    }
    text_key_u64(console->text, "generation", report->generation);
    if (token_is(name, "set") || token_is(name, "table")) {
        text_key_text(console->text, "reset", console->was_reset ? "yes" : "no");
    }
    console_end(console);
}
