/* The least that an image on an MPS2 board can do with the link: for as many bytes as a STEP has it sends as many as
 * the reply has. No interrupt is taken; it sleeps until a byte comes. What the firmware needs beyond this is its
 * own. */
#include "base/assert.h"
#include "cortex_m/nvic.h"
#include "hal_board.h"
#include "hal_tick.h"
#include "hal_uart.h"
#include "mps2/mps2.h"
#include "wire.h"

enum { STATE_TX_FULL = 1 << 0, STATE_RX_FULL = 1 << 1, INTERRUPT_RX = 1 << 1 };

/* Arm DDI 0479, section 4.3. */
struct uart {
    volatile uint32_t data;
    volatile uint32_t state;
    volatile uint32_t ctrl;
    volatile uint32_t interrupt;
};

void app_tick(void) { (void)hal_tick_take(); }

void base_assert_failed(const char *file, unsigned line)
{
    (void)file;
    (void)line;
    hal_exit(1);
}

static void swallow(struct uart *uart, size_t count)
{
    while (count > 0u) {
        nvic_unpend(MPS2_UART1_RX_IRQ);
        uart->interrupt = INTERRUPT_RX;
        if ((uart->state & STATE_RX_FULL) == 0u) {
            nvic_sleep();
        }
        for (; count > 0u && (uart->state & STATE_RX_FULL) != 0u; count--) {
            (void)uart->data;
        }
    }
}

static void answer(struct uart *uart)
{
    for (unsigned i = 0u; i < WIRE_STEP_ANSWERED; i++) {
        while ((uart->state & STATE_TX_FULL) != 0u) {
        }
        uart->data = i;
    }
}

int main(void)
{
    struct uart *const uart = (struct uart *)MPS2_UART1_BASE;
    uint8_t early[WIRE_STEP_ASKED];

    nvic_mask();
    swallow(uart, WIRE_STEP_ASKED - hal_uart_read(HAL_UART_LINK, early, sizeof early)); /* before the mask */
    for (;;) {
        answer(uart);
        swallow(uart, WIRE_STEP_ASKED);
    }
}
