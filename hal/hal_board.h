/* The board as a whole: start, description, end. One implementation an image; a missing function is a link error. */
#ifndef HAL_BOARD_H
#define HAL_BOARD_H

#include <stdbool.h>
#include <stdint.h>

/* Brings clocks, UARTs, timers and the pin up; interrupts enabled, tick stopped. Waits, if any, are bounded. [INIT] */
void hal_board_init(void);

/* What "id" prints. */
const char *hal_board_name(void); /* the folder's name, mps2-an386 */
const char *hal_board_core(void); /* cortex-m4f */
bool hal_board_has_fpu(void);     /* single precision in hardware; without it the plant starts in fixed point */
bool hal_board_is_emulated(void); /* true where the image was built for an emulator's board */

/* Ends the program: the emulator's or the process's exit code; on silicon a reset. [ANY] */
void hal_exit(int code) __attribute__((noreturn));

/* One byte out at once, waiting for the line if need be: for a last word before hal_exit, with interrupts off. [ANY] */
void hal_board_panic_write(char byte);

/* Sets the pin or LED that follows the propensity: lit while the brake squeals. Called when that changes. [ISR] */
void hal_flag_set(bool is_squealing);

/* Called by main when it has nothing to do; returns after an interrupt or a while. Must not sleep while an emulator's
 * tick runs: with a running timer beside it a WFI halves the tick rate there. [MAIN] */
void hal_idle(void);

#endif
