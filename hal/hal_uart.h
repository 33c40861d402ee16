/* Byte streams to the outside. 8N1. UART 0 is the console, UART 1 the link. Nothing here ever waits. */
#ifndef HAL_UART_H
#define HAL_UART_H

#include <stddef.h>
#include <stdint.h>

enum hal_uart { HAL_UART_CONSOLE, HAL_UART_LINK, HAL_UART_COUNT };

/* Line speed in bits per second as set by hal_board_init(), for load figures: ten bits carry a byte. 0 where the board
 * has no such UART: it then takes nothing, gives nothing and loses nothing. Every board has a console. [ANY] */
uint32_t hal_uart_baud(enum hal_uart port);

/* Hands over up to size bytes; returns how many were taken, 0 if the line is busy. [MAIN] */
size_t hal_uart_write(enum hal_uart port, const void *data, size_t size);

/* Takes up to size received bytes; returns how many there were. [MAIN] */
size_t hal_uart_read(enum hal_uart port, void *data, size_t size);

/* Received bytes lost so far because nobody took them in time. Wraps at 2^32. [ANY] */
uint32_t hal_uart_lost(enum hal_uart port);

#endif
