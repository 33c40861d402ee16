/* A parameter taken up and down while the plant runs on: strobes where it has come to rest. */
#ifndef SQUEAL_SWEEP_H
#define SQUEAL_SWEEP_H

#include "squeal/paper/orbit.h"
#include "squeal/paper/table.h"

struct sweep {
    struct table strobes; /* value, way (1 up, -1 down), x; one or two at rest, else all that were seen last */
    unsigned places, unsettled, diverged;
    double *end[2]; /* highest strobe at each place, up and down; NaN where it ran away */
    double size_m;  /* largest strobe */
};

/* From the start of the set in force up to the end of the axis and back, never reset but after running away. */
struct sweep sweep_make(struct lab *lab, const char *symbol, double from, double to);

/* Places at which it matters from where one comes. */
unsigned sweep_hysteresis(const struct sweep *sweep);

#endif
