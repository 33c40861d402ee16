/* What takes longer than one look: orders that the interrupt has to take, and steps that it has to make. */
#include "base/decimal.h"
#include "protocol/console_parts.h"
#include "protocol/report.h"
#include "protocol/studying.h"

void console_start_task(struct console *console, enum console_task task)
{
    console->task = task;
    console->is_ending = false;
}

bool console_has_sample(const struct console *console)
{
    return console->turn->streams == TURN_CONSOLE && stream_has_sample(console->executive);
}

void console_end_task(struct console *console)
{
    console->task = CONSOLE_TASK_NONE;
    turn_leave(console->turn, TURN_CONSOLE);
}

void console_begin_steps(struct console *console, uint64_t steps)
{
    struct executive_report report;

    executive_stop(console->executive); /* takes back what an earlier stop may have left open */
    executive_report(console->executive, &report);
    console->steps.left = steps;
    console->steps.total = steps;
    console->steps.reached = report.now.step;
}

/* No more at a time than the samples of which fit between interrupt and main: whoever grants steps loses none. */
static void grant(struct console *console, uint32_t slice)
{
    const struct stream_setup *setup = &console->stream.setup;
    const uint64_t sampled = (uint64_t)setup->every * EXECUTIVE_SAMPLES;
    struct console_steps *steps = &console->steps;
    uint32_t count = steps->left < slice ? (uint32_t)steps->left : slice;

    if (setup->form != STREAM_OFF && sampled < count) {
        count = (uint32_t)sampled;
    }
    steps->left -= count;
    steps->reached += count;
    executive_grant(console->executive, count);
}

enum console_progress console_go_on(struct console *console, uint32_t slice, struct executive_report *report)
{
    struct executive *executive = console->executive;
    struct console_steps *steps = &console->steps;

    if (executive_has_order(executive)) {
        return CONSOLE_WAITS;
    }
    executive_report(executive, report);
    if (report->now.is_fault != 0u) {
        executive_stop(executive);
        if (!console->told.is_fault || console->told.epoch != report->now.epoch) {
            return CONSOLE_ADVANCES; /* the notice comes before the answer */
        }
        return console_has_sample(console) ? CONSOLE_WAITS : CONSOLE_FAULTS;
    }
    if (executive_credit(executive) != 0u || report->now.step != steps->reached) {
        return CONSOLE_WAITS;
    }
    if (console_has_sample(console)) {
        return CONSOLE_WAITS;
    }
    if (steps->left == 0u) {
        return CONSOLE_IS_DONE;
    }
    grant(console, slice);
    return CONSOLE_ADVANCES;
}

void console_refuse_fault(struct console *console)
{
    const struct scale *scale = &executive_plan(console->executive)->scale;
    struct executive_report report;

    executive_report(console->executive, &report);
    console_begin_error(console, ERROR_IN_FAULT);
    text_key_u64(console->text, "step", report.now.step);
    text_key_product(console->text, "t", report.now.step, scale->step_s, DECIMAL_DIGITS_EXACT);
    text_write(console->text, ": ");
    text_write(console->text, error_text(ERROR_IN_FAULT));
    console_end(console);
}

static bool continue_setting(struct console *console)
{
    struct executive_report report;

    /* After a reset the samples of the run before come first. */
    if (executive_has_order(console->executive) || (console->was_reset && console_has_sample(console))) {
        return false;
    }
    executive_report(console->executive, &report);
    settings_answer(console, &report);
    console_end_task(console);
    return true;
}

/* Steps that were cut short, or a stop by itself: the report is fresh, because stopping came with an order. */
static bool continue_stop(struct console *console)
{
    struct executive_report report;

    if (executive_has_order(console->executive) || console_has_sample(console)) {
        return false;
    }
    executive_report(console->executive, &report);
    if (console->task == CONSOLE_TASK_STOP) {
        console_begin_ok(console);
        text_key_u64(console->text, "step", report.now.step);
    } else {
        console_begin_error(console, ERROR_STOPPED);
        text_key_u64(console->text, "step", report.now.step);
        text_write(console->text, ": ");
        text_write(console->text, error_text(ERROR_STOPPED));
    }
    console_end(console);
    console_end_task(console);
    return true;
}

static void answer_step(struct console *console, const struct executive_report *report)
{
    const struct sim_plan *plan = executive_plan(console->executive);

    console_begin_ok(console);
    text_key_u64(console->text, "done", console->steps.total);
    for (unsigned i = 0u; i < SIGNALS_DEFAULT; i++) {
        text_key_text(console->text, signals_table[i].name, "");
        signals_append(console->text, (enum signal)i, &report->now, &plan->scale);
    }
    text_key_hex32(console->text, "hash", report->now.hash);
    console_end(console);
}

static void answer_measure(struct console *console, const struct executive_report *report)
{
    const struct sim_plan *plan = executive_plan(console->executive);

    console_begin_ok(console);
    text_key_text(console->text, "periods", "");
    for (const char *c = token_first(console->arguments).start; *c != '\0' && *c != ' '; c++) {
        text_put(console->text, *c);
    }
    report_write_measure(console->text, report, plan);
    console_end(console);
}

static bool continue_steps(struct console *console)
{
    struct executive_report report;

    switch (console_go_on(console, EXECUTIVE_GRANT_MAX, &report)) {
    case CONSOLE_ADVANCES:
        return true;
    case CONSOLE_FAULTS:
        console_refuse_fault(console);
        break;
    case CONSOLE_IS_DONE:
        if (console->task == CONSOLE_TASK_STEP) {
            answer_step(console, &report);
        } else {
            answer_measure(console, &report);
        }
        break;
    case CONSOLE_WAITS:
    default:
        return false;
    }
    console_end_task(console);
    return true;
}

/* The stream before has ended: its samples go out, then the new one begins. */
static bool continue_stream(struct console *console)
{
    if (executive_has_order(console->executive) || console_has_sample(console)) {
        return false;
    }
    streaming_begin(console);
    console_end_task(console);
    return true;
}

static bool continue_selftest(struct console *console)
{
    struct work *work = console->work;
    struct selftest *selftest = &work->selftest;

    if (selftest_go_on(selftest, work->ticks_counted, work->ticks_expected)) {
        console_begin_body(console);
        selftest_write(console->text, selftest);
        console_end(console);
    }
    if (!selftest_is_done(selftest)) {
        return true;
    }
    if (selftest->failed == 0u) {
        console_begin_ok(console);
    } else {
        console_begin_error(console, ERROR_SELFTEST);
    }
    text_key_u64(console->text, "passed", selftest->passed);
    text_key_u64(console->text, "failed", selftest->failed);
    console_end(console);
    console_end_task(console);
    return true;
}

/* A stop waits in line: what is under way ends here. */
static bool ends_early(struct console *console)
{
    switch (console->task) {
    case CONSOLE_TASK_STEP:
    case CONSOLE_TASK_MEASURE:
    case CONSOLE_TASK_DEMO:
    case CONSOLE_TASK_SELFTEST:
    case CONSOLE_TASK_STUDY:
        return console->stops_waiting > 0u || console->turn->is_wanted;
    case CONSOLE_TASK_NONE:
    case CONSOLE_TASK_SETTING:
    case CONSOLE_TASK_STOP:
    case CONSOLE_TASK_STREAM:
    default:
        return false;
    }
}

void console_halt(struct console *console)
{
    executive_halt(console->executive);
    console->is_ending = true;
}

bool console_task_continue(struct console *console)
{
    if (console->is_ending) {
        return continue_stop(console);
    }
    if (ends_early(console) && console->task == CONSOLE_TASK_STUDY) {
        studying_cut_short(console);
        return true;
    }
    if (ends_early(console) && !executive_has_order(console->executive)) {
        console_halt(console);
        return true;
    }
    switch (console->task) {
    case CONSOLE_TASK_SETTING:
        return continue_setting(console);
    case CONSOLE_TASK_STEP:
    case CONSOLE_TASK_MEASURE:
        return continue_steps(console);
    case CONSOLE_TASK_STREAM:
        return continue_stream(console);
    case CONSOLE_TASK_DEMO:
        return demo_continue(console);
    case CONSOLE_TASK_SELFTEST:
        return continue_selftest(console);
    case CONSOLE_TASK_STUDY:
        return studying_continue(console);
    case CONSOLE_TASK_NONE:
    case CONSOLE_TASK_STOP:
    default:
        return false;
    }
}
