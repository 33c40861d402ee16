/* What is counted: functions of the firmware, each under a set, and textbook code beside them. */
#ifndef SUBJECTS_H
#define SUBJECTS_H

#include <stdbool.h>
#include <stdint.h>

#include "model/plant.h"

struct subject {
    const char *name, *arith;
    const char *set;      /* assignments to the defaults */
    const char *function; /* whose instructions are counted, by its name in the image */
    void (*start)(const struct subject *subject);
    void (*prepare)(void);        /* before each call, not counted; may be NULL */
    void (*call)(void);           /* calls it once, or what does nothing in its place */
    void (*aim)(bool at_nothing); /* which of them; the difference is the function alone */
    uint32_t calls;
    float (*displacement)(void); /* of the pad now, m; may be NULL */
};

extern const struct subject subjects[];
extern const uint32_t subjects_count;

/* What the last call has stepped; of a textbook's pad it says nothing. */
const struct plant_output *subjects_output(void);

/* An executive that runs free under a set, with a sample every so many steps; 0 none. */
struct executive *subjects_executive(const char *set, const char *arith, uint32_t sample_every);

#endif
