/* The USART of STM32F2 and F4: implements hal_uart.h for as many ports as the board opens.
 *
 * Received bytes go by interrupt into a ring of 4 KiB a port. When it is full the port's interrupt is masked until main
 * has read: an emulator then holds the rest back, on silicon the overrun is counted. */
#ifndef STM32_USART_H
#define STM32_USART_H

#include <stdbool.h>
#include <stdint.h>

#include "hal_uart.h"

struct stm32_usart_wiring {
    uintptr_t base;
    unsigned irq;
    uint32_t clock_hz; /* of its bus */
    uint32_t baud;     /* clock_hz / baud must be 16 or more */
};

/* Sets the line up and lets its interrupt in; its clock and pins are the board's. [INIT] */
void stm32_usart_open(enum hal_uart port, const struct stm32_usart_wiring *wiring);

/* The handler of the port's interrupt. [ISR] */
void stm32_usart_isr(enum hal_uart port);

/* Nothing received that main has not read, no refused byte that the line would take now: asked with interrupts masked
 * before a sleep, whatever happens after it wakes the core. [MAIN] */
bool stm32_usart_is_quiet(enum hal_uart port);

/* One byte out of a line that is set up, waiting for it before and after. [ANY] */
void stm32_usart_put(const struct stm32_usart_wiring *wiring, char byte);

/* Is it set up? [ANY] */
bool stm32_usart_is_open(const struct stm32_usart_wiring *wiring);

/* Speed and frame alone, without interrupts, for a last word before stm32_usart_open(). [ANY] */
void stm32_usart_set_line(const struct stm32_usart_wiring *wiring);

#endif
