/* The text console: bytes in, text out, hardware-free. The program's main loop turns it:
 *
 *     console_lost(&console, bytes that the UART lost since the last time)
 *     taken = console_receive(&console, bytes, size)         what was not taken is offered again
 *     is_busy = console_poll(&console)
 *     let the interrupt take an order, send text_peek(), sleep if nothing is left to send and the console is not busy
 *
 *   bytes -> line editor -> waiting lines -> command -> answer, or a task and later its answer -> text
 *                                                       samples, notices ----------------------->
 *
 * Nothing here waits. The specification is PROTOCOL.md. */
#ifndef PROTOCOL_CONSOLE_H
#define PROTOCOL_CONSOLE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/text.h"
#include "protocol/demo.h"
#include "protocol/identity.h"
#include "protocol/line.h"
#include "protocol/stream.h"
#include "protocol/turn.h"
#include "protocol/work.h"
#include "sim/executive.h"

enum {
    CONSOLE_ANSWER_MAX = 8192, /* bytes of room without which nothing is obeyed: no answer is longer */
    CONSOLE_WAITING_MAX = 512  /* bytes of lines that wait for the command before them */
};

/* What is under way and not yet answered. */
enum console_task {
    CONSOLE_TASK_NONE,
    CONSOLE_TASK_SETTING, /* an order of set, preset, defaults or reset */
    CONSOLE_TASK_STOP,
    CONSOLE_TASK_STEP,
    CONSOLE_TASK_MEASURE,
    CONSOLE_TASK_STREAM,
    CONSOLE_TASK_DEMO,
    CONSOLE_TASK_SELFTEST,
    CONSOLE_TASK_STUDY
};

/* Steps under way for a task. */
struct console_steps {
    uint64_t left;    /* still to be granted */
    uint64_t reached; /* step index at which what was granted is used up */
    uint64_t total;
};

struct console {
    struct executive *executive;
    struct text *text;
    struct turn *turn;
    struct work *work;
    const struct identity *identity;

    struct line line;
    char waiting[CONSOLE_WAITING_MAX]; /* lines, each a state (enum line_state), its text and a 0 */
    size_t waiting_size;
    uint32_t stops_waiting; /* lines among them that say stop */

    char command[LINE_LENGTH_MAX + 1]; /* being obeyed */
    const char *arguments;             /* inside it */
    enum console_task task;
    bool is_ending; /* a stop has cut the task short */
    bool was_reset; /* by the setting under way */
    struct console_steps steps;
    struct stream stream;
    struct stream_setup stream_wanted;
    struct demo demo;
    bool has_spent_stop; /* it ended a study: the stop itself is only answered */

    struct {              /* what the last notice said, since the last reset */
        uint32_t version; /* of the report that has been looked at */
        uint8_t epoch, propensity, watch;
        bool is_fault;
    } told;

    uint32_t lines;     /* answered */
    uint32_t rejected;  /* answered with an error */
    uint32_t uart_lost; /* bytes */
};

/* Binds to what it talks about and where it writes; text must hold at least twice CONSOLE_ANSWER_MAX. All must outlive
 * the console. [INIT] */
void console_init(struct console *console, struct executive *executive, struct turn *turn, struct work *work,
                  struct text *text, const struct identity *identity);

/* The first line after start. [MAIN] */
void console_banner(struct console *console);

/* Takes received bytes as long as it has room for a line and for its answer; returns how many. [MAIN] */
size_t console_receive(struct console *console, const uint8_t *bytes, size_t size);

/* So many more bytes were lost before they got here: the line in progress is damaged. [MAIN] */
void console_lost(struct console *console, uint32_t count);

/* Goes on with whatever can go on: samples, notices, the task under way, waiting lines. Returns true if it did
 * something after which the program should come again before it sleeps. [MAIN] */
bool console_poll(struct console *console);

#endif
