/* The story of a brake, told by the device: each act sets the plant, lets it go, and says what was measured. The acts
 * are demo.def. The user's tick and substeps are kept. */
#ifndef PROTOCOL_DEMO_H
#define PROTOCOL_DEMO_H

#include <stdbool.h>
#include <stdint.h>

struct console;

enum demo_stage { DEMO_OPENS, DEMO_IS_SET, DEMO_PLAYS };

struct demo {
    uint8_t act, last; /* indices of demo.def */
    enum demo_stage stage;
    bool has_squealed; /* in this act, first recognised at the end of the steps below */
    uint64_t squeal_step;
};

/* The command: "demo" or "demo <act>". [MAIN] */
void demo_obey(struct console *console);

/* Goes on; returns true if something was done. [MAIN] */
bool demo_continue(struct console *console);

#endif
