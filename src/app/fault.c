/* A broken invariant: say where, once, and end. Nothing goes on after a bug. */
#include "base/assert.h"
#include "base/decimal.h"
#include "hal_board.h"
#include "hal_tick.h"

enum { EXIT_ASSERT = 98 };

static void panic_write(const char *text)
{
    while (*text != '\0') {
        hal_board_panic_write(*text++);
    }
}

void base_assert_failed(const char *file, unsigned line)
{
    char number[DECIMAL_SIZE_MAX];

    hal_tick_stop();
    hal_flag_set(false);
    (void)decimal_format_u64(line, number);
    panic_write("\r\n! assert ");
    panic_write(file);
    panic_write(":");
    panic_write(number);
    panic_write("\r\n");
    hal_exit(EXIT_ASSERT);
}
