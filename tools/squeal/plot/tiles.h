/* A map of trials: a tile for each, over two parameters. Squeal runs from light to dark with its size, so that it is
 * read in print too; what still grows carries a dot, for it is not yet at its size; the predicted border is a line. */
#ifndef SQUEAL_TILES_H
#define SQUEAL_TILES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#include "sim/detector.h"

enum { TILES_AXES = 2, TILES_TEXT = 256 };

/* Of the frame: height by width. */
#define TILES_SHAPE 0.74

struct tiles_axis {
    double from, to; /* places of the first trial and of the last */
    size_t points;
    bool is_log;      /* equal ratios */
    bool is_reversed; /* drawn from high to low */
    char label[TILES_TEXT];
    const char *format; /* of its tics; NULL: as it comes */
};

struct tiles_point {
    bool is_there; /* tried, and the model could hold it */
    enum detector_propensity propensity, predicted;
    bool is_growing;
    double amplitude_um;
};

struct tiles {
    const char *path; /* of the picture, without .svg or .png */
    char title[TILES_TEXT], subtitle[TILES_TEXT];
    struct tiles_axis axes[TILES_AXES];
    const struct tiles_point *points; /* the first axis fastest */
    const double (*line)[TILES_AXES]; /* one to be drawn over the tiles, and how many points it has */
    size_t line_points;
    void (*decorate)(FILE *script, const void *context); /* adds to the picture what it likes; NULL: nothing */
    const void *context;
};

/* Where the picture ends on an axis: half the room of a trial beyond the first and the last. */
double tiles_low(const struct tiles_axis *axis);
double tiles_high(const struct tiles_axis *axis);

/* Draws it; false if gnuplot cannot. */
bool tiles_draw(const struct tiles *tiles);

#endif
