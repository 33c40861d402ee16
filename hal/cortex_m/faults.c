/* Every exception that nobody expects ends here, on a stack of its own, so that an overflown stack can still be
 * told. */
#include <stdbool.h>
#include <stdint.h>

#include "cortex_m/startup.h"
#include "hal_board.h"

#define SCB_CFSR (*(volatile uint32_t *)0xE000ED28u)
#define SCB_HFSR (*(volatile uint32_t *)0xE000ED2Cu)
#define SCB_BFAR (*(volatile uint32_t *)0xE000ED38u)

enum { EXIT_FAULT = 99, FRAME_WORDS = 8, FRAME_PC = 6 };

/* Of the linker script. */
extern const uint32_t ld_stack_bottom[], ld_stack_top[];

void fault_report(const uint32_t *frame) __attribute__((noreturn, used));

__attribute__((naked)) void fault_entry(void)
{
    __asm__ volatile("cpsid i \n"
                     "mrs r0, msp \n"
                     "ldr r1, =ld_emergency_top \n"
                     "mov sp, r1 \n"
                     "b fault_report \n");
}

static void write_text(const char *text)
{
    while (*text != '\0') {
        hal_board_panic_write(*text++);
    }
}

static void write_field(const char *name, uint32_t value)
{
    write_text(name);
    for (unsigned shift = 32u; shift != 0u; shift -= 4u) {
        hal_board_panic_write("0123456789abcdef"[(value >> (shift - 4u)) & 15u]);
    }
}

static uint32_t exception_number(void)
{
    uint32_t number;

    __asm__ volatile("mrs %0, ipsr" : "=r"(number));
    return number & 0x1FFu;
}

/* The frame is looked at only where it lies inside the stack: a read outside would fault again, and lock the core
 * up. */
static uint32_t stacked_pc(const uint32_t *frame)
{
    const uintptr_t at = (uintptr_t)frame;
    const uintptr_t last = (uintptr_t)ld_stack_top - FRAME_WORDS * sizeof(uint32_t);

    return (at >= (uintptr_t)ld_stack_bottom && at <= last) ? frame[FRAME_PC] : 0u;
}

void fault_report(const uint32_t *frame)
{
    static bool is_reporting;

    if (!is_reporting) {
        is_reporting = true;
        write_field("\r\n! fault exception=", exception_number());
        write_field(" cfsr=", SCB_CFSR);
        write_field(" hfsr=", SCB_HFSR);
        write_field(" bfar=", SCB_BFAR);
        write_field(" pc=", stacked_pc(frame));
        write_text("\r\n");
    }
    hal_exit(EXIT_FAULT);
}
