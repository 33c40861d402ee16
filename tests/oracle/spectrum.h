/* The strongest tone of an evenly sampled signal. */
#ifndef ORACLE_SPECTRUM_H
#define ORACLE_SPECTRUM_H

#include <stddef.h>

struct spectrum_tone {
    double cycles_per_sample;
    double amplitude;
};

/* Hann's window, a transform for the peak, then its exact place between the lines. The mean is ignored. Returns a tone
 * of zero if there is none or memory is short. */
struct spectrum_tone spectrum_strongest(const double *sample, size_t count);

#endif
