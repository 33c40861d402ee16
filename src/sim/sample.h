/* The one record that crosses from the interrupt to main: raw numbers in the model's units, made into text there. */
#ifndef SIM_SAMPLE_H
#define SIM_SAMPLE_H

#include <stdint.h>

struct sample {
    uint64_t step;
    float x, v, y, w;   /* displacement, velocity, normal displacement, normal velocity */
    float load, disc;   /* n and v0 held over the step */
    float friction;     /* on the pad, m wn Vref */
    int8_t mode;        /* enum plant_mode */
    uint8_t propensity; /* enum detector_propensity */
    uint8_t is_fault;   /* the plant is frozen */
    uint8_t epoch;      /* which reset it belongs to, modulo 256 */
    uint32_t hash;
};

#endif
