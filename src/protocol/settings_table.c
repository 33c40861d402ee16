/* The tables of breakpoints, a line of them at a time. */
#include "base/decimal.h"
#include "base/mem.h"
#include "protocol/console_parts.h"
#include "protocol/values.h"

static const char *const names[PARAMS_TABLES] = {"load", "speed"};

static bool find_table(struct token word, enum params_table_index *index)
{
    for (unsigned i = 0u; i < PARAMS_TABLES; i++) {
        if (token_is(word, names[i])) {
            *index = (enum params_table_index)i;
            return true;
        }
    }
    return false;
}

static void write_name(struct console *console, enum params_table_index index)
{
    text_put(console->text, ' ');
    text_write(console->text, names[index]);
    text_key_u64(console->text, "points", executive_params(console->executive)->tables[index].count);
}

static void show(struct console *console, enum params_table_index index)
{
    const struct params_points *table = &executive_params(console->executive)->tables[index];

    for (uint32_t i = 0u; i < table->count; i++) {
        console_begin_body(console);
        text_shortest(console->text, table->points[i].time_s);
        text_put(console->text, ' ');
        text_shortest(console->text, table->points[i].value);
        console_end(console);
    }
    console_begin_ok(console);
    write_name(console, index);
    console_end(console);
}

static bool read_number(struct console *console, const char *key, struct token word, float *value)
{
    if (decimal_parse_f32(word.start, word.length, value)) {
        return true;
    }
    console_begin_error(console, ERROR_BAD_NUMBER);
    text_key_text(console->text, key, "");
    token_write(console->text, word);
    text_write(console->text, ": ");
    text_write(console->text, error_text(ERROR_BAD_NUMBER));
    console_end(console);
    return false;
}

static void refuse_point(struct console *console, const struct params_problem *problem, struct token time,
                         struct token value, const struct params_info *values)
{
    const bool is_value = problem->info == values;

    console_begin_error(console, problem->error);
    text_key_text(console->text, is_value ? values->symbol : "t", "");
    token_write(console->text, is_value ? value : time);
    text_write(console->text, ": ");
    values_write_allowed(console->text, problem->info, problem->low, problem->high);
    console_end(console);
}

/* The words from here on, in pairs, behind what the table has; false and an answer if one of them is wrong. */
static bool append(struct console *console, enum params_table_index index, struct token word,
                   struct params_points *table)
{
    const struct params_info *values = params_table_values(index);

    while (word.length != 0u) {
        const struct token second = token_next(word);
        struct params_problem problem;
        struct params_point point;

        if (second.length == 0u) {
            console_refuse_usage(console);
            return false;
        }
        if (!read_number(console, "t", word, &point.time_s) ||
            !read_number(console, values->symbol, second, &point.value)) {
            return false;
        }
        problem = params_check_point(index, params_table_end_s(table), &point);
        if (problem.error != ERROR_OK) {
            refuse_point(console, &problem, word, second, values);
            return false;
        }
        if (table->count == PARAMS_POINTS_MAX) {
            console_refuse(console, ERROR_TABLE_FULL, word, error_text(ERROR_TABLE_FULL));
            return false;
        }
        table->points[table->count++] = point;
        word = token_next(second);
    }
    return true;
}

void settings_table(struct console *console)
{
    struct token word = token_next(token_first(console->arguments));
    struct params params = *executive_params(console->executive);
    enum params_table_index index;

    if (!find_table(token_first(console->arguments), &index)) {
        console_refuse_usage(console);
        return;
    }
    if (word.length == 0u) {
        show(console, index);
        return;
    }
    if (console_is_in_fault(console)) {
        console_refuse_fault(console);
        return;
    }
    if (!token_is(word, "more")) {
        params.tables[index] = (struct params_points){0};
    }
    if (token_is(word, "clear") || token_is(word, "more")) {
        const bool is_more = token_is(word, "more");

        word = token_next(word);
        if ((word.length != 0u) != is_more) {
            console_refuse_usage(console);
            return;
        }
    }
    if (append(console, index, word, &params.tables[index])) {
        settings_order(console, &params);
    }
}

void settings_write_table(struct console *console)
{
    enum params_table_index index = PARAMS_TABLE_LOAD;

    (void)find_table(token_first(console->arguments), &index);
    write_name(console, index);
}
