/* The tick's handler, and the timer that main starts and stops for it. */
#ifndef APP_ISR_H
#define APP_ISR_H

#include <stdint.h>

#include "sim/executive.h"

/* Ticks that came, and those that should have by the free-running clock: unequal means that the timer's interrupt got
 * lost, as it does under an emulator that sleeps beside a running timer. */
struct isr_ticks {
    uint32_t counted, expected;
};

/* Binds the handler to the executive it steps. Before the first tick. [INIT] */
void isr_init(struct executive *executive);

/* Follows the executive: lets the interrupt take an order now, starts or stops the timer. [MAIN] */
void isr_follow(void);

/* Since the program began. [MAIN] */
struct isr_ticks isr_ticks(void);

#endif
