/* Two CMSDK APB timers of the MPS2 boards: implements hal_tick.h, one as the tick, one as the clock beside it. */
#ifndef CMSDK_TIMER_H
#define CMSDK_TIMER_H

#include <stdint.h>

#include "hal_tick.h"

struct cmsdk_timer_wiring {
    uintptr_t tick_base;
    unsigned tick_irq; /* its vector is app_tick */
    uintptr_t clock_base;
    uint32_t timer_hz; /* of both */
};

/* Clock running, tick stopped. [INIT] */
void cmsdk_timer_open(const struct cmsdk_timer_wiring *wiring);

/* May main sleep? Not while the tick runs, and once not after it has stopped: the handler may have left work behind
 * between main's last look and the question, to be asked with interrupts masked. [MAIN] */
bool cmsdk_timer_allows_sleep(void);

/* Holds the clock, for the time of a sleep in an emulator whose virtual time would run on to the clock's overflow.
 * [MAIN] */
void cmsdk_timer_hold_clock(void);
void cmsdk_timer_resume_clock(void);

#endif
