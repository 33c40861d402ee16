/* A board as a platform of the unit tests, and the tests of what only a board has: start-up, tick, clock, UART. The
 * host board runs them too. */
#include "base/assert.h"
#include "base/decimal.h"
#include "hal_board.h"
#include "hal_tick.h"
#include "hal_uart.h"
#include "tap.h"

enum { PERIODS = 400 };

static struct {
    volatile uint32_t calls;
    volatile uint32_t taken;      /* calls that ended a period */
    volatile uint32_t late;       /* calls that found the next period over at their end */
    volatile uint32_t at;         /* clock at the last call */
    volatile uint32_t stop_after; /* calls; 0: goes on */
    volatile uint32_t burn;       /* clock counts that a call takes */
} tick;

static volatile uint32_t filled_at_start = 0x5EA1u; /* volatile, or the compiler answers for it */
static volatile uint32_t cleared_at_start;

void app_tick(void)
{
    const uint32_t start = hal_clock_now();

    tick.at = start;
    tick.calls = tick.calls + 1u;
    tick.taken = tick.taken + (hal_tick_take() ? 1u : 0u);
    while (tick.burn != 0u && hal_clock_now() - start < tick.burn) {
    }
    tick.late = tick.late + (hal_tick_is_late() ? 1u : 0u);
    if (tick.calls == tick.stop_after) {
        hal_tick_stop();
    }
}

void tap_write(const char *text)
{
    while (*text != '\0') {
        hal_board_panic_write(*text++);
    }
}

void base_assert_failed(const char *file, unsigned line)
{
    char digits[DECIMAL_SIZE_MAX];

    (void)decimal_format_u64(line, digits);
    tap_write("Bail out! ");
    tap_write(file);
    tap_write(":");
    tap_write(digits);
    tap_write(": assertion failed\n");
    hal_exit(1);
}

static void forget_ticks(uint32_t stop_after)
{
    tick.calls = 0u;
    tick.taken = 0u;
    tick.late = 0u;
    tick.burn = 0u;
    tick.stop_after = stop_after;
}

static void wait_for_calls(uint32_t calls)
{
    while (tick.calls < calls) {
        hal_idle();
    }
}

/* The tick against the clock, which is a counter of its own: an emulator or a driver that loses interrupts shows
 * here. */
static void test_rate(uint32_t rate_hz)
{
    const uint32_t period = (hal_clock_hz() + rate_hz / 2u) / rate_hz;
    const uint32_t jitter = hal_clock_hz() / 125000u; /* 8 us for the way into the handler */
    const uint32_t asked_at = hal_clock_now();
    uint32_t first;
    uint32_t elapsed;
    bool is_running;

    forget_ticks(0u);
    hal_tick_start(rate_hz);
    wait_for_calls(1u);
    first = tick.at;
    is_running = hal_tick_is_running();
    while (tick.calls < 1u + PERIODS) {
        hal_idle();
        hal_tick_start(rate_hz); /* Runs already: changes nothing. */
        hal_tick_start(0u);      /* No rate at all: even less. */
    }
    hal_tick_stop();
    elapsed = tick.at - first;
    tap_note_number("rate in Hz", (float)rate_hz);
    (void)tap_check(is_running && !hal_tick_is_running(), "it runs from start to stop");
    (void)tap_check(first - asked_at >= period && first - asked_at < period + jitter,
                    "the first tick comes one period after the start");
    (void)tap_check(elapsed + jitter - (tick.calls - 1u) * period <= 2u * jitter, "there are as many ticks as periods");
    (void)tap_check(tick.taken == tick.calls, "each ends a period");
    (void)tap_check(tick.late == 0u, "none is late");
}

static void test_stop(void)
{
    forget_ticks(3u);
    hal_tick_start(1000u);
    wait_for_calls(3u);
    (void)tap_check(!hal_tick_is_running() && tick.calls == 3u, "a handler may stop the tick");
    hal_tick_start(1000u);
    hal_tick_start(10u);
    hal_tick_stop();
    hal_tick_trigger();
    (void)tap_check(tick.calls == 4u && tick.taken == 3u, "after a stop only a trigger calls the handler");
    hal_tick_start(HAL_TICK_HZ_MAX + 1);
    (void)tap_check(!hal_tick_is_running(), "a rate beyond the limits starts nothing");
}

static void test_trigger(void)
{
    forget_ticks(0u);
    hal_tick_trigger();
    (void)tap_check(tick.calls == 1u && tick.taken == 0u, "a trigger runs the handler once, and no period has ended");
    hal_tick_start(10u);
    hal_tick_trigger();
    hal_tick_trigger();
    (void)tap_check(tick.calls == 3u && tick.taken == 0u, "also beside a running timer");
    hal_tick_stop();
}

static void test_late(void)
{
    const uint32_t period = hal_clock_hz() / 1000u;

    if (!hal_board_is_emulated()) {
        return; /* Time stands still inside a handler there. */
    }
    forget_ticks(0u);
    hal_tick_start(1000u);
    wait_for_calls(2u);
    tick.burn = period + period / 4u;
    tick.stop_after = 4u;
    wait_for_calls(4u);
    (void)tap_check(tick.late == 2u, "a handler longer than its period is told so");
    (void)tap_check(tick.calls == 4u, "and its stop drops the tick that waits already");
}

static void test_board(void)
{
    static const char text[] = "# written by the UART\n";
    size_t sent = 0u;

    (void)tap_check(filled_at_start == 0x5EA1u && cleared_at_start == 0u, "memory is set up before main");
    (void)tap_check(hal_uart_baud(HAL_UART_CONSOLE) >= 9600u, "the console has a speed");
    while (sent < sizeof(text) - 1u) {
        sent += hal_uart_write(HAL_UART_CONSOLE, &text[sent], sizeof(text) - 1u - sent);
    }
    (void)tap_check(hal_uart_write(HAL_UART_CONSOLE, text, 0u) == 0u, "nothing is written where nothing is given");
    (void)tap_check(hal_uart_lost(HAL_UART_CONSOLE) == 0u && hal_uart_lost(HAL_UART_LINK) == 0u, "nothing is lost");
}

int main(void)
{
    tap_module("board");
    test_board();
    tap_module("tick");
    test_rate(1000u);
    test_rate(3000u);
    test_rate(10000u);
    test_stop();
    test_trigger();
    test_late();
    return unit_main();
}
