/* Registers: Armv7-M and Armv8-M architecture reference manuals, "SysTick". It counts down from RVR to 0. */
#include "cortex_m/systick.h"

#include "cortex_m/nvic.h"

#define SYST_CSR (*(volatile uint32_t *)0xE000E010u)
#define SYST_RVR (*(volatile uint32_t *)0xE000E014u)
#define SYST_CVR (*(volatile uint32_t *)0xE000E018u)
#define SCB_ICSR (*(volatile uint32_t *)0xE000ED04u)
#define SCB_SYSTICK_PRIORITY (*(volatile uint8_t *)0xE000ED23u)

enum {
    CSR_ON = 1 << 0,
    CSR_INTERRUPT = 1 << 1,
    CSR_CORE_CLOCK = 1 << 2,
    CSR_COUNTED = 1 << 16, /* reached 0; cleared by the reading */
    ICSR_UNPEND = 1 << 25,
    ICSR_PEND = 1 << 26,
    COUNTS_MAX = 1 << 24
};

static uint32_t core_hz;
static volatile uint32_t parts; /* interrupts a tick, 0 while it is stopped */
static uint32_t part;           /* interrupts since the last one; the handler's while the timer runs */
static bool has_run;            /* since main was last told that it may not sleep; main's alone */

void systick_open(uint32_t core)
{
    core_hz = core;
    SCB_SYSTICK_PRIORITY = NVIC_PRIORITY_TICK;
    hal_tick_stop();
}

bool systick_allows_sleep(void)
{
    const bool is_allowed = !has_run;

    has_run = hal_tick_is_running();
    return is_allowed && !has_run;
}

void systick_entry(void) { app_tick(); }

/* The fewest interrupts whose counts fit the timer. */
static uint32_t parts_of(uint32_t counts)
{
    uint32_t needed = 1u;

    while (counts / needed > (uint32_t)COUNTS_MAX) {
        needed++;
    }
    return needed;
}

void hal_tick_start(uint32_t rate_hz)
{
    uint32_t counts, needed;

    if (rate_hz < HAL_TICK_HZ_MIN || rate_hz > HAL_TICK_HZ_MAX) {
        return;
    }
    counts = (core_hz + rate_hz / 2u) / rate_hz;
    needed = parts_of(counts);
    if (hal_tick_is_running() && parts == needed && SYST_RVR == counts / needed - 1u) {
        return;
    }
    hal_tick_stop();
    has_run = true;
    parts = needed;
    part = 0u;
    SYST_RVR = counts / needed - 1u;
    SYST_CVR = 0u; /* any write: begins with a whole period */
    SYST_CSR = CSR_CORE_CLOCK | CSR_INTERRUPT | CSR_ON;
}

void hal_tick_stop(void)
{
    SYST_CSR = CSR_CORE_CLOCK;
    (void)SYST_CSR; /* forgets a period that has ended */
    parts = 0u;
    SCB_ICSR = ICSR_UNPEND;
    nvic_barrier();
}

/* Looked at in a way that leaves the count flag alone: a read of CSR would clear it. */
bool hal_tick_is_running(void) { return parts != 0u; }

void hal_tick_trigger(void)
{
    SCB_ICSR = ICSR_PEND;
    nvic_barrier();
}

bool hal_tick_take(void)
{
    if ((SYST_CSR & CSR_COUNTED) == 0u) {
        return false;
    }
    part++;
    if (part < parts) {
        return false;
    }
    part = 0u;
    return true;
}

/* With several interrupts a tick none is ever late: the shortest tick of that kind is longer than any handler. */
bool hal_tick_is_late(void) { return parts == 1u && (SCB_ICSR & ICSR_PEND) != 0u; }
