/* Two 32-bit timers of STM32F2 and F4 (TIM2, TIM5): implements hal_tick.h, one as the tick, one as the clock beside it. */
#ifndef STM32_TIMER_H
#define STM32_TIMER_H

#include <stdint.h>

#include "hal_tick.h"

struct stm32_timer_wiring {
    uintptr_t tick_base;
    unsigned tick_irq; /* its vector is app_tick */
    uintptr_t clock_base;
    uint32_t timer_hz; /* of both */
};

/* Clock running, tick stopped; their clocks are the board's to switch on. [INIT] */
void stm32_timer_open(const struct stm32_timer_wiring *wiring);

/* May main sleep beside an emulator's timer? As cmsdk_timer_allows_sleep(). [MAIN] */
bool stm32_timer_allows_sleep(void);

#endif
