/* Arm MPS2+ with FPGA image AN500: Cortex-M7 with FPU, 25 MHz. */
#include "hal_board.h"

const char *hal_board_name(void) { return "mps2-an500"; }

const char *hal_board_core(void) { return "cortex-m7"; }

bool hal_board_has_fpu(void) { return true; }
