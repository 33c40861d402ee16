/* Arm MPS2 with FPGA image AN386: Cortex-M4 with single-precision FPU, 25 MHz. Addresses and lines: application note
 * DAI 0386, memory map and interrupt table. */
#ifndef BOARD_H
#define BOARD_H

#define BOARD_NAME "mps2-an386"
#define BOARD_CORE "cortex-m4f"

enum {
    BOARD_CLOCK_HZ = 25000000,
    BOARD_BAUD = 921600,

    BOARD_TIMER0_BASE = 0x40000000,
    BOARD_TIMER1_BASE = 0x40001000,
    BOARD_UART0_BASE = 0x40004000,
    BOARD_UART1_BASE = 0x40005000,
    BOARD_LEDS_BASE = 0x40028000, /* FPGAIO, bit 0 is USERLED0 */

    BOARD_UART0_RX_IRQ = 0,
    BOARD_UART0_TX_IRQ = 1,
    BOARD_UART1_RX_IRQ = 2,
    BOARD_UART1_TX_IRQ = 3,
    BOARD_TIMER0_IRQ = 8,
    BOARD_IRQ_COUNT = 48
};

#endif
