/* Hann's window and a radix-2 transform (Cooley and Tukey, 1965). */
#include "squeal/plot/spectrum.h"

#include <math.h>
#include <stdlib.h>

#define HANN_GAIN 0.5  /* mean of the window */
#define HANN_WIDTH 4.0 /* lines of its main lobe */
#define PI 3.14159265358979323846

enum { LINES_NEAR_ZERO = 3 };

struct complex {
    double re, im;
};

/* Into the order of reversed bits. */
static void shuffle(struct complex *data, size_t count)
{
    for (size_t i = 1, j = 0; i < count; i++) {
        size_t bit = count >> 1;
        for (; (j & bit) != 0; bit >>= 1) {
            j ^= bit;
        }
        j ^= bit;
        if (i < j) {
            const struct complex other = data[i];
            data[i] = data[j];
            data[j] = other;
        }
    }
}

static void transform(struct complex *data, size_t count)
{
    shuffle(data, count);
    for (size_t half = 1; half < count; half *= 2) {
        for (size_t k = 0; k < half; k++) {
            const double angle = -PI * (double)k / (double)half;
            const double re = cos(angle), im = sin(angle);
            for (size_t i = k; i < count; i += 2 * half) {
                const struct complex a = data[i], b = data[i + half];
                const struct complex turned = {b.re * re - b.im * im, b.re * im + b.im * re};
                data[i] = (struct complex){a.re + turned.re, a.im + turned.im};
                data[i + half] = (struct complex){a.re - turned.re, a.im - turned.im};
            }
        }
    }
}

/* The mean is the window's own: what is constant leaks into no line. */
static void window(struct complex *data, const double *samples, size_t count)
{
    double mean = 0.0;

    for (size_t i = 0; i < count; i++) {
        data[i] = (struct complex){HANN_GAIN - HANN_GAIN * cos(2.0 * PI * (double)i / (double)count), 0.0};
        mean += data[i].re * samples[i] / (HANN_GAIN * (double)count);
    }
    for (size_t i = 0; i < count; i++) {
        data[i].re *= samples[i] - mean;
    }
}

bool spectrum_make(struct spectrum *spectrum, const double *samples, size_t count, double rate_hz)
{
    size_t used = SPECTRUM_SAMPLES_MAX;

    while (used > count) {
        used /= 2;
    }
    if (used < SPECTRUM_SAMPLES_MIN) {
        return false;
    }
    struct complex *data = malloc(used * sizeof *data);
    *spectrum = (struct spectrum){.amplitude = malloc(used / 2 * sizeof(double)),
                                  .lines = used / 2,
                                  .step_hz = rate_hz / (double)used,
                                  .resolution_hz = HANN_WIDTH * rate_hz / (double)used};
    if (data == NULL || spectrum->amplitude == NULL) {
        free(data);
        free(spectrum->amplitude);
        return false;
    }
    window(data, samples + count - used, used);
    transform(data, used);
    for (size_t i = 0; i < used / 2; i++) {
        spectrum->amplitude[i] = hypot(data[i].re, data[i].im) * 2.0 / (HANN_GAIN * (double)used);
    }
    free(data);
    return true;
}

size_t spectrum_peak(const struct spectrum *spectrum)
{
    size_t peak = LINES_NEAR_ZERO;

    for (size_t i = LINES_NEAR_ZERO; i < spectrum->lines; i++) {
        peak = spectrum->amplitude[i] > spectrum->amplitude[peak] ? i : peak;
    }
    return peak;
}
