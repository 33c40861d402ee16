/* What the pictures share. For the plot files alone. */
#ifndef SQUEAL_PLOT_PARTS_H
#define SQUEAL_PLOT_PARTS_H

#include <stdio.h>

#include "squeal/plot/plot.h"

#define PLOT_COLOUR_PATH "#b8c4d0"
#define PLOT_COLOUR_MOTION "#1f4e79"
#define PLOT_COLOUR_DISC "#b5651d"
#define PLOT_COLOUR_WATCH "#fff4d6"
#define PLOT_COLOUR_SQUEAL "#f9dede"

/* In UTF-8. A letter of a symbol font would be read as another one where that font is missing: mm for micrometres. */
#define PLOT_MICRO "\302\265"
#define PLOT_ALPHA "\316\261"

/* A unit that makes a quantity readable. */
struct plot_unit {
    double factor;
    const char *name;
};

/* The unit for quantities up to this size in SI. */
struct plot_unit plot_unit_of_length(double size);
struct plot_unit plot_unit_of_speed(double size);

/* Samples of one normal period, at least 1. */
size_t plot_period_of(const struct act *act);

/* Starts gnuplot; NULL if that fails, which is then reported. */
FILE *plot_script_open(struct story *story);

/* Begins the picture called name in one of its two formats, with the look that all share. */
void plot_picture_start(FILE *script, const struct story *story, const char *name, bool is_svg);

/* The text as gnuplot may print it: quotes and the marks of its enhanced text are replaced. */
const char *plot_plain(const char *text, char out[SESSION_LINE_MAX]);

/* The act's title, and under it what motion it ended in. */
void plot_title_write(FILE *script, const struct act *act);

/* Ends gnuplot, checks that both formats are there and adds them to the closing list. */
void plot_script_close(struct story *story, FILE *script, const char *name, const char *what);

#endif
