/* The RIFF file and the resampling. The stream runs at a multiple of the normal frequency, several times the 48 kHz of
 * the file, so each point of the file is read off a cubic through the four samples around it. */
#include "squeal/support/wav.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define PEAK (0.9 * 32767.0)

enum { HEADER_SIZE = 44, BYTES_A_POINT = 2 };

/* Through four equally spaced values, at fraction 0..1 between the middle two: Catmull-Rom. */
static double cubic(const double v[4], double fraction)
{
    const double slope0 = 0.5 * (v[2] - v[0]);
    const double slope1 = 0.5 * (v[3] - v[1]);
    const double rise = v[2] - v[1];

    return v[1] + fraction * (slope0 + fraction * (3.0 * rise - 2.0 * slope0 - slope1 +
                                                   fraction * (slope0 + slope1 - 2.0 * rise)));
}

struct motion {
    const double *t_s, *velocity;
    size_t count;
};

/* The velocity at time t_s between samples i and i + 1. */
static double velocity_at(const struct motion *motion, size_t i, double t_s)
{
    const double *t = motion->t_s, *all = motion->velocity;
    const double v[4] = {all[i > 0 ? i - 1 : i], all[i], all[i + 1], all[i + 2 < motion->count ? i + 2 : i + 1]};

    return cubic(v, (t_s - t[i]) / (t[i + 1] - t[i]));
}

/* Fills points[0..count), scaled to the file's range. A bounded motion has no mean velocity that had to be taken off.
 */
static void resample(const struct motion *motion, double *points, size_t count)
{
    double peak = 0.0;
    size_t i = 0;

    for (size_t point = 0; point < count; point++) {
        const double t_s = motion->t_s[0] + (double)point / WAV_RATE_HZ;
        while (i + 2 < motion->count && motion->t_s[i + 1] <= t_s) {
            i++;
        }
        points[point] = velocity_at(motion, i, t_s);
        peak = fmax(peak, fabs(points[point]));
    }
    for (size_t point = 0; point < count && peak > 0.0; point++) {
        points[point] *= PEAK / peak;
    }
}

static void put_little_endian(FILE *file, unsigned long value, int bytes)
{
    for (int i = 0; i < bytes; i++) {
        (void)fputc((int)(value >> (8 * i) & 0xffU), file);
    }
}

static void header_write(FILE *file, size_t points)
{
    const unsigned long size = (unsigned long)points * BYTES_A_POINT;

    (void)fputs("RIFF", file);
    put_little_endian(file, size + HEADER_SIZE - 8, 4);
    (void)fputs("WAVEfmt ", file);
    put_little_endian(file, 16, 4); /* length of what follows up to "data" */
    put_little_endian(file, 1, 2);  /* plain samples */
    put_little_endian(file, 1, 2);  /* one channel */
    put_little_endian(file, WAV_RATE_HZ, 4);
    put_little_endian(file, WAV_RATE_HZ * BYTES_A_POINT, 4);
    put_little_endian(file, BYTES_A_POINT, 2);
    put_little_endian(file, 16, 2);
    (void)fputs("data", file);
    put_little_endian(file, size, 4);
}

double wav_write(const char *path, const double *t_s, const double *velocity, size_t samples, double longest_s,
                 char problem[CSV_PROBLEM_MAX])
{
    const struct motion motion = {t_s, velocity, samples};

    if (samples < 2) {
        (void)snprintf(problem, CSV_PROBLEM_MAX, "%s: no samples to hear", path);
        return 0.0;
    }
    const double length_s = fmin(t_s[samples - 1] - t_s[0], longest_s);
    const size_t count = (size_t)fmax(1.0, floor(length_s * WAV_RATE_HZ));
    double *points = calloc(count, sizeof *points);
    FILE *file = points == NULL ? NULL : csv_create(path, problem);

    if (file == NULL) {
        if (points == NULL) {
            (void)snprintf(problem, CSV_PROBLEM_MAX, "%s: out of memory", path);
        }
        free(points);
        return 0.0;
    }
    resample(&motion, points, count);
    header_write(file, count);
    for (size_t i = 0; i < count; i++) {
        put_little_endian(file, (unsigned long)(lround(points[i]) & 0xffff), BYTES_A_POINT);
    }
    free(points);
    return csv_close(file, path, problem) ? (double)count / WAV_RATE_HZ : 0.0;
}
