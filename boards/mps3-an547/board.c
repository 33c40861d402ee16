/* The chip blocks of the AN547, wired to the hal: the processor's timer is the tick, the system counter the clock
 * beside it. */
#include "board.h"

#include "base/compiler.h"
#include "cmsdk_uart.h"
#include "cortex_m/nvic.h"
#include "cortex_m/semihosting.h"
#include "cortex_m/startup.h"
#include "cortex_m/systick.h"
#include "hal_board.h"

#define REGISTER(address) (*(volatile uint32_t *)(uintptr_t)(address))

enum { COUNTER_ON = 1 };

static const struct cmsdk_uart_wiring console = {
    BOARD_UART0_BASE, BOARD_UART0_IRQ, BOARD_UART0_IRQ, BOARD_PERIPHERAL_HZ, BOARD_BAUD,
};
static const struct cmsdk_uart_wiring link = {
    BOARD_UART1_BASE, BOARD_UART1_IRQ, BOARD_UART1_IRQ, BOARD_PERIPHERAL_HZ, BOARD_BAUD,
};

static void console_isr(void) { cmsdk_uart_isr(HAL_UART_CONSOLE); }
static void link_isr(void) { cmsdk_uart_isr(HAL_UART_LINK); }

#define FAULT_16 STARTUP_FAULT_8, STARTUP_FAULT_8

static const startup_vector vectors[] STARTUP_BOARD_VECTORS = {
    FAULT_16,        FAULT_16,                                                                  /* 0 to 31 */
    STARTUP_FAULT_8, fault_entry, fault_entry, fault_entry, console_isr, link_isr, fault_entry, /* 32 to 45 */
    fault_entry,     fault_entry,                                                               /* 46, 47 */
    FAULT_16,        FAULT_16,    FAULT_16,    FAULT_16,    FAULT_16,    FAULT_16,              /* 48 to 143 */
};
BASE_STATIC_ASSERT(BASE_COUNT(vectors) == BOARD_IRQ_COUNT, a_vector_for_each_line);

void hal_board_init(void)
{
    REGISTER(BOARD_COUNTER_CONTROL_BASE) = COUNTER_ON;
    cmsdk_uart_open(HAL_UART_CONSOLE, &console);
    cmsdk_uart_open(HAL_UART_LINK, &link);
    systick_open(BOARD_CORE_HZ);
    hal_flag_set(false);
    nvic_unmask();
}

uint32_t hal_clock_now(void) { return REGISTER(BOARD_COUNTER_READ_BASE); }

uint32_t hal_clock_hz(void) { return BOARD_CORE_HZ; }

const char *hal_board_name(void) { return "mps3-an547"; }

const char *hal_board_core(void) { return "cortex-m55"; }

bool hal_board_has_fpu(void) { return true; }

bool hal_board_is_emulated(void) { return true; }

void hal_exit(int code) { semihosting_exit(code); }

void hal_board_panic_write(char byte) { cmsdk_uart_put(&console, byte); }

void hal_flag_set(bool is_squealing) { REGISTER(BOARD_LEDS_BASE) = is_squealing ? 1u : 0u; }

/* With the tick stopped the core may sleep. The counter stands meanwhile: virtual time may run on. An interrupt that
 * comes after the question is pending and ends the sleep, although it is masked. */
void hal_idle(void)
{
    nvic_mask();
    if (systick_allows_sleep() && cmsdk_uart_is_quiet(HAL_UART_CONSOLE) && cmsdk_uart_is_quiet(HAL_UART_LINK)) {
        REGISTER(BOARD_COUNTER_CONTROL_BASE) = 0u;
        nvic_sleep();
        REGISTER(BOARD_COUNTER_CONTROL_BASE) = COUNTER_ON;
    }
    nvic_unmask();
}
