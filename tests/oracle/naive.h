/* A second opinion that shares nothing with the series: fixed-step RK4 on the raw sign function. It converges to the
 * exact solution slowly, in proportion to the step. */
#ifndef ORACLE_NAIVE_H
#define ORACLE_NAIVE_H

#include "solve.h"

/* Fills the columns of the first 20 periods, the rest with nan. */
void naive_solve(const struct plant *plant, long steps_per_period, struct result *result);

#endif
