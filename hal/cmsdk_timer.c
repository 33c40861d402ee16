/* Registers: Arm Cortex-M System Design Kit (DDI 0479), section 4.1 "APB timer". It counts down from reload to 0. */
#include "cmsdk_timer.h"

#include "cortex_m/nvic.h"

enum { CTRL_RUN = 1 << 0, CTRL_INTERRUPT = 1 << 3, INTERRUPT_ENDED = 1 << 0 /* write 1 to clear */ };

struct cmsdk_timer_block {
    volatile uint32_t ctrl;
    volatile uint32_t value;
    volatile uint32_t reload;
    volatile uint32_t interrupt;
};

static struct cmsdk_timer_block *tick;
static struct cmsdk_timer_block *clock;
static unsigned tick_irq;
static uint32_t timer_hz;
static bool has_run; /* since main was last told that it may not sleep; main's alone */

void cmsdk_timer_open(const struct cmsdk_timer_wiring *wiring)
{
    tick = (struct cmsdk_timer_block *)wiring->tick_base;
    clock = (struct cmsdk_timer_block *)wiring->clock_base;
    tick_irq = wiring->tick_irq;
    timer_hz = wiring->timer_hz;

    hal_tick_stop();
    nvic_set_priority(tick_irq, NVIC_PRIORITY_TICK);
    nvic_enable(tick_irq);

    clock->ctrl = 0u;
    clock->reload = UINT32_MAX;
    clock->value = UINT32_MAX;
    clock->ctrl = CTRL_RUN;
}

bool cmsdk_timer_allows_sleep(void)
{
    const bool is_allowed = !has_run;

    has_run = hal_tick_is_running();
    return is_allowed && !has_run;
}

void cmsdk_timer_hold_clock(void) { clock->ctrl = 0u; }

void cmsdk_timer_resume_clock(void) { clock->ctrl = CTRL_RUN; }

void hal_tick_start(uint32_t rate_hz)
{
    uint32_t reload;

    if (rate_hz < HAL_TICK_HZ_MIN || rate_hz > HAL_TICK_HZ_MAX) {
        return;
    }
    reload = (timer_hz + rate_hz / 2u) / rate_hz - 1u;
    if (hal_tick_is_running() && tick->reload == reload) {
        return;
    }
    hal_tick_stop();
    has_run = true;
    tick->reload = reload;
    tick->value = reload;
    tick->ctrl = CTRL_RUN | CTRL_INTERRUPT;
}

void hal_tick_stop(void)
{
    tick->ctrl = 0u;
    tick->interrupt = INTERRUPT_ENDED;
    nvic_unpend(tick_irq);
}

bool hal_tick_is_running(void) { return (tick->ctrl & CTRL_RUN) != 0u; }

void hal_tick_trigger(void) { nvic_pend(tick_irq); }

/* Cleared only where it was seen: a period that ends between the look and the clearing must not be lost. */
bool hal_tick_take(void)
{
    if ((tick->interrupt & INTERRUPT_ENDED) == 0u) {
        return false;
    }
    tick->interrupt = INTERRUPT_ENDED;
    return true;
}

bool hal_tick_is_late(void) { return (tick->interrupt & INTERRUPT_ENDED) != 0u; }

uint32_t hal_clock_now(void) { return ~clock->value; }

uint32_t hal_clock_hz(void) { return timer_hz; }
