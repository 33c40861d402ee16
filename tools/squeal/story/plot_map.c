/* The map of the story, over force and slope. The steeper slope is on top: upwards and to the right it gets worse. */
#include "squeal/story/plot_parts.h"

#include "squeal/plot/tiles.h"
#include "squeal/support/fields.h"

#include <math.h>
#include <stdlib.h>

#define LABEL_PLACE 0.62 /* along the axis of force, of the name on the line */

enum { LINE_POINTS = 200 };

/* |alpha| N = c, as far as it lies in the picture. Returns how many points that is. */
static size_t line_make(const struct tiles *tiles, double damping, double line[LINE_POINTS + 1][TILES_AXES])
{
    const double x_low = tiles_low(&tiles->axes[MAP_FORCE]), x_high = tiles_high(&tiles->axes[MAP_FORCE]);
    const double y_low = tiles_low(&tiles->axes[MAP_SLOPE]), y_high = tiles_high(&tiles->axes[MAP_SLOPE]);
    size_t count = 0;

    for (int i = 0; i <= LINE_POINTS; i++) {
        const double force = x_low + (x_high - x_low) * i / LINE_POINTS;
        const double slope = -damping / force;
        if (slope >= fmin(y_low, y_high) && slope <= fmax(y_low, y_high)) {
            line[count][MAP_FORCE] = force;
            line[count++][MAP_SLOPE] = slope;
        }
    }
    return count;
}

struct named {
    const struct tiles *tiles;
    double damping_n_s_per_m;
};

/* The line's name along it, on the quiet side. */
static void name_write(FILE *script, const void *context)
{
    const struct named *named = context;
    const struct tiles_axis *axes = named->tiles->axes;
    const double x_low = tiles_low(&axes[MAP_FORCE]), x_high = tiles_high(&axes[MAP_FORCE]);
    const double y_low = tiles_low(&axes[MAP_SLOPE]), y_high = tiles_high(&axes[MAP_SLOPE]);
    const double force = x_low + LABEL_PLACE * (x_high - x_low);
    const double slope = -named->damping_n_s_per_m / force;
    const double share = (slope - y_high) / (y_low - y_high);
    const double rise = named->damping_n_s_per_m / (force * force) / (y_low - y_high) * (x_high - x_low);

    if (share > 0.0 && share < 1.0) {
        (void)fprintf(script,
                      "set label '|" FIGURE_ALPHA "| N = c = %g N s/m' at first %.7g, first %.7g center rotate by %.1f "
                      "offset 0,-1.1 front\n",
                      named->damping_n_s_per_m, force, slope, atan(rise * TILES_SHAPE) * 180.0 / acos(-1.0));
    }
}

static void titles_make(struct tiles *tiles, const struct story *story)
{
    const struct map *map = &story->map;
    const size_t missing = map->side * map->side - map->came;
    char arith[16], lost[64] = "";

    (void)fields_text(map->status, "arith", arith, sizeof arith);
    if (missing > 0) {
        (void)snprintf(lost, sizeof lost, ", %zu missing", missing);
    }
    (void)snprintf(tiles->title, TILES_TEXT, "Where the brake squeals: %zu trials on the device%s", map->came, lost);
    (void)snprintf(tiles->subtitle, TILES_TEXT, "preset %s, board %.100s, %s, %.0f steps a normal period",
                   map_plan.preset, story->board, arith, fields_number(map->status, "spp"));
}

static void points_make(struct tiles_point *points, const struct map *map)
{
    for (size_t i = 0; i < map->side * map->side; i++) {
        const struct map_point *point = &map->points[i];
        points[i] = (struct tiles_point){.is_there = point->line != NULL && !point->is_refused,
                                         .propensity = point->propensity,
                                         .predicted = point->predicted,
                                         .is_growing = point->is_growing,
                                         .amplitude_um = point->amplitude_um};
    }
}

void plot_map(struct story *story)
{
    const struct map *map = &story->map;
    struct tiles_point *points = map->came > 0 ? calloc(map->side * map->side, sizeof *points) : NULL;
    double line[LINE_POINTS + 1][TILES_AXES];
    char path[STORY_PATH_SIZE];

    if (points == NULL) {
        return;
    }
    points_make(points, map);
    struct tiles tiles = {.path = story_path(story, path, "map"),
                          .axes = {{.label = "brake force N  [N]"},
                                   {.label = "friction slope " FIGURE_ALPHA "  [s/m], steeper upwards",
                                    .is_reversed = true,
                                    .format = "%.2f"}},
                          .points = points};
    for (int i = 0; i < MAP_AXES; i++) {
        tiles.axes[i].from = map_plan.axes[i].from;
        tiles.axes[i].to = map_plan.axes[i].to;
        tiles.axes[i].points = map->side;
    }
    titles_make(&tiles, story);
    const struct named named = {&tiles, map->damping_n_s_per_m};
    tiles.line_points = line_make(&tiles, map->damping_n_s_per_m, line);
    tiles.line = (const double(*)[TILES_AXES])line;
    tiles.decorate = name_write;
    tiles.context = &named;
    plot_tell(story, tiles_draw(&tiles), "map", "where the brake squeals, over brake force and friction slope");
    free(points);
}
