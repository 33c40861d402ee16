/* The dispatcher, and the commands that have no file of their own. */
#include "protocol/commands.h"

#include "base/compiler.h"
#include "base/decimal.h"
#include "protocol/console_parts.h"
#include "protocol/report.h"
#include "protocol/status.h"
#include "protocol/studying.h"

static const struct command {
    uint8_t id;
    const char *name, *arguments, *help;
} commands[] = {
#define COMMAND(id, name, arguments, help) {id, #name, arguments, help},
#include "protocol/commands.def"
#undef COMMAND
};

enum {
    PERIODS_MAX = 1000000,
    HELP_COLUMN = 19 /* of what a command does, where its arguments leave it free */
};

static const struct command *find_command(struct token name)
{
    for (size_t i = 0u; i < BASE_COUNT(commands); i++) {
        if (token_is(name, commands[i].name)) {
            return &commands[i];
        }
    }
    return NULL;
}

void console_refuse_usage(struct console *console)
{
    const struct command *command = find_command(token_first(console->command));

    console_begin_error(console, ERROR_USAGE);
    text_put(console->text, ' ');
    text_write(console->text, command->name);
    text_put(console->text, command->arguments[0] != '\0' ? ' ' : ':');
    text_write(console->text, command->arguments[0] != '\0' ? command->arguments : " takes no arguments");
    console_end(console);
}

void console_refuse_count(struct console *console, const char *key, struct token word, uint32_t low, uint32_t high)
{
    console_begin_error(console, ERROR_OUT_OF_RANGE);
    text_key_text(console->text, key, "");
    token_write(console->text, word);
    text_write(console->text, ": ");
    text_u64(console->text, low);
    text_write(console->text, " .. ");
    text_u64(console->text, high);
    text_write(console->text, ", a whole number");
    console_end(console);
}

bool console_read_number(struct console *console, const char *key, struct token word, float low, float high,
                         float *value)
{
    if (word.length == 0u) {
        console_refuse_usage(console);
        return false;
    }
    if (!decimal_parse_f32(word.start, word.length, value)) {
        console_refuse(console, ERROR_BAD_NUMBER, word, error_text(ERROR_BAD_NUMBER));
        return false;
    }
    if (!(*value >= low && *value <= high)) {
        console_begin_error(console, ERROR_OUT_OF_RANGE);
        text_key_text(console->text, key, "");
        token_write(console->text, word);
        text_write(console->text, ": ");
        text_shortest(console->text, low);
        text_write(console->text, " .. ");
        text_shortest(console->text, high);
        console_end(console);
        return false;
    }
    return true;
}

static void answer_plain(struct console *console)
{
    console_begin_ok(console);
    console_end(console);
}

static void tell_command(struct console *console, const struct command *command)
{
    size_t start;

    console_begin_body(console);
    start = console->text->head;
    text_write(console->text, command->name);
    text_write(console->text, command->arguments[0] != '\0' ? " " : "");
    text_write(console->text, command->arguments);
    text_write(console->text, "  ");
    while (console->text->head - start < HELP_COLUMN) {
        text_put(console->text, ' ');
    }
    text_write(console->text, command->help);
    console_end(console);
}

static void tell_signals(struct console *console)
{
    for (unsigned i = 0u; i < SIGNAL_COUNT; i++) {
        console_begin_body(console);
        text_write(console->text, "signal ");
        text_write(console->text, signals_table[i].name);
        text_write(console->text, signals_table[i].unit[0] != '1' ? ", " : "");
        text_write(console->text, signals_table[i].unit[0] != '1' ? signals_table[i].unit : "");
        text_write(console->text, "  ");
        text_write(console->text, signals_table[i].help);
        console_end(console);
    }
}

static void command_help(struct console *console)
{
    const struct token name = token_first(console->arguments);
    const struct command *command = find_command(name);

    if (name.length != 0u && command == NULL) {
        console_refuse(console, ERROR_UNKNOWN_COMMAND, name, error_text(ERROR_UNKNOWN_COMMAND));
        return;
    }
    for (size_t i = 0u; i < BASE_COUNT(commands); i++) {
        if (command == NULL || command == &commands[i]) {
            tell_command(console, &commands[i]);
        }
    }
    if (token_is(name, "stream")) {
        tell_signals(console);
    }
    answer_plain(console);
}

static void command_id(struct console *console)
{
    console_begin_ok(console);
    status_write_id(console->text, console);
    console_end(console);
}

static void command_echo(struct console *console)
{
    const struct token word = token_first(console->arguments);

    if (!token_count_is(console->arguments, 1u) || (!token_is(word, "on") && !token_is(word, "off"))) {
        console_refuse_usage(console);
        return;
    }
    console->line.has_echo = token_is(word, "on");
    console_begin_ok(console);
    text_write(console->text, console->line.has_echo ? " on" : " off");
    console_end(console);
}

static void command_demo(struct console *console) { demo_obey(console); }
static void command_list(struct console *console) { settings_list(console); }
static void command_get(struct console *console) { settings_get(console); }
static void command_set(struct console *console) { settings_set(console); }
static void command_table(struct console *console) { settings_table(console); }
static void command_preset(struct console *console) { settings_preset(console); }
static void command_defaults(struct console *console) { settings_defaults(console); }
static void command_reset(struct console *console) { settings_reset(console); }
static void command_stream(struct console *console) { streaming_obey(console); }

bool console_is_in_fault(const struct console *console)
{
    struct executive_report report;

    executive_report(console->executive, &report);
    return report.now.is_fault != 0u;
}

static void command_run(struct console *console)
{
    const struct sim_plan *plan = executive_plan(console->executive);
    enum error error;

    if (console_is_in_fault(console)) {
        console_refuse_fault(console);
        return;
    }
    error = executive_free_run(console->executive);
    if (error != ERROR_OK) {
        console_refuse(console, error, token_first(console->command), error_text(error));
        return;
    }
    console_begin_ok(console);
    report_field(console->text, "sigma", plan->params.tick_hz * plan->params.steps_per_tick * plan->scale.step_s);
    console_end(console);
}

static void command_stop(struct console *console)
{
    console->stops_waiting--;
    console_start_task(console, CONSOLE_TASK_STOP);
    if (console->has_spent_stop) {
        console->has_spent_stop = false;
        console->is_ending = true;
    } else {
        console_halt(console);
    }
}

/* May steps be granted, and how many? */
static bool read_count(struct console *console, uint32_t high, uint32_t *count)
{
    const struct token word = token_first(console->arguments);

    if (!token_count_is(console->arguments, 1u)) {
        console_refuse_usage(console);
        return false;
    }
    if (!token_number(word, 1u, high, count)) {
        console_refuse_count(console, token_is(token_first(console->command), "step") ? "n" : "periods", word, 1u,
                             high);
        return false;
    }
    if (console_is_in_fault(console)) {
        console_refuse_fault(console);
        return false;
    }
    if (executive_wants_tick(console->executive)) {
        console_refuse(console, ERROR_IS_RUNNING, token_first(console->command), error_text(ERROR_IS_RUNNING));
        return false;
    }
    return true;
}

static void command_step(struct console *console)
{
    uint32_t count;

    if (read_count(console, EXECUTIVE_GRANT_MAX, &count)) {
        console_begin_steps(console, count);
        console_start_task(console, CONSOLE_TASK_STEP);
    }
}

static void command_measure(struct console *console)
{
    const uint32_t steps_per_period = executive_plan(console->executive)->scale.steps_per_period;
    uint32_t periods;

    if (read_count(console, PERIODS_MAX, &periods)) {
        console_begin_steps(console, (uint64_t)periods * steps_per_period);
        executive_measure(console->executive, console->steps.total);
        console_start_task(console, CONSOLE_TASK_MEASURE);
    }
}

static void command_status(struct console *console)
{
    struct executive_report report;

    executive_report(console->executive, &report);
    console_begin_ok(console);
    status_write(console->text, console, &report);
    console_end(console);
}

static void command_verdict(struct console *console)
{
    struct executive_report report;

    executive_report(console->executive, &report);
    console_begin_ok(console);
    report_write_verdict(console->text, &report, executive_plan(console->executive));
    console_end(console);
}

static void command_input(struct console *console) { steering_obey(console); }

static void command_analyse(struct console *console) { analyse_obey(console); }
static void command_scan(struct console *console) { studying_scan(console); }
static void command_margin(struct console *console) { studying_margin(console); }
static void command_occurrence(struct console *console) { studying_occurrence(console); }

static void command_selftest(struct console *console)
{
    selftest_start(&console->work->selftest);
    console_start_task(console, CONSOLE_TASK_SELFTEST);
}

void commands_obey(struct console *console)
{
    const struct token name = token_first(console->command);
    const struct command *command = find_command(name);

    console->arguments = token_next(name).start;
    console->has_spent_stop = console->has_spent_stop && token_is(name, "stop");
    if (command == NULL) {
        console_refuse(console, ERROR_UNKNOWN_COMMAND, name, error_text(ERROR_UNKNOWN_COMMAND));
        return;
    }
    if (command->arguments[0] == '\0' && !token_count_is(console->arguments, 0u)) {
        console_refuse_usage(console);
        return;
    }
    switch (command->id) {
#define COMMAND(id, name, arguments, help) \
    case id:                               \
        command_##name(console);           \
        break;
#include "protocol/commands.def"
#undef COMMAND
    default:
        break;
    }
}
