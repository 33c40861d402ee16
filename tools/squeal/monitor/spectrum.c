/* A radix-2 transform in place: after Cooley and Tukey, decimation in time. */
#include "squeal/monitor/spectrum.h"

#include <math.h>

static const double PI = 3.14159265358979323846;

static void swap(double *a, double *b)
{
    const double kept = *a;

    *a = *b;
    *b = kept;
}

static void reverse_bits(double *re, double *im, size_t size)
{
    size_t mirrored = 0u;

    for (size_t i = 1u; i < size; i++) {
        size_t bit = size >> 1;

        for (; (mirrored & bit) != 0u; bit >>= 1) {
            mirrored ^= bit;
        }
        mirrored ^= bit;
        if (i < mirrored) {
            swap(&re[i], &re[mirrored]);
            swap(&im[i], &im[mirrored]);
        }
    }
}

static void transform(double *re, double *im, size_t size)
{
    reverse_bits(re, im, size);
    for (size_t half = 1u; half < size; half *= 2u) {
        for (size_t k = 0u; k < half; k++) {
            const double c = cos(PI * (double)k / (double)half);
            const double s = -sin(PI * (double)k / (double)half);

            for (size_t i = k; i < size; i += 2u * half) {
                const size_t j = i + half;
                const double real = c * re[j] - s * im[j];
                const double imaginary = c * im[j] + s * re[j];

                re[j] = re[i] - real;
                im[j] = im[i] - imaginary;
                re[i] += real;
                im[i] += imaginary;
            }
        }
    }
}

void spectrum_of(const double *values, size_t size, double *power)
{
    static double re[SPECTRUM_SIZE_MAX];
    static double im[SPECTRUM_SIZE_MAX];
    double mean = 0.0;

    /* The window's own mean, or what is constant would leak into the lowest bins. */
    for (size_t i = 0u; i < size; i++) {
        re[i] = 0.5 - 0.5 * cos(2.0 * PI * (double)i / (double)size);
        mean += values[i] * re[i] / (0.5 * (double)size);
    }
    for (size_t i = 0u; i < size; i++) {
        re[i] *= values[i] - mean;
        im[i] = 0.0;
    }
    transform(re, im, size);
    for (size_t k = 0u; k <= size / 2u; k++) {
        /* Hann's window halves a sine, which has two bins, one of them below zero. Its mean square is half its square. */
        const double amplitude = 4.0 * hypot(re[k], im[k]) / (double)size;

        power[k] = 0.5 * amplitude * amplitude;
    }
}

double spectrum_peak(const double *power, size_t size)
{
    size_t best = 0u;
    double left, middle, right, curve;

    for (size_t k = 2u; k < size / 2u; k++) {
        if (power[k] > 0.0 && power[k] >= power[k - 1u] && power[k] >= power[k + 1u] &&
            (best == 0u || power[k] > power[best])) {
            best = k;
        }
    }
    if (best == 0u) {
        return 0.0;
    }
    /* A parabola through three levels: Hann's peak is within a hundredth of a bin of it. */
    left = log(power[best - 1u] + 1e-300);
    middle = log(power[best]);
    right = log(power[best + 1u] + 1e-300);
    curve = left - 2.0 * middle + right;
    return (double)best + (curve < 0.0 ? 0.5 * (left - right) / curve : 0.0);
}
