/* The chip blocks of the Netduino Plus 2, wired to the hal. The same image serves silicon and QEMU, which models
 * neither clock tree nor pins. */
#include "board.h"

#include "base/compiler.h"
#include "cortex_m/nvic.h"
#include "cortex_m/semihosting.h"
#include "cortex_m/startup.h"
#include "cortex_m/systick.h"
#include "hal_board.h"
#include "stm32_usart.h"

#define SCB_AIRCR (*(volatile uint32_t *)0xE000ED0Cu)

/* TIM2, 32 bits, is the clock beside the tick. Its end value is 2^32 - 1 after reset and is left alone: an emulator
 * takes the writing of it for a deadline. RM0090, section 18.4. */
#define TIM2_CR1 (*(volatile uint32_t *)BOARD_TIM2_BASE)
#define TIM2_CNT (*(volatile uint32_t *)(BOARD_TIM2_BASE + 0x24))

enum { AIRCR_RESET = 0x05FA0004, TIM2_ON = 1 };

static uint32_t clock_hz;

static void console_isr(void) { stm32_usart_isr(HAL_UART_CONSOLE); }
static void link_isr(void) { stm32_usart_isr(HAL_UART_LINK); }

static const startup_vector vectors[] STARTUP_BOARD_VECTORS = {
    STARTUP_FAULT_8, STARTUP_FAULT_8, STARTUP_FAULT_8, STARTUP_FAULT_8,                  /* 0 to 31 */
    STARTUP_FAULT_4, fault_entry,     console_isr,     link_isr,        fault_entry,     /* 32 to 39 */
    STARTUP_FAULT_8, STARTUP_FAULT_8, STARTUP_FAULT_8, STARTUP_FAULT_8, STARTUP_FAULT_8, /* 40 to 79 */
    fault_entry,     fault_entry,                                                        /* 80, 81 */
};
BASE_STATIC_ASSERT(BASE_COUNT(vectors) == BOARD_IRQ_COUNT, a_vector_for_each_line);

static struct stm32_usart_wiring console = {BOARD_USART1_BASE, BOARD_USART1_IRQ, BOARD_RESET_HZ, BOARD_BAUD};
static struct stm32_usart_wiring link = {BOARD_USART2_BASE, BOARD_USART2_IRQ, BOARD_RESET_HZ, BOARD_BAUD};

void hal_board_init(void)
{
    const struct board_clocks clocks = clocks_start();

    console.clock_hz = clocks.apb2;
    link.clock_hz = clocks.apb1;
    stm32_usart_open(HAL_UART_CONSOLE, &console);
    stm32_usart_open(HAL_UART_LINK, &link);
    systick_open(clocks.core);
    clock_hz = clocks.timers;
    TIM2_CR1 = TIM2_ON;
    hal_flag_set(false);
    nvic_unmask();
}

uint32_t hal_clock_now(void) { return TIM2_CNT; }

uint32_t hal_clock_hz(void) { return clock_hz; }

const char *hal_board_name(void) { return "netduinoplus2"; }

const char *hal_board_core(void) { return "cortex-m4f"; }

bool hal_board_has_fpu(void) { return true; }

bool hal_board_is_emulated(void) { return !clocks_are_real(); }

void hal_exit(int code)
{
    if (hal_board_is_emulated()) {
        semihosting_exit(code);
    }
    SCB_AIRCR = AIRCR_RESET;
    for (;;) {
    }
}

void hal_board_panic_write(char byte)
{
    if (!stm32_usart_is_open(&console)) {
        clocks_open_pins();
        stm32_usart_set_line(&console);
    }
    stm32_usart_put(&console, byte);
}

void hal_flag_set(bool is_squealing) { clocks_set_led(is_squealing); }

/* An interrupt that comes after the question is pending and ends the sleep, although it is masked. Silicon may sleep
 * beside a tick that runs, and is woken by it; an emulator may not. */
void hal_idle(void)
{
    bool may_sleep;

    nvic_mask();
    may_sleep = systick_allows_sleep() || (clocks_are_real() && hal_tick_is_running());
    if (may_sleep && stm32_usart_is_quiet(HAL_UART_CONSOLE) && stm32_usart_is_quiet(HAL_UART_LINK)) {
        nvic_sleep();
    }
    nvic_unmask();
}
