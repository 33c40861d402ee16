/* From reset to main: the processor's vectors, memory as C expects it, the board, the program. */
#include "cortex_m/startup.h"

#include <stdint.h>

#include "cortex_m/nvic.h"
#include "cortex_m/systick.h"
#include "hal_board.h"

#define SCB_CCR (*(volatile uint32_t *)0xE000ED14u)
#define SCB_SHCSR (*(volatile uint32_t *)0xE000ED24u)

enum {
    CCR_DIV_0_TRAP = 1 << 4,   /* an integer division by 0 is a bug: it shall not yield 0 in silence */
    SHCSR_FAULTS_ON = 7 << 16, /* memory, bus and usage faults keep their own number, none becomes a hard fault */
    PROCESSOR_VECTORS = 16
};

/* Of the linker script. */
extern uint32_t ld_stack_top[];
extern const uint32_t ld_data_load[];
extern uint32_t ld_data_start[], ld_data_end[];
extern uint32_t ld_bss_start[], ld_bss_end[];

int main(void);
void startup_reset(void);
void startup_run(void) __attribute__((noreturn));

struct startup_vectors {
    uint32_t *stack_top;
    startup_vector handlers[PROCESSOR_VECTORS - 1];
};

extern const struct startup_vectors startup_vectors;
const struct startup_vectors startup_vectors __attribute__((section(".vectors.processor"), used)) = {
    ld_stack_top,
    {startup_reset, fault_entry, fault_entry, STARTUP_FAULT_4, STARTUP_FAULT_4, fault_entry, fault_entry, fault_entry,
     systick_entry}, /* fault_entry where the board's tick is another timer: linker/sections.ld */
};

/* The FPU goes on before the first instruction of C: a compiler may use its registers anywhere, even to copy memory. */
__attribute__((naked)) void startup_reset(void)
{
    __asm__ volatile("ldr r0, =ld_stack_top \n"
                     "mov sp, r0 \n");
#ifdef __ARM_FP
    __asm__ volatile("ldr r0, =0xE000ED88 \n" /* CPACR: full access to coprocessors 10 and 11 */
                     "ldr r1, [r0] \n"
                     "orr r1, r1, #0xF00000 \n"
                     "str r1, [r0] \n"
                     "dsb \n"
                     "isb \n");
#endif
    __asm__ volatile("b startup_run \n");
}

void startup_run(void)
{
    const uint32_t *from = ld_data_load;

    for (uint32_t *to = ld_data_start; to < ld_data_end; to++) {
        *to = *from++;
    }
    for (uint32_t *to = ld_bss_start; to < ld_bss_end; to++) {
        *to = 0u;
    }
    SCB_CCR |= CCR_DIV_0_TRAP;
    SCB_SHCSR |= SHCSR_FAULTS_ON;
    nvic_barrier();
    startup_protect();

    hal_board_init();
    hal_exit(main());
}
