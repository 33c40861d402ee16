/* The program: a plant in the interrupt, a console in main. */
#include "app/isr.h"
#include "app/version.h"
#include "base/text.h"
#include "hal_board.h"
#include "hal_tick.h"
#include "hal_uart.h"
#include "protocol/console.h"

enum { OUTPUT_SIZE = 16384, INPUT_CHUNK = 64 };

static struct executive executive;
static struct console console;
static struct text output;
static uint8_t output_bytes[OUTPUT_SIZE];

/* Received bytes that the console would not take yet; while it has some, the UART keeps the rest. */
static struct {
    uint8_t bytes[INPUT_CHUNK];
    size_t size, taken;
    uint32_t lost;
} input;

static void pump_input(void)
{
    const uint32_t lost = hal_uart_lost(HAL_UART_CONSOLE);

    if (lost != input.lost) {
        console_lost(&console, lost - input.lost);
        input.lost = lost;
    }
    if (input.taken == input.size) {
        input.size = hal_uart_read(HAL_UART_CONSOLE, input.bytes, sizeof input.bytes);
        input.taken = 0u;
    }
    input.taken += console_receive(&console, input.bytes + input.taken, input.size - input.taken);
}

/* Returns true when all is sent. The UART is not asked to interrupt for more: main must not sleep before. */
static bool pump_output(void)
{
    size_t size;
    const uint8_t *bytes = text_peek(&output, &size);

    if (size > 0u) {
        text_drop(&output, hal_uart_write(HAL_UART_CONSOLE, bytes, size));
    }
    (void)text_peek(&output, &size);
    return size == 0u;
}

static void tell_console_the_ticks(void)
{
    const struct isr_ticks ticks = isr_ticks();

    console.clock.ticks_counted = ticks.counted;
    console.clock.ticks_expected = ticks.expected;
}

int main(void)
{
    const struct console_identity identity = {
        .version = version_name(),
        .build = version_build_id(),
        .board = hal_board_name(),
        .core = hal_board_core(),
        .is_emulated = hal_board_is_emulated(),
        .baud = hal_uart_baud(HAL_UART_CONSOLE),
    };
    bool is_busy;

    executive_init(&executive, hal_board_has_fpu() ? ARITH_F32 : ARITH_Q27);
    isr_init(&executive);
    text_init(&output, output_bytes, sizeof output_bytes);
    console_init(&console, &executive, &output, &identity);
    console_banner(&console);
    for (;;) {
        pump_input();
        tell_console_the_ticks();
        is_busy = console_poll(&console);
        isr_follow();
        is_busy = console_poll(&console) || is_busy;
        if (pump_output() && !is_busy) {
            hal_idle();
        }
    }
}
