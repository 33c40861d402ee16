/* The CMSDK APB UART of the MPS2 and MPS3 boards: implements hal_uart.h for as many ports as the board opens.
 *
 * Received bytes go by interrupt into a ring of 4 KiB a port. When it is full the byte stays in the UART and the
 * interrupt is masked until main has read: an emulator then holds the rest back, on silicon the overrun is counted.
 */
#ifndef CMSDK_UART_H
#define CMSDK_UART_H

#include <stdbool.h>
#include <stdint.h>

#include "hal_uart.h"

struct cmsdk_uart_wiring {
    uintptr_t base;
    unsigned rx_irq;
    unsigned tx_irq;
    uint32_t clock_hz;
    uint32_t baud; /* clock_hz / baud must be 16 or more */
};

/* Sets the line up and lets its interrupts in. [INIT] */
void cmsdk_uart_open(enum hal_uart port, const struct cmsdk_uart_wiring *wiring);

/* The handlers of the port's two interrupts. [ISR] */
void cmsdk_uart_rx_isr(enum hal_uart port);
void cmsdk_uart_tx_isr(enum hal_uart port);

/* The handler where both share a line: rx_irq and tx_irq of the wiring are the same then. [ISR] */
void cmsdk_uart_isr(enum hal_uart port);

/* Nothing received that main has not read, no refused byte that the line would take now. With interrupts masked this
 * is the question to ask before a sleep: whatever happens after it wakes the core. [MAIN] */
bool cmsdk_uart_is_quiet(enum hal_uart port);

/* One byte out, waiting for the line before and after. Works before cmsdk_uart_open() too. [ANY] */
void cmsdk_uart_put(const struct cmsdk_uart_wiring *wiring, char byte);

#endif
