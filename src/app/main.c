/* The program: a plant in the interrupt, console and link in main. */
#include "app/isr.h"
#include "app/version.h"
#include "base/text.h"
#include "hal_board.h"
#include "hal_tick.h"
#include "hal_uart.h"
#include "protocol/console.h"
#include "protocol/link.h"
#include "protocol/turn.h"
#include "protocol/work.h"

enum { CONSOLE_OUTPUT = 16384, LINK_OUTPUT = 4096, INPUT_CHUNK = 64 };

static struct executive executive;
static struct turn turn;
static struct work work;
static struct console console;
static struct link link;

/* A line: what was received and not taken yet, while the UART keeps the rest, and what is to be sent. */
static struct line_ends {
    uint8_t received[INPUT_CHUNK];
    size_t size, taken;
    uint32_t lost;
    struct text output;
} ends[HAL_UART_COUNT];

static uint8_t console_output[CONSOLE_OUTPUT];
static uint8_t link_output[LINK_OUTPUT];

/* Fetches bytes if there are none. Returns how many the line has lost since the last time. */
static uint32_t fetch(enum hal_uart port)
{
    struct line_ends *end = &ends[port];
    const uint32_t lost = hal_uart_lost(port) - end->lost;

    end->lost += lost;
    if (end->taken == end->size) {
        end->size = hal_uart_read(port, end->received, sizeof end->received);
        end->taken = 0u;
    }
    return lost;
}

static void pump_input(void)
{
    struct line_ends *end = &ends[HAL_UART_CONSOLE];

    console_lost(&console, fetch(HAL_UART_CONSOLE));
    end->taken += console_receive(&console, end->received + end->taken, end->size - end->taken);
    end = &ends[HAL_UART_LINK];
    link_lost(&link, fetch(HAL_UART_LINK));
    end->taken += link_receive(&link, end->received + end->taken, end->size - end->taken);
}

/* Returns true when all is sent, and nothing waits to be taken for want of room there. The UART is not asked to
 * interrupt for more: main must not sleep before. */
static bool pump_output(enum hal_uart port)
{
    struct line_ends *end = &ends[port];
    struct text *output = &end->output;
    size_t size;
    const uint8_t *bytes = text_peek(output, &size);

    if (size > 0u) {
        text_drop(output, hal_uart_write(port, bytes, size));
    }
    (void)text_peek(output, &size);
    return size == 0u && end->taken == end->size;
}

static void tell_the_ticks(void)
{
    const struct isr_ticks ticks = isr_ticks();

    work.ticks_counted = ticks.counted;
    work.ticks_expected = ticks.expected;
}

static bool poll(void)
{
    const bool console_is_busy = console_poll(&console);

    return link_poll(&link) || console_is_busy;
}

static void start(void)
{
    static struct identity identities[HAL_UART_COUNT];

    for (unsigned port = 0u; port < HAL_UART_COUNT; port++) {
        identities[port] = (struct identity){
            .version = version_name(),
            .build = version_build_id(),
            .board = hal_board_name(),
            .core = hal_board_core(),
            .is_emulated = hal_board_is_emulated(),
            .has_fpu = hal_board_has_fpu(),
            .has_link = hal_uart_baud(HAL_UART_LINK) > 0u,
            .baud = hal_uart_baud((enum hal_uart)port),
        };
    }
    executive_init(&executive, hal_board_has_fpu() ? ARITH_F32 : ARITH_Q27);
    isr_init(&executive);
    text_init(&ends[HAL_UART_CONSOLE].output, console_output, sizeof console_output);
    text_init(&ends[HAL_UART_LINK].output, link_output, sizeof link_output);
    console_init(&console, &executive, &turn, &work, &ends[HAL_UART_CONSOLE].output, &identities[HAL_UART_CONSOLE]);
    link_init(&link, &executive, &turn, &work, &ends[HAL_UART_LINK].output, &identities[HAL_UART_LINK]);
    console_banner(&console);
}

static void go_round(void)
{
    bool is_busy;

    pump_input();
    tell_the_ticks();
    is_busy = poll();
    isr_follow();
    if (is_busy) {
        (void)poll(); /* what the interrupt has done by now is answered at once */
    }
    is_busy = !pump_output(HAL_UART_CONSOLE) || is_busy;
    is_busy = !pump_output(HAL_UART_LINK) || is_busy;
    if (!is_busy) {
        hal_idle();
    }
}

int main(void)
{
    start();
    for (;;) {
        go_round();
    }
}
