/* The amplitude spectrum of equally spaced samples. */
#ifndef SQUEAL_SPECTRUM_H
#define SQUEAL_SPECTRUM_H

#include <stdbool.h>
#include <stddef.h>

enum { SPECTRUM_SAMPLES_MIN = 64, SPECTRUM_SAMPLES_MAX = 1 << 18 };

struct spectrum {
    double *amplitude; /* lines of them: peak values, in the unit of the samples; a sine on a line reads as its own */
    size_t lines;      /* from frequency 0 up to just below half the sampling rate */
    double step_hz;
    double resolution_hz; /* two tones that are closer are one */
};

/* Takes the last samples, a power of two of them, less their mean and under Hann's window. False if there are too few,
 * or no memory; free(spectrum->amplitude) takes it back. */
bool spectrum_make(struct spectrum *spectrum, const double *samples, size_t count, double rate_hz);

/* The highest line but those next to frequency 0. */
size_t spectrum_peak(const struct spectrum *spectrum);

#endif
