/* Console and link on a bench: the test is their main loop, their interrupt and their lines. One at a time. */
#ifndef BENCH_H
#define BENCH_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "protocol/console.h"
#include "protocol/link.h"

enum { BENCH_BAUD = 115200, BENCH_HEARD_MAX = 32768 };

struct bench {
    struct executive executive;
    struct turn turn;
    struct work work;
    struct console console;
    struct text text;
    struct link link;
    struct text link_text;
    struct frame_receiver controller; /* the link's other end */
    char heard[BENCH_HEARD_MAX];      /* what came back, 0-terminated; what is beyond it is only counted */
    size_t heard_size;
    uint32_t oks, errors, notices, samples; /* lines by their kind, since bench_listen_anew() */
    char last[4096];                        /* the last answer, without its line end */
};

extern struct bench bench;

/* False: nobody reads what the link sends. */
extern bool bench_link_is_read;

/* A fresh one, defaults, echo off. */
void bench_open(void);

void bench_listen_anew(void);

/* One turn of the main loop: offers the bytes, polls, lets a period pass where the plant wants one, sends at most room
 * bytes. Returns how many were taken; *is_busy is what the program would look at before it sleeps. */
size_t bench_turn(const char *bytes, size_t size, size_t room, bool *is_busy);

/* Sends the text and turns until everything is answered; in free run, once more. Returns the last answer. */
const char *bench_say(const char *text);

/* What a controller says and hears: a request's fields in, the reply's out. */
struct bench_frame {
    uint8_t type;
    uint16_t sequence;
    uint32_t step;
    size_t size;
    uint8_t payload[FRAME_PAYLOAD_MAX];
};

enum { BENCH_SAMPLES_MAX = 2048 };

extern struct bench_frame bench_samples[BENCH_SAMPLES_MAX]; /* that came since bench_open() */
extern size_t bench_sample_count;

enum { BENCH_RESULTS_MAX = 128 };

extern struct bench_frame bench_results[BENCH_RESULTS_MAX]; /* of studies, that came since bench_open() */
extern size_t bench_result_count;

/* Sends the frame and turns until something answers that is no sample or result, at most limit times. False if nothing
 * did. */
bool bench_ask(const struct bench_frame *request, struct bench_frame *reply, unsigned limit);

/* Offers bytes to the link and turns n times; true if a frame came that is no sample or result, the last in *reply. */
bool bench_link_turns(const uint8_t *bytes, size_t size, unsigned turns, struct bench_frame *reply);

/* Turns n times without saying anything. */
void bench_wait(unsigned turns);

/* Does the text start with, or hold, the part? */
bool bench_starts(const char *text, const char *part);
bool bench_holds(const char *text, const char *part);

#endif
