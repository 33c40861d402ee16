/* The device tries, tiles.c draws. */
#include "squeal/paper/lab_map.h"

#include "squeal/paper/lab_live.h"
#include "squeal/plot/tiles.h"

#include <string.h>

enum { TEXT_SIZE = 256 };

static const struct device_point *try_all(struct lab *lab, const struct lab_map *map, size_t *count)
{
    const struct device_span span = {map->transient, map->window, false};
    char axes[TEXT_SIZE] = "";

    for (int i = 0; i < TILES_AXES; i++) {
        const struct lab_map_axis *axis = &map->axes[i];
        const size_t length = strlen(axes);
        (void)snprintf(axes + length, sizeof axes - length, "%s %.9g %.9g %u%s ", axis->symbol, axis->from, axis->to,
                       axis->points, axis->is_log ? " log" : "");
    }
    return lab_scan(lab, axes, &span, count);
}

static void save(struct lab *lab, const struct lab_map *map, const struct device_point *points, size_t count)
{
    char header[TEXT_SIZE];

    (void)snprintf(header, sizeof header,
                   "%s,%s,propensity,class,amplitude[m],growth[1/s],predicted,predicted_growth[1/s]",
                   map->axes[0].symbol, map->axes[1].symbol);
    FILE *file = lab_csv_open(lab, map->name, header);
    for (size_t i = 0; i < count; i++) {
        const struct device_point *point = &points[i];
        (void)fprintf(file, "%.9g,%.9g,%s,%s,%.9g,%.9g,%s,%.9g\n", (double)point->at[0], (double)point->at[1],
                      detector_propensity_name(point->propensity), detector_class_name(point->motion),
                      1e-6 * (double)point->amplitude_um, (double)point->growth_per_s,
                      detector_propensity_name(point->predicted), (double)point->predicted_growth_per_s);
    }
    lab_csv_close(lab, file, map->name);
}

static void decorate(FILE *script, const void *context)
{
    const struct lab_map *map = context;

    (void)fputs("set ylabel offset 1,0\n", script);
    if (map->is_metric) {
        (void)fputs("set cblabel 'amplitude where it squeals  [m]'\n", script);
    }
    if (map->line_points > 0) {
        const double *last = map->line[map->line_points - 1];
        (void)fprintf(script, "set label '%s' at %.7g,%.7g right offset -0.5,1 front\n", map->line_label, last[0],
                      last[1]);
    }
}

const struct device_point *lab_map_make(struct lab *lab, const struct lab_map *map, size_t *count)
{
    const struct device_point *points = try_all(lab, map, count);
    struct tiles_point *tile = lab_memory(lab, *count, sizeof *tile);
    char path[PAPER_PATH_MAX];
    struct tiles tiles = {.path = path,
                          .points = tile,
                          .line = map->line,
                          .line_points = map->line_points,
                          .decorate = decorate,
                          .context = map};

    lab_path(lab, path, map->name);
    (void)snprintf(tiles.title, sizeof tiles.title, "%s", map->title);
    (void)snprintf(tiles.subtitle, sizeof tiles.subtitle, "%s", map->subtitle);
    for (int i = 0; i < TILES_AXES; i++) {
        const struct lab_map_axis *axis = &map->axes[i];
        tiles.axes[i] = (struct tiles_axis){
            .from = axis->from, .to = axis->to, .points = axis->points, .is_log = axis->is_log, .format = "%g"};
        (void)snprintf(tiles.axes[i].label, sizeof tiles.axes[i].label, "%s", axis->label);
    }
    for (size_t i = 0; i < *count; i++) {
        tile[i] = (struct tiles_point){.is_there = points[i].error == 0,
                                       .propensity = (enum detector_propensity)points[i].propensity,
                                       .predicted = (enum detector_propensity)points[i].predicted,
                                       .is_growing = points[i].motion == CLASS_GROWING,
                                       .amplitude_um = (map->is_metric ? 1e-6 : 1.0) * (double)points[i].amplitude_um};
    }
    if (!tiles_draw(&tiles)) {
        lab_fail(lab, "gnuplot could not draw %s", path);
    }
    lab_picture(lab, map->name, map->caption);
    save(lab, map, points, *count);
    return points;
}
