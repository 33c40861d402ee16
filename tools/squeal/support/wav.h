/* The brake as a sound: the pad's velocity in physical time, 16 bit mono. */
#ifndef SQUEAL_WAV_H
#define SQUEAL_WAV_H

#include <stdbool.h>

#include "squeal/story/record.h"

enum { WAV_RATE_HZ = 48000 };

/* Writes the velocity of the act's samples, at most longest_s of them, scaled so that its peak fills 0.9 of the range.
 * Returns its length in s, or 0 with the problem set. */
double wav_write(const char *path, const struct act *act, double longest_s, char problem[CSV_PROBLEM_MAX]);

#endif
