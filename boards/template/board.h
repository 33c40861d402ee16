/* Which board: its chip, and the manuals that the numbers come from. */
#ifndef TEMPLATE_BOARD_H
#define TEMPLATE_BOARD_H

enum {
    BOARD_CORE_HZ = 0,  /* clock of the processor */
    BOARD_IRQ_COUNT = 0 /* interrupt lines of the chip, without the processor's sixteen */
};

#endif
