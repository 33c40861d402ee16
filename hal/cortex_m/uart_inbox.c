/* A ring between an interrupt that masks itself and main, which lets it in again. */
#include "cortex_m/uart_inbox.h"

#include "cortex_m/nvic.h"

void uart_inbox_open(struct uart_inbox *inbox, unsigned irq)
{
    inbox->irq = irq;
    ring_init(&inbox->ring, inbox->bytes, 1u, UART_INBOX_CAPACITY);
}

bool uart_inbox_has_room(struct uart_inbox *inbox)
{
    if (ring_fill(&inbox->ring) < UART_INBOX_CAPACITY) {
        return true;
    }
    inbox->is_held = true;
    nvic_disable(inbox->irq);
    return false;
}

void uart_inbox_put(struct uart_inbox *inbox, uint8_t byte)
{
    (void)ring_push(&inbox->ring, &byte); /* there was room, and main only makes more */
}

void uart_inbox_count_loss(struct uart_inbox *inbox) { inbox->lost++; }

size_t uart_inbox_take(struct uart_inbox *inbox, void *data, size_t size)
{
    uint8_t *const bytes = data;
    size_t count = 0u;

    while (count < size && ring_pop(&inbox->ring, &bytes[count])) {
        count++;
    }
    if (count > 0u && inbox->is_held) {
        inbox->is_held = false;
        nvic_enable(inbox->irq);
        nvic_pend(inbox->irq); /* the held byte has had its interrupt already */
    }
    return count;
}

bool uart_inbox_is_empty(const struct uart_inbox *inbox) { return ring_fill(&inbox->ring) == 0u; }
