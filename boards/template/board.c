/* A board to fill in: each #error stands for what is missing, and goes when it is there. hal/HAL.md says what to
 * mind. */
#include "board.h"

#include "cortex_m/startup.h"
#include "hal_board.h"
#include "hal_tick.h"
#include "hal_uart.h"

#error "vectors: an entry for each interrupt line: app_tick at the timer's, fault_entry at unused ones"
static const startup_vector vectors[] STARTUP_BOARD_VECTORS = {fault_entry};

/* --- The board ---------------------------------------------------------------------------------------------------- */

#error "hal_board_init: clocks with bounded waits, pins, both UARTs, tick stopped, clock running, interrupts on"
void hal_board_init(void) {}

#error "hal_board_name: the name of this folder"
const char *hal_board_name(void) { return ""; }

#error "hal_board_core: cortex-m3, say"
const char *hal_board_core(void) { return ""; }

#error "hal_board_has_fpu: true if the compiler's flags say so"
bool hal_board_has_fpu(void) { return false; }

#error "hal_board_is_emulated: true if no silicon has this image, or if the chip is seen not to be there"
bool hal_board_is_emulated(void) { return false; }

#error "hal_exit: semihosting_exit(code) under an emulator, a reset on silicon"
void hal_exit(int code)
{
    for (;;) {
        (void)code;
    }
}

#error "hal_board_panic_write: a byte out by polling, even before hal_board_init()"
void hal_board_panic_write(char byte) { (void)byte; }

#error "hal_flag_set: an LED or a pin"
void hal_flag_set(bool is_squealing) { (void)is_squealing; }

#error "hal_idle: sleep until an interrupt, unless something waits; beside a tick that runs on silicon alone"
void hal_idle(void) {}

/* --- The tick: hal/cortex_m/systick.c has all but the two of the clock, hal/cmsdk_timer.c all of it --------------- */

#error "hal_tick_start: a periodic interrupt, the first a whole period from now"
void hal_tick_start(uint32_t rate_hz) { (void)rate_hz; }

#error "hal_tick_stop: no tick follows, not even one that is pending"
void hal_tick_stop(void) {}

#error "hal_tick_is_running: between start and stop"
bool hal_tick_is_running(void) { return false; }

#error "hal_tick_trigger: pend the interrupt, and a barrier"
void hal_tick_trigger(void) {}

#error "hal_tick_take: clear the timer's flag if it is set, and say so"
bool hal_tick_take(void) { return false; }

#error "hal_tick_is_late: is the flag set again?"
bool hal_tick_is_late(void) { return false; }

#error "hal_clock_now: a counter of 32 bits that is not the tick's"
uint32_t hal_clock_now(void) { return 0u; }

#error "hal_clock_hz: its rate"
uint32_t hal_clock_hz(void) { return 0u; }

/* --- The UARTs: hal/cmsdk_uart.c and hal/stm32_usart.c have all of it --------------------------------------------- */

#error "hal_uart_baud: as set; 0 for a link that has no UART"
uint32_t hal_uart_baud(enum hal_uart port) { return port; }

#error "hal_uart_write: as many bytes as fit at once; a refused one wakes hal_idle when there is room"
size_t hal_uart_write(enum hal_uart port, const void *data, size_t size) { return (void)port, (void)data, size; }

#error "hal_uart_read: from a ring that the receive interrupt fills"
size_t hal_uart_read(enum hal_uart port, void *data, size_t size) { return (void)port, (void)data, size; }

#error "hal_uart_lost: overruns of the receiver"
uint32_t hal_uart_lost(enum hal_uart port) { return port; }
