/* Registers: RM0090, section 18.4 "TIM2 to TIM5 registers". They count up from 0 to ARR. */
#include "stm32_timer.h"

#include "cortex_m/nvic.h"

enum {
    CR1_ON = 1 << 0,
    CR1_OVERFLOW_ONLY = 1 << 2, /* a restart by software raises no interrupt */
    DIER_UPDATE = 1 << 0,
    SR_UPDATE = 1 << 0, /* write 0 to clear */
    EGR_RESTART = 1 << 0
};

struct stm32_timer_block {
    volatile uint32_t cr1, cr2, smcr, dier, sr, egr, ccmr1, ccmr2, ccer, cnt, psc, arr;
};

static struct stm32_timer_block *tick;
static struct stm32_timer_block *clock;
static unsigned tick_irq;
static uint32_t timer_hz;
static bool has_run; /* since main was last told that it may not sleep; main's alone */

/* The clock's ARR is 2^32 - 1 after reset and is left alone: an emulator takes the writing of it for a deadline. */
void stm32_timer_open(const struct stm32_timer_wiring *wiring)
{
    tick = (struct stm32_timer_block *)wiring->tick_base;
    clock = (struct stm32_timer_block *)wiring->clock_base;
    tick_irq = wiring->tick_irq;
    timer_hz = wiring->timer_hz;

    hal_tick_stop();
    nvic_set_priority(tick_irq, NVIC_PRIORITY_TICK);
    nvic_enable(tick_irq);
    clock->cr1 = CR1_ON;
}

bool stm32_timer_allows_sleep(void)
{
    const bool is_allowed = !has_run;

    has_run = hal_tick_is_running();
    return is_allowed && !has_run;
}

void hal_tick_start(uint32_t rate_hz)
{
    uint32_t top;

    if (rate_hz < HAL_TICK_HZ_MIN || rate_hz > HAL_TICK_HZ_MAX) {
        return;
    }
    top = (timer_hz + rate_hz / 2u) / rate_hz - 1u;
    if (hal_tick_is_running() && tick->arr == top) {
        return;
    }
    hal_tick_stop();
    has_run = true;
    tick->arr = top;
    tick->cr1 = CR1_OVERFLOW_ONLY | CR1_ON;
    tick->egr = EGR_RESTART;
    tick->sr = ~(uint32_t)SR_UPDATE;
    tick->dier = DIER_UPDATE;
}

void hal_tick_stop(void)
{
    tick->dier = 0u;
    tick->cr1 = CR1_OVERFLOW_ONLY;
    tick->sr = ~(uint32_t)SR_UPDATE;
    nvic_unpend(tick_irq);
}

bool hal_tick_is_running(void) { return (tick->cr1 & CR1_ON) != 0u; }

void hal_tick_trigger(void) { nvic_pend(tick_irq); }

/* Cleared only where it was seen: a period that ends between the look and the clearing must not be lost. */
bool hal_tick_take(void)
{
    if ((tick->sr & SR_UPDATE) == 0u) {
        return false;
    }
    tick->sr = ~(uint32_t)SR_UPDATE;
    nvic_barrier(); /* the flag must have gone before the handler returns, or it is entered again */
    return true;
}

bool hal_tick_is_late(void) { return (tick->sr & SR_UPDATE) != 0u; }

uint32_t hal_clock_now(void) { return clock->cnt; }

uint32_t hal_clock_hz(void) { return timer_hz; }
