/* A small generator of random numbers (splitmix64) that gives the same numbers on every machine: integers, and of
 * floating point only what IEEE 754 rounds in one way. */
#ifndef MERIT_DICE_H
#define MERIT_DICE_H

#include <stdint.h>

struct dice {
    uint64_t state; /* the seed */
};

uint64_t dice_next(struct dice *dice);

/* From 0 to count - 1. */
int dice_choice(struct dice *dice, int count);

double dice_uniform(struct dice *dice, double low, double high);

/* Uniform in the logarithm; 0 < low <= high. */
double dice_log(struct dice *dice, double low, double high);

#endif
