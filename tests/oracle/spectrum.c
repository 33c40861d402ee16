/* Fast Fourier transform with radix 2, and a golden-section search on the windowed sum itself. */
#include "spectrum.h"

#include <complex.h>
#include <math.h>
#include <stdlib.h>

static const double pi = 3.141592653589793;

static double complex turn_by(double angle)
{
    const double complex i = I;

    return cos(angle) + i * sin(angle);
}

static double hann(size_t i, size_t count) { return 0.5 - 0.5 * cos(2.0 * pi * ((double)i + 0.5) / (double)count); }

static void transform(double complex *value, size_t count)
{
    for (size_t i = 1, j = 0; i < count; i++) {
        size_t bit = count >> 1;

        for (; (j & bit) != 0; bit >>= 1) {
            j ^= bit;
        }
        j ^= bit;
        if (i < j) {
            const double complex swap = value[i];

            value[i] = value[j];
            value[j] = swap;
        }
    }
    for (size_t half = 1; half < count; half *= 2) {
        for (size_t k = 0; k < half; k++) {
            const double complex turn = turn_by(-pi * (double)k / (double)half);

            for (size_t i = k; i < count; i += 2 * half) {
                const double complex odd = turn * value[i + half];

                value[i + half] = value[i] - odd;
                value[i] += odd;
            }
        }
    }
}

/* Amplitude of the windowed samples at one frequency. */
static double amplitude_at(const double *weighted, size_t count, double cycles_per_sample)
{
    const double complex turn = turn_by(-2.0 * pi * cycles_per_sample);
    double complex sum = 0.0;

    for (size_t i = count; i-- > 0;) {
        sum = sum * turn + weighted[i];
    }
    return 2.0 * cabs(sum) / (0.5 * (double)count);
}

static struct spectrum_tone refine(const double *weighted, size_t count, double low, double high)
{
    const double ratio = 0.6180339887498949;
    double a = high - ratio * (high - low);
    double b = low + ratio * (high - low);
    double at_a = amplitude_at(weighted, count, a);
    double at_b = amplitude_at(weighted, count, b);

    for (int i = 0; i < 40; i++) {
        if (at_a > at_b) {
            high = b;
            b = a;
            at_b = at_a;
            a = high - ratio * (high - low);
            at_a = amplitude_at(weighted, count, a);
        } else {
            low = a;
            a = b;
            at_a = at_b;
            b = low + ratio * (high - low);
            at_b = amplitude_at(weighted, count, b);
        }
    }
    return (struct spectrum_tone){0.5 * (a + b), fmax(at_a, at_b)};
}

static size_t strongest_line(const double complex *line, size_t count)
{
    size_t best = 1;

    for (size_t i = 2; i < count / 2; i++) {
        best = cabs(line[i]) > cabs(line[best]) ? i : best;
    }
    return best;
}

struct spectrum_tone spectrum_strongest(const double *sample, size_t count)
{
    struct spectrum_tone tone = {0.0, 0.0};
    size_t size = 1;
    double mean = 0.0;
    double *weighted;
    double complex *line;

    while (size < 2 * count) {
        size *= 2;
    }
    weighted = calloc(size, sizeof *weighted);
    line = calloc(size, sizeof *line);
    if (weighted != NULL && line != NULL && count > 8) {
        size_t best;

        for (size_t i = 0; i < count; i++) {
            mean += sample[i] / (double)count;
        }
        for (size_t i = 0; i < count; i++) {
            weighted[i] = (sample[i] - mean) * hann(i, count);
            line[i] = weighted[i];
        }
        transform(line, size);
        best = strongest_line(line, size);
        if (cabs(line[best]) > 0.0) {
            tone = refine(weighted, count, (double)(best - 1) / (double)size, (double)(best + 1) / (double)size);
        }
    }
    free(weighted);
    free(line);
    return tone;
}
