/* What the parts of the lab share. */
#ifndef SQUEAL_LAB_PARTS_H
#define SQUEAL_LAB_PARTS_H

#include "squeal/paper/lab.h"

struct lab {
    const struct paper_options *options;
    struct device *device;
    FILE *record;
    double step_s;
    unsigned steps_per_period;
    bool has_left; /* its domain: the plant */
};

/* Makes steps; the plant may leave its domain meanwhile. */
void lab_step(struct lab *lab, uint64_t count);

/* Ends the experiment if the device did not do what it was asked. */
void lab_need(struct lab *lab, enum device_result result);

#endif
