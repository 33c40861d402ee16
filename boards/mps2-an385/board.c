/* Arm MPS2 with FPGA image AN385: Cortex-M3 without FPU, 25 MHz. */
#include "hal_board.h"

const char *hal_board_name(void) { return "mps2-an385"; }

const char *hal_board_core(void) { return "cortex-m3"; }

bool hal_board_has_fpu(void) { return false; }
