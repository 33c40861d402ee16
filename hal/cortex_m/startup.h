/* What a board hands to the start-up code: the chip's part of the vector table. */
#ifndef CORTEX_M_STARTUP_H
#define CORTEX_M_STARTUP_H

typedef void (*startup_vector)(void);

/* Put before the board's array of startup_vector, one entry an interrupt line of the chip. The linker places it behind
 * the sixteen entries of the processor. Lines that are not used hold fault_entry. */
#define STARTUP_BOARD_VECTORS __attribute__((section(".vectors.board"), used))

/* Where every exception ends that nobody expects: one line on the console, then hal_exit(99). Never returns. [ANY] */
void fault_entry(void);

/* Write protection, where the processor has it. One file for each of its architectures. [INIT] */
void startup_protect(void);

#define STARTUP_FAULT_4 fault_entry, fault_entry, fault_entry, fault_entry
#define STARTUP_FAULT_8 STARTUP_FAULT_4, STARTUP_FAULT_4

#endif
