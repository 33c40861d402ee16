/* The processor's own timer as the tick: implements hal_tick.h but for its clock, for chips whose other timers are poor
 * or not modelled. It has 24 bits; slower ticks are every n-th of its interrupts. The board gives the clock beside
 * it. */
#ifndef CORTEX_M_SYSTICK_H
#define CORTEX_M_SYSTICK_H

#include <stdbool.h>
#include <stdint.h>

#include "hal_tick.h"

/* core_hz: of the processor, which it counts. Tick stopped. [INIT] */
void systick_open(uint32_t core_hz);

/* May main sleep beside an emulator's timer? Not while the tick runs, and once not after it has stopped: the handler
 * may have left work behind between main's last look and the question, to be asked with interrupts masked. [MAIN] */
bool systick_allows_sleep(void);

/* Its place in the processor's vectors; calls app_tick. [ISR] */
void systick_entry(void);

#endif
