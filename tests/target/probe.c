/* A program whose single-letter commands misuse the board, for tests/board.t: every way to fault, floods in both
 * directions. Each answer is a line. */
#include "base/assert.h"
#include "base/decimal.h"
#include "hal_board.h"
#include "hal_tick.h"
#include "hal_uart.h"

enum {
    DEAF_TURNS = 10000000,
    FLOOD_BYTES = 300000,
    FLOOD_CHUNK = 1000,
    UNUSED_IRQ = 20,
    EXIT_ASKED = 7,
    EXIT_ASSERT = 8
};

static volatile uint32_t ticks;

void app_tick(void)
{
    (void)hal_tick_take();
    ticks = ticks + 1u;
}

void base_assert_failed(const char *file, unsigned line)
{
    (void)file;
    (void)line;
    hal_exit(EXIT_ASSERT);
}

static void write_all(const char *text, size_t size)
{
    while (size > 0u) {
        const size_t taken = hal_uart_write(HAL_UART_CONSOLE, text, size);

        text += taken;
        size -= taken;
        if (size > 0u) {
            hal_idle();
        }
    }
}

static void write_line(const char *name, uint32_t value)
{
    char digits[DECIMAL_SIZE_MAX];
    size_t length = 0u;

    while (name[length] != '\0') {
        length++;
    }
    write_all(name, length);
    write_all(digits, decimal_format_u64(value, digits));
    write_all("\r\n", 2u);
}

/* Everything up to a newline, but at first nothing for a while, longer than the receiver's ring lasts. */
static void swallow(void)
{
    uint32_t count = 0u;
    uint32_t sum = 0u;
    char byte = '\0';

    write_line("ready=", 1u);
    for (volatile uint32_t i = 0u; i < DEAF_TURNS; i = i + 1u) {
    }
    for (;;) {
        if (hal_uart_read(HAL_UART_CONSOLE, &byte, 1u) == 0u) {
            hal_idle();
            continue;
        }
        if (byte == '\n') {
            break;
        }
        count++;
        sum = sum * 31u + (uint8_t)byte;
    }
    write_line("count=", count);
    write_line("sum=", sum);
    write_line("lost=", hal_uart_lost(HAL_UART_CONSOLE));
}

static void flood(void)
{
    static char chunk[FLOOD_CHUNK];

    for (unsigned i = 0u; i < FLOOD_CHUNK; i++) {
        chunk[i] = i + 1u == FLOOD_CHUNK ? '\n' : 'x';
    }
    for (unsigned sent = 0u; sent < FLOOD_BYTES; sent += FLOOD_CHUNK) {
        write_all(chunk, FLOOD_CHUNK);
    }
}

/* Not a loop for the compiler: the result of the call is needed after it. */
static uint32_t overflow_stack(volatile uint32_t *depth)
{
    volatile uint32_t frame[32];

    frame[*depth % 32u] = *depth;
    *depth = *depth + 1u;
    return *depth == 0u ? 0u : overflow_stack(depth) + frame[*depth % 32u];
}

static void obey(char command)
{
    volatile uint32_t zero = 0u;

    switch (command) {
    case 'c':
        write_line("clock=", hal_clock_now());
        break;
    case 'p':
        swallow();
        break;
    case 'f':
        flood();
        break;
    case 't':
        hal_tick_start(10000u);
        break;
    case 'n':
        write_line("ticks=", ticks);
        break;
    case 'q':
        hal_exit(EXIT_ASKED);
    case '0':
        *(volatile uint32_t *)(uintptr_t)zero = 1u;
        break;
    case '1':
        write_line("read=", *(volatile uint32_t *)(0xF0000000u + (uintptr_t)zero));
        break;
    case '2':
        write_line("quotient=", hal_clock_now() / zero);
        break;
    case '3':
        write_line("depth=", overflow_stack(&zero));
        break;
    case '4':
        *(volatile uint32_t *)(0xE000E100u + (uintptr_t)zero) = (uint32_t)1 << UNUSED_IRQ;
        *(volatile uint32_t *)(0xE000E200u + (uintptr_t)zero) = (uint32_t)1 << UNUSED_IRQ;
        break;
    default:
        break;
    }
}

int main(void)
{
    char command;

    write_line("awake=", 1u);
    for (;;) {
        if (hal_uart_read(HAL_UART_CONSOLE, &command, 1u) == 1u) {
            obey(command);
        } else {
            hal_idle();
        }
    }
}
