/* The map as gnuplot's rectangles. */
#include "squeal/plot/tiles.h"

#include "squeal/plot/figure.h"

#include <math.h>

#define COLOUR_QUIET "#dbe7f1"
#define COLOUR_WATCH "#f3e3a3"
#define WATCH_LOOK "fs solid border lc rgb '#7a6a20' lw 1.5 fc rgb '" COLOUR_WATCH "'" /* light as quiet, but edged */
#define COLOUR_BORDER "#2668ad"
#define PALETTE "0 '#fdb777', 0.35 '#f28a3c', 0.7 '#c4511b', 1 '#6e2407'"
#define SEAM 0.03 /* of the room that a trial has on each axis, at either end */

/* What lies index trials from the first one; halves between two of them. */
static double place(const struct tiles_axis *axis, double index)
{
    const double last = axis->points > 1 ? (double)(axis->points - 1) : 1.0;
    const double to = axis->points > 1 ? axis->to : 2.0 * axis->from; /* a single one has room as well */

    return axis->is_log ? axis->from * pow(to / axis->from, index / last)
                        : axis->from + (to - axis->from) * index / last;
}

double tiles_low(const struct tiles_axis *axis) { return place(axis, -0.5); }
double tiles_high(const struct tiles_axis *axis) { return place(axis, (double)axis->points - 0.5); }

static size_t count_of(const struct tiles *tiles) { return tiles->axes[0].points * tiles->axes[1].points; }

/* The trials of one verdict: place, the four sides of the tile, amplitude. */
static void tiles_write(FILE *script, const struct tiles *tiles, const char *name, enum detector_propensity propensity)
{
    const struct tiles_axis *x = &tiles->axes[0], *y = &tiles->axes[1];

    (void)fprintf(script, "$%s << END\n", name);
    for (size_t k = 0; k < count_of(tiles); k++) {
        const double i = (double)(k % x->points), j = (double)(k / x->points);
        if (tiles->points[k].is_there && tiles->points[k].propensity == propensity) {
            (void)fprintf(script, "%.7g %.7g %.7g %.7g %.7g %.7g %.6g\n", place(x, i), place(y, j),
                          place(x, i - 0.5 + SEAM), place(x, i + 0.5 - SEAM), place(y, j - 0.5 + SEAM),
                          place(y, j + 0.5 - SEAM), tiles->points[k].amplitude_um);
        }
    }
    (void)fputs("nan nan nan nan nan nan nan\nEND\n", script); /* gnuplot wants one point at least */
}

/* Two neighbours of which one alone is predicted quiet. */
static bool is_border(const struct tiles_point *a, const struct tiles_point *b)
{
    return a->is_there && b->is_there && (a->predicted == PROPENSITY_QUIET) != (b->predicted == PROPENSITY_QUIET);
}

/* The side between each two such neighbours. */
static void border_write(FILE *script, const struct tiles *tiles)
{
    const struct tiles_axis *x = &tiles->axes[0], *y = &tiles->axes[1];

    (void)fputs("$border << END\nnan nan\n", script);
    for (size_t k = 0; k < count_of(tiles); k++) {
        const struct tiles_point *point = &tiles->points[k];
        const double i = (double)(k % x->points), j = (double)(k / x->points);
        if (k % x->points + 1 < x->points && is_border(point, point + 1)) {
            (void)fprintf(script, "\n%.7g %.7g\n%.7g %.7g\n", place(x, i + 0.5), place(y, j - 0.5), place(x, i + 0.5),
                          place(y, j + 0.5));
        }
        if (k / x->points + 1 < y->points && is_border(point, point + x->points)) {
            (void)fprintf(script, "\n%.7g %.7g\n%.7g %.7g\n", place(x, i - 0.5), place(y, j + 0.5), place(x, i + 0.5),
                          place(y, j + 0.5));
        }
    }
    (void)fputs("END\n", script);
}

/* A dot for each trial that still grew. */
static void dots_write(FILE *script, const struct tiles *tiles)
{
    const struct tiles_axis *x = &tiles->axes[0], *y = &tiles->axes[1];

    (void)fputs("$growing << END\nnan nan\n", script);
    for (size_t k = 0; k < count_of(tiles); k++) {
        if (tiles->points[k].is_there && tiles->points[k].is_growing) {
            (void)fprintf(script, "%.7g %.7g\n", place(x, (double)(k % x->points)), place(y, (double)(k / x->points)));
        }
    }
    (void)fputs("END\n", script);
}

static void line_write(FILE *script, const struct tiles *tiles)
{
    (void)fputs("$line << END\nnan nan\n", script);
    for (size_t i = 0; i < tiles->line_points; i++) {
        (void)fprintf(script, "%.7g %.7g\n", tiles->line[i][0], tiles->line[i][1]);
    }
    (void)fputs("END\n", script);
}

/* The amplitudes of what squeals and does not grow any more. */
static void colours_write(FILE *script, const struct tiles *tiles)
{
    double least = INFINITY, most = -INFINITY;

    for (size_t k = 0; k < count_of(tiles); k++) {
        const struct tiles_point *point = &tiles->points[k];
        if (point->is_there && point->propensity == PROPENSITY_SQUEAL && !point->is_growing) {
            least = fmin(least, point->amplitude_um);
            most = fmax(most, point->amplitude_um);
        }
    }
    if (most >= least) {
        const double margin = most > least ? 0.0 : 0.5;
        (void)fprintf(script,
                      "set cbrange [%.6g:%.6g]\nset cbtics out\n"
                      "set cblabel 'amplitude where it squeals  [" FIGURE_MICRO "m]'\n",
                      least - margin, most + margin);
    } else {
        (void)fputs("set cbrange [0:1]\nunset colorbox\n", script);
    }
}

static void axis_write(FILE *script, const struct tiles_axis *axis, char name)
{
    const double low = tiles_low(axis), high = tiles_high(axis);
    char words[TILES_TEXT];

    (void)fprintf(script, "set %crange [%.7g:%.7g]\nset %clabel '%s'\n", name, axis->is_reversed ? high : low,
                  axis->is_reversed ? low : high, name, figure_label(axis->label, words, sizeof words));
    /* A negative axis has no logarithm, so its tiles differ in width. */
    if (axis->is_log && low > 0.0 && high > 0.0) {
        (void)fprintf(script, "set logscale %c\n", name);
    }
    if (axis->format != NULL) {
        (void)fprintf(script, "set format %c '%s'\n", name, axis->format);
    }
}

static void frame_write(FILE *script, const struct tiles *tiles)
{
    char words[TILES_TEXT], more[TILES_TEXT];

    (void)fprintf(script, "set title offset 0,1.3 \"%s\\n{/*0.8 %s}\"\n",
                  figure_plain(tiles->title, words, sizeof words), figure_plain(tiles->subtitle, more, sizeof more));
    (void)fputs("set lmargin at screen 0.125\nset rmargin at screen 0.85\nset bmargin at screen 0.13\n"
                "set tmargin at screen 0.845\nunset grid\n"
                "set key at graph 1,1.005 right bottom horizontal maxrows 1 samplen 1.5 width -1 font ',15'\n"
                "set palette defined (" PALETTE ")\n",
                script);
    axis_write(script, &tiles->axes[0], 'x');
    axis_write(script, &tiles->axes[1], 'y');
    colours_write(script, tiles);
    if (tiles->decorate != NULL) {
        tiles->decorate(script, tiles->context);
    }
}

bool tiles_draw(const struct tiles *tiles)
{
    FILE *script = figure_open();

    if (script == NULL) {
        return false;
    }
    tiles_write(script, tiles, "quiet", PROPENSITY_QUIET);
    tiles_write(script, tiles, "watch", PROPENSITY_WATCH);
    tiles_write(script, tiles, "squeal", PROPENSITY_SQUEAL);
    border_write(script, tiles);
    dots_write(script, tiles);
    line_write(script, tiles);
    for (int i = 0; i < 2; i++) {
        figure_start(script, tiles->path, i == 0);
        frame_write(script, tiles);
        (void)fprintf(script, "size = %g\n", i == 0 ? 0.4 : 0.7); /* the formats differ in what a point's size is */
        (void)fputs("plot $quiet using 1:2:3:4:5:6 with boxxyerror fs solid noborder fc rgb '" COLOUR_QUIET
                    "' notitle, "
                    "$watch using 1:2:3:4:5:6 with boxxyerror " WATCH_LOOK " notitle, "
                    "$squeal using 1:2:3:4:5:6:7 with boxxyerror fs solid noborder fc palette notitle, "
                    "$border with lines lw 3 lc rgb '" COLOUR_BORDER "' notitle, "
                    "$line with lines lw 3 lc rgb 'black' notitle, "
                    "$growing with points pt 7 ps size lc rgb '#303030' notitle, "
                    "NaN with boxes fs solid noborder fc rgb '" COLOUR_QUIET "' title 'quiet', "
                    "NaN with boxes " WATCH_LOOK " title 'watch', "
                    "NaN with points pt 7 ps size lc rgb '#303030' title 'still growing', "
                    "NaN with lines lw 3 lc rgb '" COLOUR_BORDER "' title 'border as predicted'\n",
                    script);
    }
    return figure_close(script, tiles->path);
}
