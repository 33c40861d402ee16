/* The pictures of the story, drawn by gnuplot, which is asked for nothing but lines: every number comes from the
 * samples. */
#ifndef SQUEAL_PLOT_H
#define SQUEAL_PLOT_H

#include "squeal/story/story.h"

/* phase-<act>.svg and .png: displacement against velocity, the end of the act over the way there. */
void plot_phase(struct story *story, const struct act *act);

/* stop-envelope.svg and .png: displacement over time while the disc slows down, its speed, and the verdict as bands. */
void plot_stop(struct story *story, const struct act *act);

/* map.svg and .png: where the brake squeals and how far it swings there, with the two borders that are said of it. */
void plot_map(struct story *story);

#endif
