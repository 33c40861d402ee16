/* The firmware's own checks, run on the device it runs on: numbers as text, and a second plant against what is known about
 * it in closed form. The plant in the interrupt goes on undisturbed. */
#ifndef PROTOCOL_SELFTEST_H
#define PROTOCOL_SELFTEST_H

#include <stdbool.h>
#include <stdint.h>

#include "base/text.h"
#include "sim/sim.h"

enum { SELFTEST_SLICE_STEPS = 128 }; /* at most this many steps of the plant a poll */

struct selftest {
    struct sim_plan plan;
    struct sim sim;
    uint8_t test; /* index of the one under way */
    bool is_set;  /* its plant stands at its first step */
    uint32_t passed, failed;
    uint32_t step;         /* of the test under way */
    float worst;           /* deviation so far */
    uint32_t hash;         /* of the states of the test under way */
    uint32_t hash_forward; /* the same of the tests that later ones are compared with */
    uint32_t hash_sim;
};

/* [MAIN] */
void selftest_start(struct selftest *selftest);

/* A slice. Writes "pass|fail <test> <detail>" into a body line for each test that is finished; counted and expected are
 * the ticks of two clocks. Returns true when all are done. [MAIN] */
bool selftest_continue(struct selftest *selftest, struct text *text, uint32_t counted, uint32_t expected);

#endif
