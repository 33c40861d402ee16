/* The console's way in and out: bytes to lines, lines to commands, samples and notices to text. */
#include "protocol/console.h"

#include "base/assert.h"
#include "base/decimal.h"
#include "base/mem.h"
#include "protocol/commands.h"
#include "protocol/console_parts.h"

enum { ECHO_MAX = 3 };

void console_init(struct console *console, struct executive *executive, struct turn *turn, struct work *work,
                  struct text *text, const struct identity *identity)
{
    BASE_ASSERT(text->capacity >= 2u * CONSOLE_ANSWER_MAX && text->capacity >= CONSOLE_ANSWER_MAX + STREAM_SAMPLE_MAX);
    memset(console, 0, sizeof *console);
    console->executive = executive;
    console->turn = turn;
    console->work = work;
    console->text = text;
    console->identity = identity;
    line_init(&console->line);
    stream_init(&console->stream);
}

void console_banner(struct console *console)
{
    const struct identity *identity = console->identity;

    text_write(console->text, "squeal ");
    text_write(console->text, identity->version);
    text_write(console->text, " (");
    text_write(console->text, identity->build);
    text_write(console->text, ") on ");
    text_write(console->text, identity->board);
    text_write(console->text, ", ");
    text_write(console->text, identity->core);
    text_write(console->text, identity->is_emulated ? ", emulated" : "");
    text_write(console->text, ": a disc brake that squeals, in a chip");
    text_end_line(console->text);
    text_write(console->text, "squeal: type demo for the story, help for the commands");
    text_end_line(console->text);
}

static bool has_room(const struct console *console) { return text_room(console->text) >= CONSOLE_ANSWER_MAX; }

static bool is_stop(const struct line *line)
{
    return token_is(token_first(line->bytes), "stop") && token_count_is(line->bytes, 1u);
}

/* A line that ended, or the end of all lines, joins those that wait. */
static void queue_line(struct console *console, enum line_state state)
{
    const struct line *line = &console->line;
    const char *bytes = state == LINE_LAST ? "" : line->bytes;
    char *entry = console->waiting + console->waiting_size;
    size_t length = 0u;

    while (bytes[length] != '\0') {
        length++;
    }
    entry[0] = (char)state;
    memcpy(entry + 1, bytes, length + 1u);
    console->waiting_size += length + 2u;
    console->stops_waiting += state == LINE_DONE && is_stop(line) ? 1u : 0u;
}

/* Is there no place for one more of any length? */
static bool is_full(const struct console *console)
{
    return console->waiting_size + LINE_LENGTH_MAX + 2u > CONSOLE_WAITING_MAX;
}

/* A line goes before the next is looked at, so that echo and answers follow each other. Only while a task or the link
 * is at work lines gather, since one of them may say stop. */
static bool may_take(const struct console *console)
{
    const bool is_free = console->task == CONSOLE_TASK_NONE && console->turn->holder != TURN_LINK;
    const bool has_place = is_free ? console->waiting_size == 0u : !is_full(console);

    return has_place && text_room(console->text) >= CONSOLE_ANSWER_MAX + ECHO_MAX;
}

size_t console_receive(struct console *console, const uint8_t *bytes, size_t size)
{
    size_t taken = 0u;

    while (taken < size && may_take(console)) {
        const enum line_state state = line_take(&console->line, bytes[taken++], console->text);

        if (state != LINE_OPEN) {
            queue_line(console, state);
        }
    }
    return taken;
}

void console_lost(struct console *console, uint32_t count)
{
    console->uart_lost += count;
    if (count > 0u) {
        line_damage(&console->line);
    }
}

void console_begin_ok(struct console *console)
{
    const struct token name = token_first(console->command);

    line_make_way(&console->line, console->text);
    console->lines++;
    text_write(console->text, "ok ");
    for (size_t i = 0u; i < name.length; i++) {
        text_put(console->text, name.start[i]);
    }
}

void console_begin_error(struct console *console, enum error error)
{
    line_make_way(&console->line, console->text);
    console->lines++;
    console->rejected++;
    text_write(console->text, "error ");
    text_write(console->text, error_name(error));
}

void console_end(struct console *console) { text_end_line(console->text); }

void console_refuse(struct console *console, enum error error, struct token word, const char *why)
{
    console_begin_error(console, error);
    text_put(console->text, word.length != 0u ? ' ' : ':');
    for (size_t i = 0u; i < word.length; i++) {
        text_put(console->text, word.start[i]);
    }
    text_write(console->text, word.length != 0u ? ": " : " ");
    text_write(console->text, why);
    console_end(console);
}

void console_begin_body(struct console *console)
{
    line_make_way(&console->line, console->text);
    text_write(console->text, "- ");
}

/* Takes the oldest line and answers it, or starts the task that will. */
static void obey_next(struct console *console)
{
    const enum line_state state = (enum line_state)console->waiting[0];
    const enum error error = state == LINE_TOO_LONG ? ERROR_LINE_TOO_LONG : ERROR_LINE_DAMAGED;
    size_t length = 0u;

    while (console->waiting[1u + length] != '\0') {
        length++;
    }
    memcpy(console->command, console->waiting + 1, length + 1u);
    console->waiting_size -= length + 2u;
    memmove(console->waiting, console->waiting + length + 2u, console->waiting_size);
    if (state == LINE_DONE) {
        commands_obey(console);
    } else if (state == LINE_LAST) {
        executive_halt(console->executive); /* nobody is left to say stop */
    } else {
        console_refuse(console, error, token_first(""), error_text(error));
    }
}

/* Writes samples as far as there is room. Returns true if there are more: once the line takes what it has, room comes
 * without anybody asking. */
static bool write_samples(struct console *console)
{
    while (console_has_sample(console) && text_room(console->text) >= CONSOLE_ANSWER_MAX + STREAM_SAMPLE_MAX) {
        line_make_way(&console->line, console->text);
        stream_write(&console->stream, console->executive, console->text);
    }
    return console_has_sample(console);
}

static void write_notice(struct console *console, const struct sample *now, const char *key, const char *what)
{
    const struct scale *scale = &executive_plan(console->executive)->scale;

    line_make_way(&console->line, console->text);
    text_put(console->text, '!');
    text_key_text(console->text, key, what);
    text_key_u64(console->text, "step", now->step);
    text_key_product(console->text, "t", now->step, scale->step_s, DECIMAL_DIGITS_EXACT);
    text_key_f32(console->text, "v0", sample_value(now, now->disc) * scale->speed_m_per_s, DECIMAL_DIGITS_EXACT);
    text_end_line(console->text);
}

/* That somebody begins to steer, or ends, is no news; that the demand is too old is, and that it no longer is. What was
 * said of the propensity is void then. */
static void tell_input_state(struct console *console, const struct sample *now)
{
    if (watch_is_silent(now->watch) || watch_is_silent(console->told.watch)) {
        console->told.propensity = PROPENSITY_UNKNOWN;
        write_notice(console, now, "input_state", watch_state_name(now->watch));
    }
    console->told.watch = now->watch;
}

/* One notice a change. That nothing is known yet after a change of the set is no news. */
static void write_notices(struct console *console)
{
    const uint32_t version = handoff_version(&console->executive->handoff);
    struct executive_report report;
    const struct sample *now = &report.now;

    if (version == console->told.version || executive_has_order(console->executive)) {
        return; /* nothing new, or it may be of another scale than the plan */
    }
    console->told.version = version;
    executive_report(console->executive, &report);
    if (now->epoch != console->told.epoch) {
        console->told.epoch = now->epoch;
        console->told.propensity = PROPENSITY_UNKNOWN;
        console->told.watch = WATCH_OFF;
        console->told.is_fault = false;
    }
    if (now->watch != console->told.watch) {
        tell_input_state(console, now);
    }
    if (now->is_fault != 0u && !console->told.is_fault) {
        console->told.is_fault = true;
        console->told.propensity = now->propensity;
        write_notice(console, now, "fault", "domain");
    } else if (now->propensity != PROPENSITY_UNKNOWN && now->propensity != console->told.propensity) {
        console->told.propensity = now->propensity;
        write_notice(console, now, "propensity", detector_propensity_name(now->propensity));
    }
}

/* A study has a plant of its own. */
static bool needs_turn(const struct console *console)
{
    return console->task != CONSOLE_TASK_NONE && console->task != CONSOLE_TASK_STUDY;
}

/* May the next line be obeyed? A stop makes the other side end early. So do more lines than can wait, where the other
 * side is stuck: a stop behind them could not be seen, and the console would be dead until somebody reads the link. */
static bool has_turn(struct console *console)
{
    if (console->waiting_size > 0u && turn_take(console->turn, TURN_CONSOLE)) {
        return true;
    }
    if (console->stops_waiting > 0u || (is_full(console) && console->turn->is_stuck)) {
        turn_want(console->turn, TURN_CONSOLE);
    }
    return false;
}

bool console_poll(struct console *console)
{
    bool is_busy = write_samples(console);

    if (has_room(console)) {
        write_notices(console);
    }
    if (console->task != CONSOLE_TASK_NONE && has_room(console)) {
        is_busy = console_task_continue(console) || is_busy;
    }
    while (console->task == CONSOLE_TASK_NONE && has_room(console) && !executive_has_order(console->executive) &&
           has_turn(console)) {
        obey_next(console);
        is_busy = true;
    }
    if (!needs_turn(console)) {
        turn_leave(console->turn, TURN_CONSOLE);
    }
    return is_busy || executive_has_order(console->executive);
}
