/* What takes main itself long: one study and one self-test in the device, whoever asked for them on whichever line.
 * protocol/turn says whose they are. */
#ifndef PROTOCOL_WORK_H
#define PROTOCOL_WORK_H

#include <stdint.h>

#include "protocol/selftest.h"
#include "sim/study.h"

/* All zero at the start. */
struct work {
    struct study study;       /* of the side that turn_take_study() let have it */
    struct selftest selftest; /* of the side that has the turn */

    /* Kept up to date by the program for the self-test: ticks that came, and those that should have by another
     * clock. */
    uint32_t ticks_counted, ticks_expected;
};

#endif
