/* What the FPGA images of the Arm MPS2 board have in common: 25 MHz, addresses and interrupt lines. Application notes
 * DAI 0385, DAI 0386 and DAI 0400 (AN385, AN386, AN500), memory map and interrupt table. */
#ifndef MPS2_H
#define MPS2_H

enum {
    MPS2_CLOCK_HZ = 25000000,
    MPS2_BAUD = 921600,

    MPS2_TIMER0_BASE = 0x40000000,
    MPS2_TIMER1_BASE = 0x40001000,
    MPS2_UART0_BASE = 0x40004000,
    MPS2_UART1_BASE = 0x40005000,
    MPS2_LEDS_BASE = 0x40028000, /* FPGAIO, bit 0 is USERLED0 */

    MPS2_UART0_RX_IRQ = 0,
    MPS2_UART0_TX_IRQ = 1,
    MPS2_UART1_RX_IRQ = 2,
    MPS2_UART1_TX_IRQ = 3,
    MPS2_TIMER0_IRQ = 8,
    MPS2_IRQ_COUNT = 48
};

#endif
