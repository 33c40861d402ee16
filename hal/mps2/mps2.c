/* The chip blocks of an MPS2, wired to the hal: all of a board but its name and its core. */
#include "mps2/mps2.h"

#include "base/compiler.h"
#include "cmsdk_timer.h"
#include "cmsdk_uart.h"
#include "cortex_m/nvic.h"
#include "cortex_m/semihosting.h"
#include "cortex_m/startup.h"
#include "hal_board.h"

static const struct cmsdk_uart_wiring console = {
    MPS2_UART0_BASE, MPS2_UART0_RX_IRQ, MPS2_UART0_TX_IRQ, MPS2_CLOCK_HZ, MPS2_BAUD,
};
static const struct cmsdk_uart_wiring link = {
    MPS2_UART1_BASE, MPS2_UART1_RX_IRQ, MPS2_UART1_TX_IRQ, MPS2_CLOCK_HZ, MPS2_BAUD,
};
static const struct cmsdk_timer_wiring timers = {
    MPS2_TIMER0_BASE,
    MPS2_TIMER0_IRQ,
    MPS2_TIMER1_BASE,
    MPS2_CLOCK_HZ,
};

static void console_rx_isr(void) { cmsdk_uart_rx_isr(HAL_UART_CONSOLE); }
static void console_tx_isr(void) { cmsdk_uart_tx_isr(HAL_UART_CONSOLE); }
static void link_rx_isr(void) { cmsdk_uart_rx_isr(HAL_UART_LINK); }
static void link_tx_isr(void) { cmsdk_uart_tx_isr(HAL_UART_LINK); }

static const startup_vector vectors[] STARTUP_BOARD_VECTORS = {
    console_rx_isr,  console_tx_isr,  link_rx_isr,     link_tx_isr, /* 0 to 3 */
    STARTUP_FAULT_4,                                                /* 4 to 7 */
    app_tick,        fault_entry,     fault_entry,     fault_entry, /* 8, the tick, to 11 */
    STARTUP_FAULT_4, STARTUP_FAULT_8, STARTUP_FAULT_8, STARTUP_FAULT_8, STARTUP_FAULT_8,
};
BASE_STATIC_ASSERT(BASE_COUNT(vectors) == MPS2_IRQ_COUNT, a_vector_for_each_line);
BASE_STATIC_ASSERT(MPS2_CLOCK_HZ / MPS2_BAUD >= 16, baud_rate_can_be_made);

void hal_board_init(void)
{
    cmsdk_uart_open(HAL_UART_CONSOLE, &console);
    cmsdk_uart_open(HAL_UART_LINK, &link);
    cmsdk_timer_open(&timers);
    hal_flag_set(false);
    nvic_unmask();
}

bool hal_board_is_emulated(void) { return true; }

void hal_exit(int code) { semihosting_exit(code); }

void hal_board_panic_write(char byte) { cmsdk_uart_put(&console, byte); }

void hal_flag_set(bool is_squealing) { *(volatile uint32_t *)MPS2_LEDS_BASE = is_squealing ? 1u : 0u; }

/* With the tick stopped the core may sleep, and virtual time stands still until a byte comes. The clock must stand as
 * well: a running timer is a deadline that the emulator would jump to. An interrupt that comes after the question is
 * pending and ends the sleep, although it is masked. */
void hal_idle(void)
{
    nvic_mask();
    if (cmsdk_timer_allows_sleep() && cmsdk_uart_is_quiet(HAL_UART_CONSOLE) && cmsdk_uart_is_quiet(HAL_UART_LINK)) {
        cmsdk_timer_hold_clock();
        nvic_sleep();
        cmsdk_timer_resume_clock();
    }
    nvic_unmask();
}
