/* The brake as a sound: the pad's velocity in physical time, 16 bit mono. */
#ifndef SQUEAL_WAV_H
#define SQUEAL_WAV_H

#include <stddef.h>

#include "squeal/support/csv.h"

enum { WAV_RATE_HZ = 48000 };

/* Writes the velocity, known at these times, at most longest_s of it, scaled so that its peak fills 0.9 of the range.
 * Returns its length in s, or 0 with the problem set. */
double wav_write(const char *path, const double *t_s, const double *velocity, size_t samples, double longest_s,
                 char problem[CSV_PROBLEM_MAX]);

#endif
