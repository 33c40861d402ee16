/* Netduino Plus 2: STM32F405RG, crystal of 25 MHz. Addresses and lines: RM0090 sections 2.3 and 12.2, DS8626 table
 * 9. */
#ifndef NETDUINOPLUS2_BOARD_H
#define NETDUINOPLUS2_BOARD_H

#include <stdbool.h>
#include <stdint.h>

enum {
    BOARD_CRYSTAL_HZ = 25000000,
    BOARD_CORE_HZ = 168000000,
    BOARD_RESET_HZ = 16000000,            /* HSI, on which the chip starts and stays if the crystal does not */
    BOARD_EMULATED_TIMER_HZ = 1000000000, /* QEMU's timers count at this rate whatever the clock tree says */
    BOARD_BAUD = 460800,

    BOARD_TIM2_BASE = 0x40000000,
    BOARD_USART2_BASE = 0x40004400,
    BOARD_USART1_BASE = 0x40011000,

    BOARD_USART1_IRQ = 37,
    BOARD_USART2_IRQ = 38,
    BOARD_IRQ_COUNT = 82
};

/* What the clock tree came to, Hz. */
struct board_clocks {
    uint32_t apb1, apb2;   /* USART2, USART1 */
    uint32_t core, timers; /* the processor, TIM2 */
};

/* Brings crystal, PLL, flash and buses up to 168 MHz, every wait bounded; on failure all stays on the reset clock.
 * Switches the peripherals on and their pins over. [INIT] */
struct board_clocks clocks_start(void);

/* Is there a clock tree at all? An emulator that does not model it reads 0 where silicon has its reset value. [ANY] */
bool clocks_are_real(void);

/* Clock and pins of the console, for a last word before clocks_start(). [ANY] */
void clocks_open_pins(void);

/* The blue LED. [ISR] */
void clocks_set_led(bool is_on);

#endif
