/* Arm MPS3 with FPGA image AN547 (SSE-300, Cortex-M55): DAI 0547, memory map and interrupts. Secure aliases: the
 * program stays in the state it is started in. */
#ifndef MPS3_AN547_BOARD_H
#define MPS3_AN547_BOARD_H

enum {
    BOARD_CORE_HZ = 32000000,
    BOARD_PERIPHERAL_HZ = 25000000,
    BOARD_BAUD = 921600,

    BOARD_COUNTER_CONTROL_BASE = 0x58100000,
    BOARD_COUNTER_READ_BASE = 0x58101000,
    BOARD_LEDS_BASE = 0x59302000, /* FPGAIO, bit 0 is USERLED0 */
    BOARD_UART0_BASE = 0x59303000,
    BOARD_UART1_BASE = 0x59304000,

    /* Receive and transmit together: their own two lines are swapped in QEMU before 7.2.14. */
    BOARD_UART0_IRQ = 43,
    BOARD_UART1_IRQ = 44,
    BOARD_IRQ_COUNT = 144
};

#endif
