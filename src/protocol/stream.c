/* Setting up a stream, and writing its samples. */
#include "protocol/stream.h"

#include "base/decimal.h"
#include "base/fmath.h"
#include "base/mem.h"

enum {
    BITS_PER_BYTE = 10,  /* 8N1 on the wire */
    TELEPLOT_FRAME = 8,  /* >, two colons, the two bytes of the paragraph sign or |t, CR LF */
    TELEPLOT_PHASE = 18, /* >phase:::|xy, CR LF and something to spare */
    TELEPLOT_TIME = 16,
    TELEPLOT_UNIT = 4,
    MS_PER_S = 1000
};

void stream_init(struct stream *stream) { *stream = (struct stream){.setup = {.form = STREAM_OFF}}; }

const char *stream_form_name(enum stream_form form)
{
    static const char *const names[] = {"off", "csv", "teleplot"};

    return names[form];
}

static bool has_signal(const struct stream_setup *setup, enum signal signal)
{
    for (size_t i = 0u; i < setup->count; i++) {
        if (setup->signals[i] == signal) {
            return true;
        }
    }
    return false;
}

static void append_signal(struct stream_setup *setup, enum signal signal)
{
    if (!has_signal(setup, signal)) {
        setup->signals[setup->count++] = (uint8_t)signal;
    }
}

/* "x,xd,N"; in CSV step and t lead, wherever they were named. */
static enum error parse_signals(struct token list, struct stream_setup *setup, struct token *bad)
{
    const char *end = list.start + list.length;
    uint32_t named = 0u;

    if (setup->form == STREAM_CSV) {
        append_signal(setup, SIGNAL_STEP);
        append_signal(setup, SIGNAL_T);
    }
    while (list.start <= end) {
        struct token name = {list.start, 0u};
        enum signal signal;

        while (name.start + name.length < end && name.start[name.length] != ',') {
            name.length++;
        }
        *bad = name;
        signal = signals_find(name.start, name.length);
        if (signal == SIGNAL_COUNT) {
            return ERROR_UNKNOWN_NAME;
        }
        if ((named & (1u << (unsigned)signal)) != 0u) {
            return ERROR_USAGE;
        }
        named |= 1u << (unsigned)signal;
        append_signal(setup, signal);
        list.start += name.length + 1u;
    }
    return ERROR_OK;
}

static bool parse_form(struct token word, enum stream_form *form)
{
    if (token_is(word, "csv")) {
        *form = STREAM_CSV;
        return true;
    }
    *form = STREAM_TELEPLOT;
    return token_is(word, "teleplot");
}

enum error stream_parse(const char *words, struct stream_setup *setup, struct token *bad)
{
    struct token word = token_first(words);
    enum error error = ERROR_OK;

    *setup = (struct stream_setup){.form = STREAM_OFF};
    *bad = word;
    if (!parse_form(word, &setup->form)) {
        return ERROR_USAGE;
    }
    word = token_next(word);
    if (word.length != 0u && !token_is(word, "every") && !token_is(word, "force")) {
        error = parse_signals(word, setup, bad);
        word = token_next(word);
    }
    if (error == ERROR_OK && token_is(word, "every")) {
        word = token_next(word);
        *bad = word;
        error = word.length == 0u                                         ? ERROR_USAGE
                : token_number(word, 1u, STREAM_EVERY_MAX, &setup->every) ? ERROR_OK
                                                                          : ERROR_OUT_OF_RANGE;
        word = token_next(word);
    }
    if (error == ERROR_OK && token_is(word, "force")) {
        setup->is_forced = true;
        word = token_next(word);
    }
    if (error == ERROR_OK && word.length != 0u) {
        *bad = word;
        error = ERROR_USAGE;
    }
    for (unsigned i = 0u; setup->count == 0u && i < SIGNALS_DEFAULT; i++) {
        setup->signals[i] = (uint8_t)i;
    }
    setup->count = setup->count == 0u ? SIGNALS_DEFAULT : setup->count;
    return error;
}

/* x and xd together are the phase portrait, and not series of their own. */
static bool is_portrait(const struct stream_setup *setup)
{
    return has_signal(setup, SIGNAL_X) && has_signal(setup, SIGNAL_XD);
}

/* What of a setup becomes a series over time in Teleplot, besides the step, which always is one. */
static bool is_series(const struct stream_setup *setup, enum signal signal)
{
    if (signal == SIGNAL_STEP || signal == SIGNAL_T) {
        return false;
    }
    return !is_portrait(setup) || (signal != SIGNAL_X && signal != SIGNAL_XD);
}

static uint32_t name_length(enum signal signal)
{
    uint32_t length = 0u;

    while (signals_table[signal].name[length] != '\0') {
        length++;
    }
    return length;
}

static uint32_t csv_bytes(const struct stream_setup *setup)
{
    uint32_t bytes = 1u; /* a comma or the line's end behind each signal, and one byte more */

    for (size_t i = 0u; i < setup->count; i++) {
        bytes += signals_table[setup->signals[i]].width + 1u;
    }
    return bytes;
}

static uint32_t series_bytes(enum signal signal)
{
    return TELEPLOT_FRAME + TELEPLOT_TIME + TELEPLOT_UNIT + name_length(signal) + signals_table[signal].width;
}

static uint32_t teleplot_bytes(const struct stream_setup *setup)
{
    uint32_t bytes = series_bytes(SIGNAL_STEP);

    if (is_portrait(setup)) {
        bytes += TELEPLOT_PHASE + TELEPLOT_TIME;
        bytes += signals_table[SIGNAL_X].width;
        bytes += signals_table[SIGNAL_XD].width;
    }
    for (size_t i = 0u; i < setup->count; i++) {
        const enum signal signal = (enum signal)setup->signals[i];

        if (is_series(setup, signal)) {
            bytes += series_bytes(signal);
        }
    }
    return bytes;
}

struct stream_load stream_load(const struct stream_setup *setup, float steps_per_s, uint32_t baud)
{
    struct stream_load load;
    float lines; /* that would be needed to carry every step */

    load.sample_bytes = setup->form == STREAM_CSV ? csv_bytes(setup) : teleplot_bytes(setup);
    lines = (float)(load.sample_bytes * BITS_PER_BYTE) * steps_per_s / (float)baud;
    load.smallest = (uint32_t)(lines * 100.0f / (float)STREAM_LOAD_MAX_PERCENT);
    while ((float)load.smallest * (float)STREAM_LOAD_MAX_PERCENT < lines * 100.0f || load.smallest == 0u) {
        load.smallest++;
    }
    load.percent =
        (uint32_t)fmath_round_i32(lines * 100.0f / (float)(setup->every != 0u ? setup->every : load.smallest));
    return load;
}

static bool has_unit(const struct signal_info *info) { return info->unit[0] != '1'; }

void stream_header(const struct stream *stream, struct text *text)
{
    if (stream->setup.form != STREAM_CSV) {
        return;
    }
    for (size_t i = 0u; i < stream->setup.count; i++) {
        const struct signal_info *info = &signals_table[stream->setup.signals[i]];

        text_put(text, i == 0u ? '#' : ',');
        text_write(text, info->name);
        if (has_unit(info)) {
            text_put(text, '[');
            text_write(text, info->unit);
            text_put(text, ']');
        }
    }
    text_end_line(text);
}

bool stream_has_sample(const struct executive *executive) { return ring_fill(&executive->samples) != 0u; }

static void write_csv(const struct stream_setup *setup, struct text *text, const struct sample *sample,
                      const struct scale *scale)
{
    for (size_t i = 0u; i < setup->count; i++) {
        if (i > 0u) {
            text_put(text, ',');
        }
        signals_append(text, (enum signal)setup->signals[i], sample, scale);
    }
    text_end_line(text);
}

static void write_ms(struct text *text, const struct sample *sample, const struct scale *scale)
{
    text_product(text, sample->step * MS_PER_S, scale->step_s, DECIMAL_DIGITS_EXACT);
}

/* >phase:<x>:<xd>:<ms>|xy */
static void write_portrait(struct text *text, const struct sample *sample, const struct scale *scale)
{
    text_write(text, ">phase:");
    signals_append(text, SIGNAL_X, sample, scale);
    text_put(text, ':');
    signals_append(text, SIGNAL_XD, sample, scale);
    text_put(text, ':');
    write_ms(text, sample, scale);
    text_write(text, "|xy");
    text_end_line(text);
}

/* >N:<ms>:3000§N, >mode:<ms>:stick|t */
static void write_series(struct text *text, enum signal signal, const struct sample *sample, const struct scale *scale)
{
    const struct signal_info *info = &signals_table[signal];

    text_put(text, '>');
    text_write(text, info->name);
    text_put(text, ':');
    write_ms(text, sample, scale);
    text_put(text, ':');
    signals_append(text, signal, sample, scale);
    if (info->form == SIGNAL_FORM_MODE || info->form == SIGNAL_FORM_PROPENSITY || info->form == SIGNAL_FORM_WATCH ||
        info->form == SIGNAL_FORM_BITS) {
        text_write(text, "|t");
    } else if (has_unit(info)) {
        text_write(text, "\xc2\xa7");
        text_write(text, info->unit);
    }
    text_end_line(text);
}

static void write_teleplot(const struct stream_setup *setup, struct text *text, const struct sample *sample,
                           const struct scale *scale)
{
    write_series(text, SIGNAL_STEP, sample, scale);
    if (is_portrait(setup)) {
        write_portrait(text, sample, scale);
    }
    for (size_t i = 0u; i < setup->count; i++) {
        if (is_series(setup, (enum signal)setup->signals[i])) {
            write_series(text, (enum signal)setup->signals[i], sample, scale);
        }
    }
}

void stream_write(struct stream *stream, struct executive *executive, struct text *text)
{
    struct sample sample;
    const struct scale *scale;

    if (!ring_pop(&executive->samples, &sample)) {
        return;
    }
    scale = executive_scale(executive, sample.epoch);
    if (scale == NULL) {
        stream->without_scale++;
    } else if (stream->setup.form == STREAM_CSV) {
        write_csv(&stream->setup, text, &sample, scale);
    } else if (stream->setup.form == STREAM_TELEPLOT) {
        write_teleplot(&stream->setup, text, &sample, scale);
    }
}

uint32_t stream_drops(const struct stream *stream, const struct executive *executive)
{
    return executive->samples.dropped - stream->dropped_before + stream->without_scale;
}

void stream_count_anew(struct stream *stream, const struct executive *executive)
{
    stream->dropped_before = executive->samples.dropped;
    stream->without_scale = 0u;
}
