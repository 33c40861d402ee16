/* One case of the paper's model, walked over twenty normal periods by anything that can: where the pad is, 16 times a
 * period. The cases are Table 1 from rest but for what they name. */
#ifndef CONVERGE_WALK_H
#define CONVERGE_WALK_H

#include <stdbool.h>

enum { WALK_PERIODS = 20, WALK_LOOKS = 16, WALK_COUNT = WALK_PERIODS * WALK_LOOKS };

struct walk_case {
    const char *name, *title;
    double load_n, slope_s_per_m;
};

/* Position after each sixteenth of a period, m. */
struct walk {
    double x_m[WALK_COUNT];
};

/* The truth: the reference solver's Taylor series with located events. */
bool walk_reference(const struct walk_case *which, struct walk *walk);

enum walk_textbook { WALK_EVENT, WALK_NAIVE, WALK_TANH };

/* Double precision, as one would type it: RK4 in all four states, with events located, with the raw sign, or with
 * tanh(vr/(v0/100)) for it. steps_per_period is a multiple of 16. */
void walk_textbook(const struct walk_case *which, enum walk_textbook method, long steps_per_period, struct walk *walk);

/* The firmware's own plant. arith, normal and method are names of its choices, such as "q27", "exact", "event"; steps
 * from 16 to 1024. False if it refuses the set. */
bool walk_firmware(const struct walk_case *which, const char *arith, const char *normal, const char *method,
                   long steps_per_period, struct walk *walk);

/* Largest distance from the truth over the largest |x| of it. */
double walk_error(const struct walk *walk, const struct walk *truth);

#endif
