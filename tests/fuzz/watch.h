/* What must hold whatever the input: each breach ends the program. Frames and lines are counted and checked here by
 * code of its own, not by the firmware's. */
#ifndef FUZZ_WATCH_H
#define FUZZ_WATCH_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/compiler.h"
#include "hal_uart.h"

BASE_NORETURN void watch_failed(const char *file, int line, const char *what);

#define WATCH(cond)                                  \
    do {                                             \
        if (!(cond)) {                               \
            watch_failed(__FILE__, __LINE__, #cond); \
        }                                            \
    } while (0)

/* What the link's other end learns from the replies, to say the right thing next. */
struct watch_client {
    uint32_t step, crc;
    uint16_t step_sequence; /* of the last STEP that was answered */
};
extern struct watch_client watch_client;

/* Nothing seen yet. */
void watch_reset(void);

/* Bytes that console and link have taken, were told to be lost, and have sent. */
void watch_console_taken(const uint8_t *bytes, size_t size);
void watch_link_taken(const uint8_t *bytes, size_t size);
void watch_lost(enum hal_uart port, uint32_t count);
void watch_sent(enum hal_uart port, const uint8_t *bytes, size_t size);

/* The interrupt has been; the program sleeps until a byte comes; a round is over; so is the input. */
void watch_tick(void);
void watch_sleep(void);
void watch_round(void);
void watch_end(void);

/* Frames that the link has taken and not answered. */
unsigned watch_unanswered(void);

#endif
