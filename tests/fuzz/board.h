/* A board without hardware: what its lines and its timer do is what the input says. It keeps the contracts of hal/. */
#ifndef FUZZ_BOARD_H
#define FUZZ_BOARD_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "hal_uart.h"

/* Where in a round of the main loop the interrupt comes, if it is due. */
enum board_place { BOARD_AT_IDLE, BOARD_AT_READ, BOARD_BETWEEN_POLLS, BOARD_AT_WRITE, BOARD_PLACES };

enum { BOARD_UART_MAX = 8192, BOARD_ALL = 1 << 30 };

struct board_line {
    uint8_t received[BOARD_UART_MAX]; /* and not read by the program */
    size_t size, taken;
    uint32_t lost;
    size_t room; /* bytes a round that the other end reads: 0 it has stopped, BOARD_ALL */
    size_t left; /* of it, in this round */
};

struct board {
    struct board_line lines[HAL_UART_COUNT];
    enum board_place place;
    uint32_t steps_left; /* of the plant: beyond them the tick does not come */
    uint32_t busy;       /* clock counts from one look at the clock to the next */
    uint32_t missed;     /* periods that pass without a tick before the next one */
    bool is_late;        /* the next tick takes longer than a period */
    bool is_asleep;      /* the program had nothing to do, and only a byte will wake it */
};

extern struct board board;

/* Told of all that board_receive() is given, if there is one. */
extern void (*board_listener)(enum hal_uart port, const void *bytes, size_t size);

/* As after power on; everything is read at once, ticks come when the program is idle. */
void board_reset(void);

/* Bytes reach the UART, which loses those that it has no place for. */
void board_receive(enum hal_uart port, const void *bytes, size_t size);

/* Bytes get lost, and with them those that the program has not read. */
void board_lose(enum hal_uart port, uint32_t count);

/* A round begins. */
void board_begin_round(void);

/* The interrupt, if this is its place and it is due. */
void board_pass(enum board_place place);

/* Is anything received that the program has not read? */
bool board_has_input(void);

#endif
