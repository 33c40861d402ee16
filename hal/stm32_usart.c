/* Registers: RM0090 (STM32F405 reference manual), section 30.6 "USART registers". */
#include "stm32_usart.h"

#include "cortex_m/nvic.h"
#include "cortex_m/uart_inbox.h"

enum {
    SR_OVERRUN = 1 << 3, /* cleared by reading SR, then DR */
    SR_RECEIVED = 1 << 5,
    SR_SENT = 1 << 6,
    SR_TX_EMPTY = 1 << 7,
    CR1_RECEIVER = 1 << 2,
    CR1_TRANSMITTER = 1 << 3,
    CR1_RX_INTERRUPT = 1 << 5,
    CR1_TX_INTERRUPT = 1 << 7,
    CR1_ON = 1 << 13,
    CR1_LINE_ON = CR1_ON | CR1_TRANSMITTER | CR1_RECEIVER
};

struct stm32_usart_block {
    volatile uint32_t sr;
    volatile uint32_t dr;
    volatile uint32_t brr;
    volatile uint32_t cr1;
};

struct port {
    struct stm32_usart_block *block;
    uint32_t baud;
    struct uart_inbox inbox;
};

static struct port ports[HAL_UART_COUNT];

static struct stm32_usart_block *block_at(uintptr_t base) { return (struct stm32_usart_block *)base; }

void stm32_usart_set_line(const struct stm32_usart_wiring *wiring)
{
    struct stm32_usart_block *const block = block_at(wiring->base);

    block->brr = (wiring->clock_hz + wiring->baud / 2u) / wiring->baud;
    block->cr1 = CR1_LINE_ON;
}

bool stm32_usart_is_open(const struct stm32_usart_wiring *wiring)
{
    return (block_at(wiring->base)->cr1 & CR1_ON) != 0u;
}

void stm32_usart_open(enum hal_uart port, const struct stm32_usart_wiring *wiring)
{
    struct port *const own = &ports[port];

    own->block = block_at(wiring->base);
    own->baud = wiring->baud;
    uart_inbox_open(&own->inbox, wiring->irq);
    stm32_usart_set_line(wiring);
    own->block->cr1 = CR1_LINE_ON | CR1_RX_INTERRUPT;
    nvic_set_priority(wiring->irq, NVIC_PRIORITY_RECEIVE);
    nvic_enable(wiring->irq);
}

/* Takes the byte that the USART holds; false if there is none, or if it must stay where it is. Then the interrupt is
 * masked at the controller: an emulator's line stays raised until the byte is read, whatever the USART's own mask
 * says. */
static bool take_byte(struct port *own)
{
    const uint32_t state = own->block->sr;
    uint8_t byte;

    if ((state & (SR_RECEIVED | SR_OVERRUN)) == 0u || !uart_inbox_has_room(&own->inbox)) {
        return false;
    }
    if ((state & SR_OVERRUN) != 0u) {
        uart_inbox_count_loss(&own->inbox);
    }
    byte = (uint8_t)own->block->dr;
    if ((state & SR_RECEIVED) != 0u) {
        uart_inbox_put(&own->inbox, byte);
    }
    return true;
}

/* Until there is no byte more: an emulator that gives the next one during a read lowers the line after it, and that
 * byte would never be told. A refused byte's interrupt is only there to wake main. */
void stm32_usart_isr(enum hal_uart port)
{
    struct port *const own = &ports[port];

    own->block->cr1 = CR1_LINE_ON | CR1_RX_INTERRUPT;
    while (take_byte(own)) {
    }
}

bool stm32_usart_is_quiet(enum hal_uart port)
{
    const struct port *const own = &ports[port];
    const bool is_refused = (own->block->cr1 & CR1_TX_INTERRUPT) != 0u;

    return uart_inbox_is_empty(&own->inbox) && (!is_refused || (own->block->sr & SR_TX_EMPTY) == 0u);
}

void stm32_usart_put(const struct stm32_usart_wiring *wiring, char byte)
{
    struct stm32_usart_block *const block = block_at(wiring->base);

    while ((block->sr & SR_TX_EMPTY) == 0u) {
    }
    block->dr = (uint8_t)byte;
    while ((block->sr & SR_SENT) == 0u) {
    }
}

uint32_t hal_uart_baud(enum hal_uart port) { return ports[port].baud; }

size_t hal_uart_write(enum hal_uart port, const void *data, size_t size)
{
    struct stm32_usart_block *const block = ports[port].block;
    const uint8_t *const bytes = data;
    size_t count = 0u;

    while (count < size && (block->sr & SR_TX_EMPTY) != 0u) {
        block->dr = bytes[count++];
    }
    if (count < size) {
        block->cr1 = CR1_LINE_ON | CR1_RX_INTERRUPT | CR1_TX_INTERRUPT;
    }
    return count;
}

size_t hal_uart_read(enum hal_uart port, void *data, size_t size)
{
    return uart_inbox_take(&ports[port].inbox, data, size);
}

uint32_t hal_uart_lost(enum hal_uart port) { return ports[port].inbox.lost; }
