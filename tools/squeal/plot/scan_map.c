/* The map of a table that scan has written. */
#include "squeal/plot/scan_map.h"

#include "squeal/plot/tiles.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { FIRST_AXIS_COLUMN = 2, POINTS_MAX = 256 };

static bool fail(char problem[CSV_PROBLEM_MAX], const char *what)
{
    (void)snprintf(problem, CSV_PROBLEM_MAX, "%s", what);
    return false;
}

/* The axis whose place is in the column: as many points as the largest index says, ends as they stand in the table. */
static bool axis_read(struct tiles_axis *axis, const struct csv *csv, int place, int column)
{
    double middle = (double)NAN;

    for (size_t row = 0; row < csv->rows; row++) {
        const double index = csv_number(csv, row, place), value = csv_number(csv, row, column);
        if (!(index >= 0.0 && index < POINTS_MAX) || isnan(value)) {
            return false;
        }
        axis->points = (size_t)index + 1 > axis->points ? (size_t)index + 1 : axis->points;
    }
    for (size_t row = 0; row < csv->rows; row++) {
        const size_t index = (size_t)csv_number(csv, row, place);
        const double value = csv_number(csv, row, column);
        axis->from = index == 0 ? value : axis->from;
        axis->to = index == axis->points - 1 ? value : axis->to;
        middle = index == 1 ? value : middle;
    }
    const double last = (double)(axis->points - 1);
    const bool can_be_log = axis->points > 2 && axis->from * axis->to > 0.0;
    axis->is_log = can_be_log && fabs(middle - axis->from * pow(axis->to / axis->from, 1.0 / last)) <
                                     fabs(middle - axis->from - (axis->to - axis->from) / last);
    (void)snprintf(axis->label, sizeof axis->label, "%.*s  %s", (int)strcspn(csv->cells[column], "["),
                   csv->cells[column], csv->cells[column] + strcspn(csv->cells[column], "["));
    return true;
}

static enum detector_propensity propensity_of(const char *name)
{
    for (int i = PROPENSITY_QUIET; i <= PROPENSITY_SQUEAL; i++) {
        if (strcmp(name, detector_propensity_name((uint8_t)i)) == 0) {
            return (enum detector_propensity)i;
        }
    }
    return PROPENSITY_UNKNOWN;
}

static void points_read(struct tiles_point *points, const struct csv *csv, size_t width)
{
    const int propensity = csv_column(csv, "propensity"), predicted = csv_column(csv, "predicted");
    const int class = csv_column(csv, "class"), error = csv_column(csv, "error");
    const int amplitude = csv_column(csv, "amplitude[um]");

    for (size_t row = 0; row < csv->rows; row++) {
        struct tiles_point *point = &points[(size_t)csv_number(csv, row, 0) + width * (size_t)csv_number(csv, row, 1)];
        point->is_there = csv_cell(csv, row, error)[0] == '\0';
        point->propensity = propensity_of(csv_cell(csv, row, propensity));
        point->predicted = propensity_of(csv_cell(csv, row, predicted));
        point->is_growing = strcmp(csv_cell(csv, row, class), "growing") == 0;
        point->amplitude_um = csv_number(csv, row, amplitude);
    }
}

static bool is_scan(const struct csv *csv)
{
    static const char *const needed[] = {"propensity", "class", "amplitude[um]", "predicted", "error"};
    bool is_good = csv->columns > FIRST_AXIS_COLUMN + 1 && csv_column(csv, "i") == 0 && csv_column(csv, "j") == 1;

    for (size_t i = 0; i < sizeof needed / sizeof needed[0]; i++) {
        is_good = is_good && csv_column(csv, needed[i]) > FIRST_AXIS_COLUMN;
    }
    return is_good && csv->rows > 0;
}

bool scan_map_draw(const struct csv *csv, const char *title, const char *path, char problem[CSV_PROBLEM_MAX])
{
    struct tiles tiles = {.path = path};

    if (!is_scan(csv)) {
        return fail(problem, "this is no table that scan has written");
    }
    if (csv_column(csv, "propensity") != FIRST_AXIS_COLUMN + TILES_AXES) {
        return fail(problem, "a map takes a scan of two parameters");
    }
    for (int i = 0; i < TILES_AXES; i++) {
        if (!axis_read(&tiles.axes[i], csv, i, FIRST_AXIS_COLUMN + i)) {
            return fail(problem, "an axis of the scan is no row of numbers");
        }
    }
    struct tiles_point *points = calloc(tiles.axes[0].points * tiles.axes[1].points, sizeof *points);
    if (points == NULL) {
        return fail(problem, "out of memory");
    }
    points_read(points, csv, tiles.axes[0].points);
    tiles.points = points;
    (void)snprintf(tiles.title, sizeof tiles.title, "Where the brake squeals: %zu trials", csv->rows);
    (void)snprintf(tiles.subtitle, sizeof tiles.subtitle, "%.200s", title);
    const bool is_drawn = tiles_draw(&tiles);
    free(points);
    return is_drawn || fail(problem, "gnuplot could not draw the map");
}
