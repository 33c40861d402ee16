/* A run that can be made again: a set from its initial state, what a controller asked for and when, so many steps; and
 * what came of it. The hash of all states tells whether it is the same run. */
#ifndef SQUEAL_RECORDING_H
#define SQUEAL_RECORDING_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "squeal/device/device.h"
#include "squeal/support/csv.h"

struct recording {
    struct device_value *set; /* every parameter of the device; NULL: not read */
    size_t set_count;
    struct params_points tables[PARAMS_TABLES];
    struct input_demand *inputs; /* by their step, which is that of the state they are held from: 0 the initial one */
    size_t input_count;
    uint64_t steps;

    uint64_t at; /* the step that was reached */
    uint32_t hash;
    bool is_fault, was_cut; /* what ended it before its steps were made */
    struct device_status status;
};

void recording_free(struct recording *recording);

/* Adds one; false out of memory. Those of a later step come later. */
bool recording_add_input(struct recording *recording, const struct input_demand *demand);

/* Reads a table of inputs: column step, and one or more of N[N], p[Pa], v0[m/s], vehicle[m/s]; an empty cell leaves as
 * it was, the word profile gives back to the profile. */
bool recording_read_inputs(struct recording *recording, const char *path, char problem[CSV_PROBLEM_MAX]);

/* Reads the set in force. */
enum device_result recording_read_set(struct recording *recording, struct device *device);

/* Puts the set into force and goes back to step 0. */
enum device_result recording_load(const struct recording *recording, struct device *device);

/* Makes the steps from step 0, with a bar of progress. The first Ctrl-C ends it after a moment, and that is then the
 * run. */
enum device_result recording_play(struct recording *recording, struct device *device);

/* What the samples of a run went into. */
struct recording_samples {
    const char *path; /* NULL: none were taken */
    const int *signals;
    size_t signal_count;
    uint32_t every;
    uint64_t count, missing;
};

/* Writes the record as JSON. */
bool recording_write(const struct recording *recording, struct device *device, const char *port,
                     const struct recording_samples *samples, const char *path, char problem[CSV_PROBLEM_MAX]);

/* Reads one that was written, for a device that may be another than the one it was made on: what it has no name for, or
 * values that it does not take, are a problem. */
bool recording_read(struct recording *recording, struct device *device, const char *path,
                    char problem[CSV_PROBLEM_MAX]);

#endif
