/* What the pictures share. For the plot files alone. */
#ifndef SQUEAL_PLOT_PARTS_H
#define SQUEAL_PLOT_PARTS_H

#include <stdio.h>

#include "squeal/plot/figure.h"
#include "squeal/story/plot.h"

/* Samples of one normal period, at least 1. */
size_t plot_period_of(const struct act *act);

/* Starts gnuplot; NULL if that fails, which is then reported. */
FILE *plot_script_open(struct story *story);

/* Begins the picture called name in one of its two formats, with the look that all share. */
void plot_picture_start(FILE *script, const struct story *story, const char *name, bool is_svg);

/* The act's title, and under it what motion it ended in. */
void plot_title_write(FILE *script, const struct act *act);

/* Adds both formats of a picture to the closing list, or tells that it could not be drawn. */
void plot_tell(struct story *story, bool is_drawn, const char *name, const char *what);

/* Ends gnuplot, checks that both formats are there and adds them to the closing list. */
void plot_script_close(struct story *story, FILE *script, const char *name, const char *what);

#endif
