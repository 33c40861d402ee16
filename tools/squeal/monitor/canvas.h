/* A part of a screen to draw in with dots, two across and four down in each character (Unicode's braille). Later dots
 * lend their colour to the whole character, so what is old is drawn first. */
#ifndef SQUEAL_CANVAS_H
#define SQUEAL_CANVAS_H

#include "squeal/monitor/screen.h"

struct canvas {
    struct screen *screen;
    int row, col, rows, cols; /* characters of the screen */
};

enum { CANVAS_ACROSS = 2, CANVAS_DOWN = 4 }; /* dots of a character */

/* A range of numbers along a side of a canvas. */
struct axis {
    double low, high;
};

/* The dot at x from the left, y from the top; outside the canvas nothing is drawn. */
void canvas_dot(const struct canvas *canvas, int x, int y, enum tint tint);

/* All dots between two, both included. */
void canvas_line(const struct canvas *canvas, int x0, int y0, int x1, int y1, enum tint tint);

/* Which dot a value is: from the left, from the top. Values far outside, and those that are no numbers, are outside. */
int canvas_across(const struct canvas *canvas, const struct axis *axis, double value);
int canvas_down(const struct canvas *canvas, const struct axis *axis, double value);

/* Fits the axis to what is to be shown, in round numbers, and to at least some span, so that noise is not blown up. It
 * stays as it is while low and high are inside and fill a fair share of it, so that a picture does not breathe. False
 * and unchanged if these are no numbers. */
bool axis_follow(struct axis *axis, double low, double high, double least_span);

/* The largest of 1, 2, 5, 10, 20 .. and their tenths that is not above the value, which is positive. */
double axis_round_down(double value);

#endif
