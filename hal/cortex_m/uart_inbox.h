/* Received bytes of one UART on their way from its interrupt to main. When the ring is full the interrupt is masked at
 * the controller until main has read: an emulator then holds the rest back, on silicon the UART counts an overrun. */
#ifndef UART_INBOX_H
#define UART_INBOX_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/ring.h"

enum { UART_INBOX_CAPACITY = 4096 };

struct uart_inbox {
    unsigned irq;
    struct ring ring;
    uint8_t bytes[UART_INBOX_CAPACITY];
    volatile uint32_t lost; /* written by the interrupt alone */
    volatile bool is_held;  /* set by the interrupt as it masks itself, cleared by main before it unmasks */
};

/* The interrupt's number is that of the UART's receiver. It is not enabled here. [INIT] */
void uart_inbox_open(struct uart_inbox *inbox, unsigned irq);

/* Is there room for the byte that the UART holds? If not, it stays where it is and the interrupt is masked. [ISR] */
bool uart_inbox_has_room(struct uart_inbox *inbox);

/* A byte for which there is room. [ISR] */
void uart_inbox_put(struct uart_inbox *inbox, uint8_t byte);

/* The UART has lost a byte. [ISR] */
void uart_inbox_count_loss(struct uart_inbox *inbox);

/* Up to size bytes; returns how many there were. [MAIN] */
size_t uart_inbox_take(struct uart_inbox *inbox, void *data, size_t size);

/* [ANY] */
bool uart_inbox_is_empty(const struct uart_inbox *inbox);

#endif
