/* Protection for Cortex-M3, M4 and M7. One region makes the whole code space, up to where RAM begins, read-only: a
 * store through a null pointer faults, and so does a stack that grows out of the bottom of RAM. All else stays as it
 * is. */
#include <stdint.h>

#include "cortex_m/nvic.h"
#include "cortex_m/startup.h"

#define MPU_TYPE (*(volatile uint32_t *)0xE000ED90u)
#define MPU_CTRL (*(volatile uint32_t *)0xE000ED94u)
#define MPU_RNR (*(volatile uint32_t *)0xE000ED98u)
#define MPU_RBAR (*(volatile uint32_t *)0xE000ED9Cu)
#define MPU_RASR (*(volatile uint32_t *)0xE000EDA0u)

enum {
    TYPE_REGIONS = 0xFF00,
    CTRL_ON = 1 << 0,
    CTRL_DEFAULT_MAP = 1 << 2, /* where no region is */
    RASR_ON = 1 << 0,
    RASR_SIZE_512_MIB = 28 << 1,
    RASR_CACHEABLE = 1 << 17,
    RASR_READ_ONLY = 6 << 24,
    CODE_SPACE = 0x00000000
};

void startup_protect(void)
{
    if ((MPU_TYPE & TYPE_REGIONS) == 0u) {
        return;
    }
    MPU_RNR = 0u;
    MPU_RBAR = CODE_SPACE;
    MPU_RASR = RASR_READ_ONLY | RASR_CACHEABLE | RASR_SIZE_512_MIB | RASR_ON;
    MPU_CTRL = CTRL_ON | CTRL_DEFAULT_MAP;
    nvic_barrier();
}
