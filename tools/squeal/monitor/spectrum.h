/* The spectrum of a motion: Hann's window, a Fourier transform, levels. */
#ifndef SQUEAL_SPECTRUM_H
#define SQUEAL_SPECTRUM_H

#include <stddef.h>

enum { SPECTRUM_SIZE_MAX = 2048, SPECTRUM_SIZE_MIN = 128 }; /* samples */

/* Mean square of what is in each bin of a sine that it meets: power[k] belongs to k/size of the sampling rate, for k in
 * 0 .. size/2. The mean is taken away. size is a power of two within the limits. */
void spectrum_of(const double *values, size_t size, double *power);

/* Where the highest peak of size/2 + 1 bins above the first two is, in bins, between bins too; 0 if there is none. */
double spectrum_peak(const double *power, size_t size);

#endif
