/* The program is included whole, with what crosses into console and link shown to the watch on the way. */
#include "firmware.h"

#include <string.h>

#include "board.h"
#include "watch.h"

static size_t show_console_receive(struct console *to, const uint8_t *bytes, size_t size)
{
    const size_t taken = console_receive(to, bytes, size);

    watch_console_taken(bytes, taken);
    return taken;
}

static void show_console_lost(struct console *to, uint32_t count)
{
    console_lost(to, count);
    watch_lost(HAL_UART_CONSOLE, count);
}

static size_t show_link_receive(struct link *to, const uint8_t *bytes, size_t size)
{
    const size_t taken = link_receive(to, bytes, size);

    watch_link_taken(bytes, taken);
    return taken;
}

static void show_link_lost(struct link *to, uint32_t count)
{
    link_lost(to, count);
    watch_lost(HAL_UART_LINK, count);
}

static bool show_link_poll(struct link *of)
{
    board_pass(BOARD_BETWEEN_POLLS);
    return link_poll(of);
}

int firmware_main(void);

#define main firmware_main
#define console_receive show_console_receive
#define console_lost show_console_lost
#define link_receive show_link_receive
#define link_lost show_link_lost
#define link_poll show_link_poll
#include "app/main.c"

const struct firmware firmware = {.executive = &executive,
                                  .console = &console,
                                  .link = &link,
                                  .turn = &turn,
                                  .console_text = &ends[HAL_UART_CONSOLE].output,
                                  .link_text = &ends[HAL_UART_LINK].output};

/* What a start leaves to the zeros of a program that has not run. */
void firmware_start(void)
{
    memset(&turn, 0, sizeof turn);
    memset(&work, 0, sizeof work);
    memset(ends, 0, sizeof ends);
    start();
}

void firmware_round(void) { go_round(); }

bool firmware_has_input(void)
{
    return ends[HAL_UART_CONSOLE].taken != ends[HAL_UART_CONSOLE].size ||
           ends[HAL_UART_LINK].taken != ends[HAL_UART_LINK].size;
}
