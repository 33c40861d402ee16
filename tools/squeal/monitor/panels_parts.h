/* What the files that draw share. Not for anybody else. */
#ifndef SQUEAL_PANELS_PARTS_H
#define SQUEAL_PANELS_PARTS_H

#include "squeal/monitor/panels.h"

enum {
    PANELS_GUTTER = 9, /* columns for the numbers beside a plot */
    PANELS_MARGIN = 1, /* columns at either side */
    PANELS_COUNTER_ROWS = 2
};

/* A part of the screen. */
struct area {
    int row, col, rows, cols;
};

void panels_draw_strip(struct screen *screen, const struct picture *picture, struct area area);
void panels_draw_portrait(struct screen *screen, const struct picture *picture, struct area area);
void panels_draw_spectrum(struct screen *screen, const struct picture *picture, struct area area);

/* Rows of text: the first; at row; from row on; the last. */
void panels_draw_header(struct screen *screen, const struct picture *picture);
void panels_draw_motion(struct screen *screen, const struct picture *picture, int row);
void panels_draw_inputs(struct screen *screen, const struct picture *picture, int row);
void panels_draw_counters(struct screen *screen, const struct picture *picture, int row);
void panels_draw_bottom(struct screen *screen, const struct picture *picture);

void panels_draw_help(struct screen *screen);
void panels_draw_chooser(struct screen *screen, const struct picture *picture);

/* printf at a place, cut to width; returns the columns taken. */
int panels_print(struct screen *screen, int row, int col, int width, enum tint tint, const char *format, ...)
    __attribute__((format(printf, 6, 7)));

/* The same, ending before the column. */
void panels_print_left_of(struct screen *screen, int row, int end, enum tint tint, const char *text);

/* Columns that UTF-8 text takes. */
int panels_width(const char *text);

#endif
