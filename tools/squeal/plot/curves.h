/* Pictures of a recorded table, whose columns are called like signal[unit]. */
#ifndef SQUEAL_CURVES_H
#define SQUEAL_CURVES_H

#include <stdbool.h>
#include <stddef.h>

#include "squeal/support/csv.h"

enum { CURVES_MAX = 6 };

struct curves {
    const char *title;
    const char *path; /* of the picture, without .svg or .png */
    double *t_s;
    size_t count; /* of samples */
    size_t columns;
    char name[CURVES_MAX][32], unit[CURVES_MAX][32];
    double *values[CURVES_MAX];
};

/* Brings the values of each column to a unit that makes them readable. */
void curves_scale(struct curves *curves);

/* Each draws one kind of picture; false with the problem. phase takes the first column across and the second up. */
bool curves_phase(const struct curves *curves, char problem[CSV_PROBLEM_MAX]);
bool curves_time(const struct curves *curves, char problem[CSV_PROBLEM_MAX]);
bool curves_spectrum(const struct curves *curves, char problem[CSV_PROBLEM_MAX]);

#endif
