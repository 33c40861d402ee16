/* Protection for Armv8-M: one region makes the code space read-only, as mpu_v7m.c has it for its elders, and the
 * processor watches the end of the stack itself. */
#include <stdint.h>

#include "cortex_m/nvic.h"
#include "cortex_m/startup.h"

#define MPU_TYPE (*(volatile uint32_t *)0xE000ED90u)
#define MPU_CTRL (*(volatile uint32_t *)0xE000ED94u)
#define MPU_RNR (*(volatile uint32_t *)0xE000ED98u)
#define MPU_RBAR (*(volatile uint32_t *)0xE000ED9Cu)
#define MPU_RLAR (*(volatile uint32_t *)0xE000EDA0u)
#define MPU_MAIR0 (*(volatile uint32_t *)0xE000EDC0u)

/* Of the linker script. */
extern const uint32_t ld_stack_bottom[];

enum {
    TYPE_REGIONS = 0xFF00,
    CTRL_ON = 1 << 0,
    CTRL_DEFAULT_MAP = 1 << 2, /* where no region is */
    RBAR_READ_ONLY = 3 << 1,
    RLAR_ON = 1 << 0,
    CODE_SPACE_LAST = 0x1FFFFFE0,
    MAIR_WRITE_THROUGH = 0xAA
};

void startup_protect(void)
{
    __asm__ volatile("msr msplim, %0" ::"r"(ld_stack_bottom));
    if ((MPU_TYPE & TYPE_REGIONS) == 0u) {
        return;
    }
    MPU_MAIR0 = MAIR_WRITE_THROUGH;
    MPU_RNR = 0u;
    MPU_RBAR = RBAR_READ_ONLY;
    MPU_RLAR = CODE_SPACE_LAST | RLAR_ON;
    MPU_CTRL = CTRL_ON | CTRL_DEFAULT_MAP;
    nvic_barrier();
}
