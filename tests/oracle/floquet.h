/* Growth of a small disturbance while the pad slips on for ever: the paper's stability of permanent slip. */
#ifndef ORACLE_FLOQUET_H
#define ORACLE_FLOQUET_H

#include "plant.h"

/* 1/s, with P as the settled load makes it, contact included; the friction floor is ignored, as in the paper. */
double floquet_slip_rate_per_s(const struct plant *plant);

#endif
