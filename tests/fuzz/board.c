/* hal/ without hardware. The interrupt's file is included to start its counts anew with every input. */
#include "board.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "app/isr.c"
#include "app/version.h"
#include "base/assert.h"
#include "watch.h"

enum { CLOCK_HZ = 25000000, BAUD = 115200 };

struct board board;
void (*board_listener)(enum hal_uart port, const void *bytes, size_t size);

static struct {
    uint32_t period; /* clock counts; 0 stopped */
    uint32_t now;
    bool has_ended; /* a period that the handler has not taken yet */
    bool has_run;   /* since the program was idle last: it may have left work behind */
} hardware;

void board_reset(void)
{
    memset(&timer, 0, sizeof timer);
    memset(&hardware, 0, sizeof hardware);
    for (unsigned port = 0u; port < HAL_UART_COUNT; port++) {
        struct board_line *line = &board.lines[port];

        line->size = line->taken = 0u;
        line->lost = 0u;
        line->room = line->left = BOARD_ALL;
    }
    board.place = BOARD_AT_IDLE;
    board.busy = board.missed = 0u;
    board.is_late = board.is_asleep = false;
}

void board_receive(enum hal_uart port, const void *bytes, size_t size)
{
    struct board_line *line = &board.lines[port];
    const size_t fitting = size < sizeof line->received - line->size ? size : sizeof line->received - line->size;

    if (board_listener != NULL) {
        board_listener(port, bytes, size);
    }
    memcpy(line->received + line->size, bytes, fitting);
    line->size += fitting;
    line->lost += (uint32_t)(size - fitting);
}

void board_lose(enum hal_uart port, uint32_t count)
{
    struct board_line *line = &board.lines[port];

    line->lost += count + (uint32_t)(line->size - line->taken);
    line->size = line->taken = 0u;
}

void board_begin_round(void)
{
    board.is_asleep = false;
    for (unsigned port = 0u; port < HAL_UART_COUNT; port++) {
        board.lines[port].left = board.lines[port].room;
    }
}

bool board_has_input(void)
{
    for (unsigned port = 0u; port < HAL_UART_COUNT; port++) {
        if (board.lines[port].taken != board.lines[port].size) {
            return true;
        }
    }
    return false;
}

void board_pass(enum board_place place)
{
    const uint32_t steps = timer.executive->in_force.substeps;

    if (place != board.place || hardware.period == 0u || board.steps_left < steps) {
        return;
    }
    board.steps_left -= steps;
    hardware.now += hardware.period * (1u + board.missed);
    board.missed = 0u;
    hardware.has_ended = true;
    hardware.has_run = true;
    app_tick();
    WATCH(!hardware.has_ended);
    board.is_late = false;
    watch_tick();
}

/* --- hal_board ---------------------------------------------------------------------------------------------------- */

const char *version_name(void) { return "0.0.0"; }
const char *version_build_id(void) { return "fuzz"; }
const char *hal_board_name(void) { return "fuzz"; }
const char *hal_board_core(void) { return "none"; }
bool hal_board_has_fpu(void) { return true; }
bool hal_board_is_emulated(void) { return false; }
void hal_flag_set(bool is_squealing) { (void)is_squealing; }

void hal_idle(void)
{
    if (hardware.period == 0u && !hardware.has_run) {
        board.is_asleep = true;
        watch_sleep();
    }
    hardware.has_run = false;
    board_pass(BOARD_AT_IDLE);
}

void base_assert_failed(const char *file, unsigned line)
{
    (void)fprintf(stderr, "%s:%u: assertion failed\n", file, line);
    abort();
}

/* --- hal_tick ----------------------------------------------------------------------------------------------------- */

void hal_tick_start(uint32_t rate_hz)
{
    WATCH(rate_hz >= HAL_TICK_HZ_MIN && rate_hz <= HAL_TICK_HZ_MAX);
    hardware.period = CLOCK_HZ / rate_hz;
}

void hal_tick_stop(void) { hardware.period = 0u; }

bool hal_tick_is_running(void) { return hardware.period != 0u; }

void hal_tick_trigger(void)
{
    app_tick();
    watch_tick();
}

bool hal_tick_take(void)
{
    const bool has_ended = hardware.has_ended;

    hardware.has_ended = false;
    return has_ended;
}

bool hal_tick_is_late(void) { return board.is_late; }

uint32_t hal_clock_now(void)
{
    hardware.now += board.busy;
    return hardware.now;
}

uint32_t hal_clock_hz(void) { return CLOCK_HZ; }

/* --- hal_uart ----------------------------------------------------------------------------------------------------- */

uint32_t hal_uart_baud(enum hal_uart port)
{
    (void)port;
    return BAUD;
}

size_t hal_uart_write(enum hal_uart port, const void *data, size_t size)
{
    struct board_line *line = &board.lines[port];
    const size_t sent = size < line->left ? size : line->left;

    line->left -= sent;
    watch_sent(port, data, sent);
    board_pass(BOARD_AT_WRITE);
    return sent;
}

size_t hal_uart_read(enum hal_uart port, void *data, size_t size)
{
    struct board_line *line = &board.lines[port];
    const size_t waiting = line->size - line->taken;
    const size_t count = size < waiting ? size : waiting;

    board_pass(BOARD_AT_READ);
    memcpy(data, line->received + line->taken, count);
    line->taken += count;
    if (line->taken == line->size) {
        line->size = line->taken = 0u;
    }
    return count;
}

uint32_t hal_uart_lost(enum hal_uart port) { return board.lines[port].lost; }
