/* The firmware's own checks, run on the device it runs on: numbers as text, and a second plant against what is known
 * about it in closed form, the paper's solution of forced slip (set right) among it. The plant in the interrupt goes on
 * undisturbed. */
#ifndef PROTOCOL_SELFTEST_H
#define PROTOCOL_SELFTEST_H

#include <stdbool.h>
#include <stdint.h>

#include "analysis/perturbation.h"
#include "base/text.h"
#include "sim/sim.h"

enum { SELFTEST_SLICE_STEPS = 128 }; /* at most this many steps of the plant a poll */

enum selftest_test {
#define SELFTEST(number, field, name, help) SELFTEST_##field,
#include "protocol/selftest.def"
#undef SELFTEST
    SELFTEST_COUNT
};

struct selftest_info {
    const char *name, *help;
};

extern const struct selftest_info selftest_table[SELFTEST_COUNT];

struct selftest {
    struct sim_plan plan;
    struct sim sim;
    struct perturbation orbit; /* that forced motion is to follow */
    uint8_t test;              /* number of the one under way */
    bool is_set;               /* its plant stands at its first step */
    uint32_t passed, failed;
    uint32_t failures; /* bit i: test i failed */
    uint32_t step;     /* of the test under way */

    /* what was found, and what it was compared with */
    float worst, allowed;       /* deviation so far */
    uint32_t counted, expected; /* failures, events, ticks */
    uint32_t hash;              /* of the states of the test under way */
    uint32_t hash_forward;      /* the same of the tests that later ones are compared with */
    uint32_t hash_sim;
};

/* [MAIN] */
void selftest_start(struct selftest *selftest);

/* A slice; ticks_counted and ticks_expected are the ticks of two clocks. True if it has finished a test. [MAIN] */
bool selftest_go_on(struct selftest *selftest, uint32_t ticks_counted, uint32_t ticks_expected);

bool selftest_is_done(const struct selftest *selftest);

/* "pass|fail <test> <detail>" of the test finished last. [MAIN] */
void selftest_write(struct text *text, const struct selftest *selftest);

#endif
