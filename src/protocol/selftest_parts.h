/* Between the files of selftest: what selftest.c has of selftest_plant.c. [MAIN] */
#ifndef PROTOCOL_SELFTEST_PARTS_H
#define PROTOCOL_SELFTEST_PARTS_H

#include "protocol/selftest.h"

/* Puts the plant of the test under way to its first step. */
void selftest_set_plant(struct selftest *selftest);

/* Makes a slice of its steps; true when all of the test are made. */
bool selftest_run_plant(struct selftest *selftest);

#endif
