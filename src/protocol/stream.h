/* Samples on their way out as text, decimated by count. What the line cannot carry is refused before it starts; what
 * gets lost all the same is counted and shows as a gap in the step column. */
#ifndef PROTOCOL_STREAM_H
#define PROTOCOL_STREAM_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/text.h"
#include "protocol/signals.h"
#include "protocol/token.h"
#include "sim/executive.h"

enum stream_form { STREAM_OFF, STREAM_CSV, STREAM_TELEPLOT };

enum {
    STREAM_LOAD_MAX_PERCENT = 80,
    STREAM_EVERY_MAX = 1000000000,
    STREAM_SAMPLE_MAX = 1024 /* bytes that one sample with every signal takes at most, in either form */
};

struct stream_setup {
    enum stream_form form;
    uint8_t signals[SIGNAL_COUNT]; /* enum signal, each at most once */
    size_t count;
    uint32_t every; /* steps a sample; 0 where none was asked for */
    bool is_forced; /* may overload the line */
};

/* What a setup costs. */
struct stream_load {
    uint32_t sample_bytes; /* at most */
    uint32_t percent;      /* of the line, at setup.every */
    uint32_t smallest;     /* every that fits */
};

struct stream {
    struct stream_setup setup;
    uint32_t dropped_before; /* by the ring, when the stream or the run began */
    uint32_t without_scale;  /* samples that a second reset has overtaken */
};

/* No stream. [INIT] */
void stream_init(struct stream *stream);

/* Reads "csv|teleplot [signals] [every N] [force]". USAGE, UNKNOWN_NAME or OUT_OF_RANGE, which means N, leave *setup
 * undefined; *bad is the word to blame. [MAIN] */
enum error stream_parse(const char *words, struct stream_setup *setup, struct token *bad);

/* steps_per_s is the rate of the plant, baud that of the line, at ten bits a byte. [MAIN, pure] */
struct stream_load stream_load(const struct stream_setup *setup, float steps_per_s, uint32_t baud);

/* "csv", "teleplot", "off". [MAIN] */
const char *stream_form_name(enum stream_form form);

/* The line of names with their units, "#step,t[s],x[m]"; nothing but for CSV. [MAIN] */
void stream_header(const struct stream *stream, struct text *text);

/* Is a sample waiting? [MAIN] */
bool stream_has_sample(const struct executive *executive);

/* Takes one sample and writes it: needs STREAM_SAMPLE_MAX of room. [MAIN] */
void stream_write(struct stream *stream, struct executive *executive, struct text *text);

/* Samples lost since stream_count_anew(). [MAIN] */
uint32_t stream_drops(const struct stream *stream, const struct executive *executive);
void stream_count_anew(struct stream *stream, const struct executive *executive);

#endif
