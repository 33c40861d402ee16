/* Arm MPS2 with FPGA image AN386: Cortex-M4 with single-precision FPU, 25 MHz. */
#include "hal_board.h"

const char *hal_board_name(void) { return "mps2-an386"; }

const char *hal_board_core(void) { return "cortex-m4f"; }

bool hal_board_has_fpu(void) { return true; }
