/* The map: a tile for each trial, over force and slope. Squeal runs from light to dark with its size, so that it is read
 * in print too; what still grows carries a dot, for it is not yet at its size. The steeper slope is on top: upwards and
 * to the right it gets worse. */
#include "squeal/story/plot_parts.h"

#include "squeal/support/fields.h"

#include <math.h>

#define COLOUR_QUIET "#dbe7f1"
#define COLOUR_WATCH "#f3e3a3"
#define WATCH_LOOK "fs solid border lc rgb '#7a6a20' lw 1.5 fc rgb '" COLOUR_WATCH "'" /* light as quiet, but edged */
#define COLOUR_BORDER "#2668ad"
#define PALETTE "0 '#fdb777', 0.35 '#f28a3c', 0.7 '#c4511b', 1 '#6e2407'"
#define TILE 0.94        /* of the room a trial has on each axis; the rest is the seam */
#define LABEL_PLACE 0.62 /* along the axis of force, of the name on the line */
#define LINE_POINTS 200
#define PICTURE_SHAPE 0.74 /* height of the frame by its width, as the margins make it */

/* Of one axis: half the room of a trial, and what the axis shows. */
struct room {
    double half, low, high;
};

static struct room room_of(const struct map *map, int axis)
{
    const struct map_axis *plan = &map_plan.axes[axis];
    const double half = 0.5 * (plan->to - plan->from) / (double)(map->side > 1 ? map->side - 1 : 1);

    return (struct room){half, plan->from - half, plan->to + half};
}

static bool is_there(const struct map_point *point) { return point->line != NULL && !point->is_refused; }

/* The trials of one verdict: place, the four sides of the tile, amplitude. */
static void tiles_write(FILE *script, const struct map *map, const char *name, enum detector_propensity propensity)
{
    const double half[MAP_AXES] = {TILE * room_of(map, 0).half, TILE * room_of(map, 1).half};

    (void)fprintf(script, "$%s << END\n", name);
    for (size_t i = 0; i < map->side * map->side; i++) {
        const struct map_point *point = &map->points[i];
        if (is_there(point) && point->propensity == propensity) {
            (void)fprintf(script, "%.7g %.7g %.7g %.7g %.7g %.7g %.6g\n", point->at[0], point->at[1],
                          point->at[0] - half[0], point->at[0] + half[0], point->at[1] - half[1],
                          point->at[1] + half[1], point->amplitude_um);
        }
    }
    (void)fputs("nan nan nan nan nan nan nan\nEND\n", script); /* gnuplot wants one point at least */
}

/* Two neighbours of which one alone is predicted quiet. */
static bool is_border(const struct map_point *a, const struct map_point *b)
{
    return is_there(a) && is_there(b) && (a->predicted == PROPENSITY_QUIET) != (b->predicted == PROPENSITY_QUIET);
}

/* The side between each two such neighbours. */
static void border_write(FILE *script, const struct map *map)
{
    const double half[MAP_AXES] = {room_of(map, 0).half, room_of(map, 1).half};
    const size_t side = map->side;

    (void)fputs("$border << END\nnan nan\n", script);
    for (size_t i = 0; i < side * side; i++) {
        const struct map_point *point = &map->points[i];
        const double x = point->at[0] + half[0], y = point->at[1] + half[1];
        if (i % side + 1 < side && is_border(point, point + 1)) {
            (void)fprintf(script, "\n%.7g %.7g\n%.7g %.7g\n", x, point->at[1] - half[1], x, y);
        }
        if (i + side < side * side && is_border(point, point + side)) {
            (void)fprintf(script, "\n%.7g %.7g\n%.7g %.7g\n", point->at[0] - half[0], y, x, y);
        }
    }
    (void)fputs("END\n", script);
}

/* A dot for each trial that still grew. */
static void dots_write(FILE *script, const struct map *map)
{
    (void)fputs("$growing << END\nnan nan\n", script);
    for (size_t i = 0; i < map->side * map->side; i++) {
        const struct map_point *point = &map->points[i];
        if (is_there(point) && point->is_growing) {
            (void)fprintf(script, "%.7g %.7g\n", point->at[0], point->at[1]);
        }
    }
    (void)fputs("END\n", script);
}

/* |alpha| N = c, and its name along it, on the quiet side. */
static void line_write(FILE *script, const struct map *map)
{
    const struct room x = room_of(map, MAP_FORCE), y = room_of(map, MAP_SLOPE);

    (void)fputs("$line << END\nnan nan\n", script);
    for (int i = 0; i <= LINE_POINTS; i++) {
        const double force = x.low + (x.high - x.low) * i / LINE_POINTS;
        const double slope = -map->damping_n_s_per_m / force;
        if (slope >= fmin(y.low, y.high) && slope <= fmax(y.low, y.high)) {
            (void)fprintf(script, "%.7g %.7g\n", force, slope);
        }
    }
    (void)fputs("END\n", script);
}

static void line_name_write(FILE *script, const struct map *map)
{
    const struct room x = room_of(map, MAP_FORCE), y = room_of(map, MAP_SLOPE);
    const double force = x.low + LABEL_PLACE * (x.high - x.low);
    const double slope = -map->damping_n_s_per_m / force;
    const double share = (slope - y.high) / (y.low - y.high);
    const double rise = map->damping_n_s_per_m / (force * force) / (y.low - y.high) * (x.high - x.low);

    if (share > 0.0 && share < 1.0) {
        (void)fprintf(script,
                      "set label '|" FIGURE_ALPHA "| N = c = %g N s/m' at first %.7g, first %.7g center rotate by %.1f "
                      "offset 0,-1.1 front\n",
                      map->damping_n_s_per_m, force, slope, atan(rise * PICTURE_SHAPE) * 180.0 / acos(-1.0));
    }
}

static void title_write(FILE *script, const struct story *story)
{
    const struct map *map = &story->map;
    const size_t total = map->side * map->side;
    char arith[16], words[SESSION_LINE_MAX];

    (void)fields_text(map->status, "arith", arith, sizeof arith);
    (void)fprintf(script, "set title offset 0,1.3 \"Where the brake squeals: %zu trials on the device", map->came);
    if (map->came < total) {
        (void)fprintf(script, ", %zu missing", total - map->came);
    }
    (void)fprintf(script, "\\n{/*0.8 preset %s, board %s, %s, %.0f steps a normal period}\"\n", map_plan.preset,
                  figure_plain(story->board, words, sizeof words), arith, fields_number(map->status, "spp"));
}

static void frame_write(FILE *script, const struct map *map, const struct map_counts *counts)
{
    const struct room x = room_of(map, MAP_FORCE), y = room_of(map, MAP_SLOPE);
    const double margin = counts->most_um > counts->least_um ? 0.0 : 0.5;

    (void)fprintf(script,
                  "set lmargin at screen 0.125\nset rmargin at screen 0.85\nset bmargin at screen 0.13\n"
                  "set tmargin at screen 0.845\nset xrange [%.7g:%.7g]\nset yrange [%.7g:%.7g]\nunset grid\n"
                  "set key at graph 1,1.005 right bottom horizontal maxrows 1 samplen 1.5 width -1 font ',15'\n"
                  "set xlabel 'brake force N  [N]'\n"
                  "set ylabel 'friction slope " FIGURE_ALPHA "  [s/m], steeper upwards'\nset format y '%%.2f'\n"
                  "set palette defined (" PALETTE ")\n",
                  x.low, x.high, y.high, y.low);
    if (counts->most_um >= counts->least_um) {
        (void)fprintf(script,
                      "set cbrange [%.6g:%.6g]\nset cbtics out\n"
                      "set cblabel 'amplitude where it squeals  [" FIGURE_MICRO "m]'\n",
                      counts->least_um - margin, counts->most_um + margin);
    } else {
        (void)fputs("set cbrange [0:1]\nunset colorbox\n", script);
    }
}

void plot_map(struct story *story)
{
    const struct map *map = &story->map;
    const struct map_counts counts = map_count(map);
    FILE *script = map->came > 0 ? plot_script_open(story) : NULL;

    if (script == NULL) {
        return;
    }
    tiles_write(script, map, "quiet", PROPENSITY_QUIET);
    tiles_write(script, map, "watch", PROPENSITY_WATCH);
    tiles_write(script, map, "squeal", PROPENSITY_SQUEAL);
    border_write(script, map);
    dots_write(script, map);
    line_write(script, map);
    for (int i = 0; i < 2; i++) {
        plot_picture_start(script, story, "map", i == 0);
        title_write(script, story);
        frame_write(script, map, &counts);
        line_name_write(script, map);
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
    plot_script_close(story, script, "map", "where the brake squeals, over brake force and friction slope");
}
