/* The picture on a screen of any size: a function of both and of nothing else. */
#ifndef SQUEAL_PANELS_H
#define SQUEAL_PANELS_H

#include "squeal/monitor/picture.h"
#include "squeal/monitor/screen.h"

enum { PANELS_ROWS_MIN = 20, PANELS_COLS_MIN = 72 };

/* Draws all of it; on a screen that is smaller than the least, how large it would have to be. */
void panels_draw(struct screen *screen, const struct picture *picture);

/* Columns of the strip on a screen that wide. */
int panels_strip_cols(int cols);

#endif
