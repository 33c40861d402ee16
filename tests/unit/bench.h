/* A whole console on a bench: the test is its main loop, its interrupt and its line. One at a time. */
#ifndef BENCH_H
#define BENCH_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "protocol/console.h"

enum { BENCH_BAUD = 115200, BENCH_HEARD_MAX = 32768 };

struct bench {
    struct executive executive;
    struct console console;
    struct text text;
    char heard[BENCH_HEARD_MAX]; /* what came back, 0-terminated; what is beyond it is only counted */
    size_t heard_size;
    uint32_t oks, errors, notices, samples; /* lines by their kind, since bench_listen_anew() */
    char last[4096];                        /* the last answer, without its line end */
};

extern struct bench bench;

/* A fresh one, defaults, echo off. */
void bench_open(void);

void bench_listen_anew(void);

/* One turn of the main loop: offers the bytes, polls, lets a period pass where the plant wants one, sends at most room
 * bytes. Returns how many were taken; *is_busy is what the program would look at before it sleeps. */
size_t bench_turn(const char *bytes, size_t size, size_t room, bool *is_busy);

/* Sends the text and turns until everything is answered; in free run, once more. Returns the last answer. */
const char *bench_say(const char *text);

/* Turns n times without saying anything. */
void bench_wait(unsigned turns);

/* Does the text start with, or hold, the part? */
bool bench_starts(const char *text, const char *part);
bool bench_holds(const char *text, const char *part);

#endif
