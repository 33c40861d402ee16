/* The one record that crosses from the interrupt to main: raw numbers in the model's units, made into text there. */
#ifndef SIM_SAMPLE_H
#define SIM_SAMPLE_H

#include <stdint.h>

#include "base/fmath.h"
#include "model/params.h"
#include "model/scale.h"

struct sample {
    uint64_t step;
    /* words of the arithmetic that made them: bits of a float, or Q4.27 */
    uint32_t x, v, y, w; /* displacement, velocity, normal displacement, normal velocity */
    uint32_t load, disc; /* n and v0 held over the step */
    uint32_t friction;   /* on the pad, m wn Vref */
    uint32_t hash;
    int8_t mode;        /* enum plant_mode */
    uint8_t arithmetic; /* ARITH_F32 or ARITH_Q27 */
    uint8_t propensity; /* enum detector_propensity */
    uint8_t is_fault;   /* the plant is frozen */
    uint8_t epoch;      /* which reset it belongs to, modulo 256 */
    uint8_t watch;      /* enum watch_state */
    uint16_t number;    /* in the order in which they were made, dropped ones counted, modulo 65536 */
};

/* The number that a word of the sample stands for, in the model's units. [MAIN] */
static inline float sample_value(const struct sample *sample, uint32_t word)
{
    return sample->arithmetic == ARITH_Q27 ? (float)(int32_t)word * (1.0f / 134217728.0f) : fmath_from_bits(word);
}

/* Displacement; integers count it in units of 2^length_shift. [MAIN] */
static inline float sample_displacement(const struct sample *sample, const struct scale *scale)
{
    const float x = sample_value(sample, sample->x);

    return sample->arithmetic == ARITH_Q27 ? x * (float)(1u << scale->length_shift) : x;
}

#endif
