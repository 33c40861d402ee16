/* One thread. The tick has no interrupt: it runs inside hal_idle(), or in the console's read where main has gone round
 * without idling, so each round of the main loop meets at least one tick and the order of things follows from the input
 * alone. Time is virtual, one period a tick, as fast as the machine goes. With SQUEAL_REALTIME=1 in the environment
 * ticks and clock follow the monotonic clock instead.
 *
 * With SQUEAL_LINK=unix:PATH the link's other end is a socket there, for one peer at a time; with unix-connect:PATH
 * this process is the peer of another that listens there. Without it, or while nobody is connected, what is sent is
 * gone and nothing comes.
 */
#include "board.h"

#include <errno.h>
#include <stdlib.h>
#include <sys/select.h>
#include <time.h>
#include <unistd.h>

#include "hal_board.h"
#include "hal_tick.h"
#include "hal_uart.h"
#include "socket.h"

enum {
    NS_PER_S = 1000000000,
    NS_PER_COUNT = NS_PER_S / BOARD_CLOCK_HZ,
    CATCH_UP_TICKS = 1000, /* at most this many at once, what is further behind is given up */
    END_OF_TEXT = 0x04,    /* what a terminal's user types to end the input, and what is read once when it has ended */
    QUIET_ROUNDS = 16      /* idle calls after the end of input that prove that nothing is left to say */
};

static struct {
    bool is_realtime;
    uint32_t period_counts; /* 0: the tick is stopped */
    bool has_ended;         /* a period that the handler has not taken yet */
    bool has_ticked;        /* since main read the console last */
    bool has_run;           /* since the last call of hal_idle() that found the tick stopped */
    uint64_t next_ns;       /* of the monotonic clock, when the next tick is due */
    uint32_t virtual_counts;
} timer;

static struct {
    bool is_ended;   /* end of stdin */
    bool is_refused; /* stdout did not take all of the last write */
    unsigned quiet_rounds;
} console;

static uint64_t monotonic_ns(void)
{
    struct timespec now;

    (void)clock_gettime(CLOCK_MONOTONIC, &now); /* Cannot fail with this clock and a valid address. */
    return (uint64_t)now.tv_sec * NS_PER_S + (uint64_t)now.tv_nsec;
}

static uint64_t period_ns(void) { return (uint64_t)timer.period_counts * NS_PER_COUNT; }

static void tick_once(bool has_ended)
{
    timer.has_ended = has_ended;
    app_tick();
    timer.has_ended = false;
}

static void tick_next_virtual(void)
{
    timer.virtual_counts += timer.period_counts;
    tick_once(true);
}

static void tick_all_due(void)
{
    const uint64_t now_ns = monotonic_ns();

    for (unsigned i = 0u; i < CATCH_UP_TICKS && timer.period_counts != 0u && timer.next_ns <= now_ns; i++) {
        timer.next_ns += period_ns();
        tick_once(true);
    }
    if (timer.next_ns <= now_ns) {
        timer.next_ns = now_ns + period_ns();
    }
}

/* Waits for input, for room on a line that refused, or for the time to pass; without a time for as long as it takes.
 * Says whether the console has input (or its end). */
static bool wait_for_console(bool is_endless, uint64_t wait_ns)
{
    const struct timespec wait = {(time_t)(wait_ns / NS_PER_S), (long)(wait_ns % NS_PER_S)};
    fd_set readable;
    fd_set writable;
    int highest;

    FD_ZERO(&readable);
    FD_ZERO(&writable);
    highest = socket_watch(&readable, &writable);
    highest = highest > STDOUT_FILENO ? highest : STDOUT_FILENO;
    if (!console.is_ended) {
        FD_SET(STDIN_FILENO, &readable);
    }
    if (console.is_refused) {
        FD_SET(STDOUT_FILENO, &writable);
    }
    if (pselect(highest + 1, &readable, &writable, NULL, is_endless ? NULL : &wait, NULL) <= 0) {
        return false;
    }
    if (FD_ISSET(STDOUT_FILENO, &writable)) {
        console.is_refused = false;
    }
    return FD_ISSET(STDIN_FILENO, &readable) != 0;
}

static bool is_stdout_ready(void)
{
    const struct timespec no_wait = {0, 0};
    fd_set writable;

    FD_ZERO(&writable);
    FD_SET(STDOUT_FILENO, &writable);
    return pselect(STDOUT_FILENO + 1, NULL, &writable, NULL, &no_wait, NULL) > 0;
}

/* The image's own start-up code does this on other boards; here it comes before main() as well. */
__attribute__((constructor)) static void start_up(void) { hal_board_init(); }

void hal_board_init(void)
{
    const char *const realtime = getenv("SQUEAL_REALTIME");

    timer.is_realtime = realtime != NULL && realtime[0] == '1';
    timer.has_ticked = true;
    if (!socket_open(getenv("SQUEAL_LINK"))) {
        hal_exit(EXIT_FAILURE); /* nobody would find the link */
    }
}

const char *hal_board_name(void) { return BOARD_NAME; }

const char *hal_board_core(void) { return BOARD_CORE; }

bool hal_board_has_fpu(void) { return true; }

bool hal_board_is_emulated(void) { return false; }

void hal_exit(int code) { exit(code); }

void hal_board_panic_write(char byte)
{
    while (write(STDOUT_FILENO, &byte, 1) < 0 && (errno == EINTR || errno == EAGAIN)) {
    }
}

/* A process has no pin; the verdict is on the console too. */
void hal_flag_set(bool is_squealing) { (void)is_squealing; }

/* Input that has ended, on the link too, and a main that stays idle for a while, with the tick stopped: nothing can
 * ever happen again. */
static void idle_stopped(void)
{
    if (!console.is_ended || console.is_refused || !socket_is_over()) {
        (void)wait_for_console(true, 0u);
        return;
    }
    console.quiet_rounds++;
    if (console.quiet_rounds > QUIET_ROUNDS) {
        hal_exit(EXIT_SUCCESS);
    }
}

void hal_idle(void)
{
    uint64_t now_ns;

    timer.has_ticked = true;
    if (timer.period_counts == 0u) {
        if (!timer.has_run) {
            idle_stopped();
        }
        timer.has_run = false; /* The last tick may have left work behind after main's last look: one more round. */
        return;
    }
    console.quiet_rounds = 0u;
    if (!timer.is_realtime) {
        tick_next_virtual();
        return;
    }
    now_ns = monotonic_ns();
    if (timer.next_ns > now_ns) {
        (void)wait_for_console(false, timer.next_ns - now_ns);
    }
    tick_all_due();
}

void hal_tick_start(uint32_t rate_hz)
{
    uint32_t period_counts;

    if (rate_hz < HAL_TICK_HZ_MIN || rate_hz > HAL_TICK_HZ_MAX) {
        return;
    }
    period_counts = (BOARD_CLOCK_HZ + rate_hz / 2u) / rate_hz;
    if (period_counts == timer.period_counts) {
        return;
    }
    timer.period_counts = period_counts;
    timer.has_run = true;
    timer.next_ns = monotonic_ns() + period_ns();
}

void hal_tick_stop(void) { timer.period_counts = 0u; }

bool hal_tick_is_running(void) { return timer.period_counts != 0u; }

void hal_tick_trigger(void) { tick_once(false); }

bool hal_tick_take(void)
{
    const bool has_ended = timer.has_ended;

    timer.has_ended = false;
    return has_ended;
}

bool hal_tick_is_late(void) { return false; }

uint32_t hal_clock_now(void)
{
    return timer.is_realtime ? (uint32_t)(monotonic_ns() / NS_PER_COUNT) : timer.virtual_counts;
}

uint32_t hal_clock_hz(void) { return BOARD_CLOCK_HZ; }

uint32_t hal_uart_baud(enum hal_uart port)
{
    (void)port;
    return BOARD_BAUD;
}

size_t hal_uart_write(enum hal_uart port, const void *data, size_t size)
{
    ssize_t written = 0;

    if (size == 0u) {
        return size;
    }
    if (port == HAL_UART_LINK) {
        return socket_write(data, size);
    }
    console.quiet_rounds = 0u;
    if (is_stdout_ready()) {
        written = write(STDOUT_FILENO, data, size < BOARD_WRITE_MAX ? size : BOARD_WRITE_MAX);
    }
    console.is_refused = written < (ssize_t)size;
    return written > 0 ? (size_t)written : 0u;
}

/* A round of the main loop without hal_idle() must not hold the plant for ever. */
static void tick_of_a_busy_round(void)
{
    /* Virtual time waits for a reader that does not keep up; real time does not. */
    const bool may_tick = timer.is_realtime || !console.is_refused;

    if (!timer.has_ticked && timer.period_counts != 0u && may_tick) {
        if (timer.is_realtime) {
            tick_all_due();
        } else {
            tick_next_virtual();
        }
    }
    timer.has_ticked = false;
}

size_t hal_uart_read(enum hal_uart port, void *data, size_t size)
{
    ssize_t count;

    if (size == 0u) {
        return 0u;
    }
    if (port == HAL_UART_LINK) {
        return socket_read(data, size);
    }
    tick_of_a_busy_round();
    if (console.is_ended || !wait_for_console(false, 0u)) {
        return 0u;
    }
    count = read(STDIN_FILENO, data, size);
    console.is_ended = count == 0 || (count < 0 && errno != EINTR && errno != EAGAIN);
    if (console.is_ended) {
        *(uint8_t *)data = END_OF_TEXT;
        return 1u;
    }
    if (count < 0) {
        return 0u;
    }
    console.quiet_rounds = 0u;
    return (size_t)count;
}

uint32_t hal_uart_lost(enum hal_uart port)
{
    (void)port;
    return 0u;
}
