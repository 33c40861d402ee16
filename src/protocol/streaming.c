/* The command stream. */
#include "protocol/console_parts.h"

static struct stream_load load_at(const struct console *console, const struct stream_setup *setup,
                                  const struct params *params)
{
    return stream_load(setup, params->tick_hz * params->steps_per_tick, console->identity->baud);
}

static void answer(struct console *console)
{
    const struct stream_setup *setup = &console->stream.setup;
    const struct stream_load load = load_at(console, setup, executive_params(console->executive));

    console_begin_ok(console);
    text_put(console->text, ' ');
    text_write(console->text, stream_form_name(setup->form));
    if (setup->form != STREAM_OFF) {
        text_key_u64(console->text, "every", setup->every);
        text_key_u64(console->text, "line_bytes", load.sample_bytes);
        text_key_u64(console->text, "load", load.percent);
        text_put(console->text, '%');
        text_key_u64(console->text, "smallest", load.smallest);
    }
    console_end(console);
}

static bool is_overload(const struct stream_setup *setup, struct stream_load load)
{
    return setup->form != STREAM_OFF && setup->every != 0u && setup->every < load.smallest && !setup->is_forced;
}

static void refuse_overload(struct console *console, const struct stream_setup *setup, struct stream_load load,
                            const char *why)
{
    console_begin_error(console, ERROR_LINE_OVERLOAD);
    text_key_u64(console->text, "every", setup->every);
    text_key_u64(console->text, "line_bytes", load.sample_bytes);
    text_key_u64(console->text, "load", load.percent);
    text_put(console->text, '%');
    text_key_u64(console->text, "smallest", load.smallest);
    text_write(console->text, ": ");
    text_write(console->text, why);
    console_end(console);
}

bool streaming_admits(struct console *console, const struct params *params)
{
    const struct stream_setup *setup = &console->stream.setup;
    const struct stream_load load = load_at(console, setup, params);

    if (is_overload(setup, load)) {
        refuse_overload(console, setup, load, "at this pace; stream off, or stream anew with a larger every or force");
        return false;
    }
    return true;
}

/* The samples of the stream before are out, or there was none. */
void streaming_begin(struct console *console)
{
    console->stream.setup = console->stream_wanted;
    if (console->stream.setup.form == STREAM_OFF) {
        turn_leave_stream(console->turn, TURN_CONSOLE);
    }
    if (console->stream.setup.form != STREAM_OFF) {
        stream_count_anew(&console->stream, console->executive);
        executive_stream(console->executive, console->stream.setup.every);
    }
    answer(console);
    stream_header(&console->stream, console->text);
}

static void change(struct console *console)
{
    if (console->stream.setup.form == STREAM_OFF) {
        streaming_begin(console);
        return;
    }
    executive_stream(console->executive, 0u);
    console_start_task(console, CONSOLE_TASK_STREAM);
}

static void refuse(struct console *console, enum error error, struct token bad)
{
    if (error == ERROR_USAGE) {
        console_refuse_usage(console);
    } else if (error == ERROR_OUT_OF_RANGE) {
        console_refuse_count(console, "every", bad, 1u, STREAM_EVERY_MAX);
    } else {
        console_refuse(console, error, bad, "no signal has this name; help stream lists them");
    }
}

static void start(struct console *console)
{
    struct stream_setup setup;
    struct stream_load load;
    struct token bad;
    const enum error error = stream_parse(console->arguments, &setup, &bad);

    if (error != ERROR_OK) {
        refuse(console, error, bad);
        return;
    }
    load = load_at(console, &setup, executive_params(console->executive));
    if (is_overload(&setup, load)) {
        refuse_overload(console, &setup, load, error_text(ERROR_LINE_OVERLOAD));
        return;
    }
    if (!turn_take_stream(console->turn, TURN_CONSOLE)) {
        console_refuse(console, ERROR_BUSY, token_first("stream"), "the link streams");
        return;
    }
    setup.every = setup.every != 0u ? setup.every : load.smallest;
    console->stream_wanted = setup;
    change(console);
}

static void tell_header(struct console *console)
{
    console_begin_ok(console);
    text_write(console->text, " header");
    console_end(console);
    stream_header(&console->stream, console->text);
}

void streaming_obey(struct console *console)
{
    const struct token word = token_first(console->arguments);
    const bool is_alone = token_count_is(console->arguments, 1u);

    if (word.length == 0u) {
        answer(console);
    } else if (is_alone && token_is(word, "off")) {
        console->stream_wanted = (struct stream_setup){.form = STREAM_OFF};
        change(console);
    } else if (is_alone && token_is(word, "header")) {
        tell_header(console);
    } else {
        start(console);
    }
}
