/* Registers: Arm Cortex-M System Design Kit (DDI 0479), section 4.3 "APB UART". */
#include "cmsdk_uart.h"

#include "cortex_m/nvic.h"
#include "cortex_m/uart_inbox.h"

enum {
    STATE_TX_FULL = 1 << 0,
    STATE_RX_FULL = 1 << 1,
    STATE_RX_OVERRUN = 1 << 3, /* write 1 to clear */
    CTRL_LINE_ON = 3 << 0,     /* transmitter and receiver */
    CTRL_TX_INTERRUPT = 1 << 2,
    CTRL_RX_INTERRUPT = 1 << 3,
    INTERRUPT_TX = 1 << 0, /* write 1 to clear */
    INTERRUPT_RX = 1 << 1,
    BYTES_PER_INTERRUPT = 32
};

struct cmsdk_uart_block {
    volatile uint32_t data;
    volatile uint32_t state;
    volatile uint32_t ctrl;
    volatile uint32_t interrupt;
    volatile uint32_t bauddiv;
};

struct port {
    struct cmsdk_uart_block *block;
    uint32_t baud;
    struct uart_inbox inbox;
};

static struct port ports[HAL_UART_COUNT];

static struct cmsdk_uart_block *block_at(uintptr_t base) { return (struct cmsdk_uart_block *)base; }

static void line_on(struct cmsdk_uart_block *block, uint32_t clock_hz, uint32_t baud)
{
    block->bauddiv = (clock_hz + baud / 2u) / baud;
    block->ctrl = CTRL_LINE_ON | CTRL_RX_INTERRUPT;
}

void cmsdk_uart_open(enum hal_uart port, const struct cmsdk_uart_wiring *wiring)
{
    struct port *const own = &ports[port];

    own->block = block_at(wiring->base);
    own->baud = wiring->baud;
    uart_inbox_open(&own->inbox, wiring->rx_irq);
    line_on(own->block, wiring->clock_hz, wiring->baud);
    nvic_set_priority(wiring->tx_irq, NVIC_PRIORITY_LOW);
    nvic_set_priority(wiring->rx_irq, NVIC_PRIORITY_RECEIVE); /* last: it counts where both share a line */
    nvic_enable(wiring->rx_irq);
    nvic_enable(wiring->tx_irq);
    (void)own->block->data; /* An emulator that has bytes for us gives the first one when it is asked for it. */
}

/* Takes the byte that the UART holds; false if there is none, or if it must stay where it is. */
static bool take_byte(struct port *own)
{
    const uint32_t state = own->block->state;

    if ((state & STATE_RX_OVERRUN) != 0u) {
        own->block->state = STATE_RX_OVERRUN;
        uart_inbox_count_loss(&own->inbox);
    }
    if ((state & STATE_RX_FULL) == 0u || !uart_inbox_has_room(&own->inbox)) {
        return false;
    }
    uart_inbox_put(&own->inbox, (uint8_t)own->block->data);
    return true;
}

/* The UART holds one byte, so on silicon one is read an interrupt. An emulator may have the next one there at once, and
 * an interrupt costs it more than a look. The order matters: the flag is latched anew for each byte, and cleared after
 * a read it could take the next byte's interrupt with it. */
void cmsdk_uart_rx_isr(enum hal_uart port)
{
    struct port *const own = &ports[port];

    own->block->interrupt = INTERRUPT_RX;
    for (unsigned count = 0u; count < BYTES_PER_INTERRUPT && take_byte(own); count++) {
    }
}

/* Nothing to send from here: that it wakes main is its whole purpose. */
void cmsdk_uart_tx_isr(enum hal_uart port)
{
    struct cmsdk_uart_block *const block = ports[port].block;

    block->ctrl = CTRL_LINE_ON | CTRL_RX_INTERRUPT;
    block->interrupt = INTERRUPT_TX;
}

void cmsdk_uart_isr(enum hal_uart port)
{
    if ((ports[port].block->interrupt & INTERRUPT_TX) != 0u) {
        cmsdk_uart_tx_isr(port);
    }
    cmsdk_uart_rx_isr(port); /* always: a byte that was held comes without a flag */
}

bool cmsdk_uart_is_quiet(enum hal_uart port)
{
    const struct port *const own = &ports[port];
    const bool is_refused = (own->block->ctrl & CTRL_TX_INTERRUPT) != 0u;

    return uart_inbox_is_empty(&own->inbox) && (!is_refused || (own->block->state & STATE_TX_FULL) != 0u);
}

void cmsdk_uart_put(const struct cmsdk_uart_wiring *wiring, char byte)
{
    struct cmsdk_uart_block *const block = block_at(wiring->base);

    if ((block->ctrl & CTRL_LINE_ON) == 0u) {
        line_on(block, wiring->clock_hz, wiring->baud);
    }
    while ((block->state & STATE_TX_FULL) != 0u) {
    }
    block->data = (uint8_t)byte;
    while ((block->state & STATE_TX_FULL) != 0u) {
    }
}

uint32_t hal_uart_baud(enum hal_uart port) { return ports[port].baud; }

size_t hal_uart_write(enum hal_uart port, const void *data, size_t size)
{
    struct cmsdk_uart_block *const block = ports[port].block;
    const uint8_t *const bytes = data;
    size_t count = 0u;

    while (count < size && (block->state & STATE_TX_FULL) == 0u) {
        block->data = bytes[count++];
    }
    if (count < size) {
        block->ctrl = CTRL_LINE_ON | CTRL_RX_INTERRUPT | CTRL_TX_INTERRUPT;
    }
    return count;
}

size_t hal_uart_read(enum hal_uart port, void *data, size_t size)
{
    return uart_inbox_take(&ports[port].inbox, data, size);
}

uint32_t hal_uart_lost(enum hal_uart port) { return ports[port].inbox.lost; }
