/* The interrupt controller and the few instructions around it: armv7-m and armv8-m mainline alike. */
#ifndef CORTEX_M_NVIC_H
#define CORTEX_M_NVIC_H

#include <stdint.h>

/* Lower is more urgent. Only the upper four bits count, which is what the smallest chips implement. Faults stand above
 * all of them, at 0. A receiver that comes late loses a byte, a tick that comes late a few microseconds. */
enum nvic_priority { NVIC_PRIORITY_RECEIVE = 0x40, NVIC_PRIORITY_TICK = 0x80, NVIC_PRIORITY_LOW = 0xC0 };

static inline void nvic_write(uint32_t base, unsigned irq)
{
    *(volatile uint32_t *)(uintptr_t)(base + 4u * (irq / 32u)) = (uint32_t)1 << (irq % 32u);
}

/* Everything written before has arrived, and every interrupt that is due has run. */
static inline void nvic_barrier(void) { __asm__ volatile("dsb\n isb" ::: "memory"); }

static inline void nvic_set_priority(unsigned irq, enum nvic_priority priority)
{
    *(volatile uint8_t *)(uintptr_t)(0xE000E400u + irq) = (uint8_t)priority;
}

static inline void nvic_enable(unsigned irq) { nvic_write(0xE000E100u, irq); }

static inline void nvic_disable(unsigned irq)
{
    nvic_write(0xE000E180u, irq);
    nvic_barrier();
}

static inline void nvic_pend(unsigned irq)
{
    nvic_write(0xE000E200u, irq);
    nvic_barrier();
}

static inline void nvic_unpend(unsigned irq)
{
    nvic_write(0xE000E280u, irq);
    nvic_barrier();
}

/* All interrupts of the processor, faults excepted. */
static inline void nvic_mask(void) { __asm__ volatile("cpsid i" ::: "memory"); }
static inline void nvic_unmask(void) { __asm__ volatile("cpsie i\n isb" ::: "memory"); }

/* Sleeps until an interrupt is pending, even a masked one. */
static inline void nvic_sleep(void) { __asm__ volatile("dsb\n wfi" ::: "memory"); }

#endif
