/* plot: pictures of what record and scan have written. */
#include "squeal/exits.h"
#include "squeal/plot/curves.h"
#include "squeal/plot/figure.h"
#include "squeal/plot/scan_map.h"
#include "squeal/subcommands.h"
#include "squeal/support/arguments.h"
#include "squeal/support/csv.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { PATH_SIZE = 1024 };

static const struct kind {
    const char *name, *standard; /* columns unless others are asked for */
    size_t least, most;          /* columns that it takes */
    bool (*draw)(const struct curves *curves, char problem[CSV_PROBLEM_MAX]);
} kinds[] = {{"phase", "x,xd", 2, 2, curves_phase},
             {"time", "x,xd,N,v0", 1, CURVES_MAX, curves_time},
             {"spectrum", "xd", 1, 1, curves_spectrum},
             {"map", "", 0, 0, NULL}};

static int fail(const char *problem)
{
    (void)fflush(stdout);
    fprintf(stderr, "squeal: %s\n", problem);
    return EXIT_FAILED;
}

/* The column of a signal: called like it, or like it with a unit in brackets. */
static int column_of(const struct csv *csv, const char *signal, size_t length, char *unit, size_t size)
{
    for (size_t i = 0; i < csv->columns; i++) {
        const char *name = csv->cells[i];
        if (strncmp(name, signal, length) == 0 && (name[length] == '\0' || name[length] == '[')) {
            (void)snprintf(unit, size, "%.*s", name[length] == '[' ? (int)strcspn(name + length + 1, "]") : 1,
                           name[length] == '[' ? name + length + 1 : "1");
            return (int)i;
        }
    }
    return -1;
}

/* The rows of a column within from..to seconds. NULL out of memory, or where a cell is no number. */
static double *column_read(const struct csv *csv, int column, size_t first, size_t last)
{
    double *values = malloc((last - first + 1) * sizeof *values);

    for (size_t row = first; values != NULL && row < last; row++) {
        values[row - first] = csv_number(csv, row, column);
        if (isnan(values[row - first])) {
            free(values);
            return NULL;
        }
    }
    return values;
}

/* Where the wanted time begins and ends among the rows, which are in its order. */
static bool rows_find(const struct arguments *arguments, const struct csv *csv, int column, size_t *first, size_t *last)
{
    double from = -INFINITY, to = INFINITY;

    if (!arguments_real(arguments, "--from", -1e30, 1e30, &from) ||
        !arguments_real(arguments, "--to", -1e30, 1e30, &to)) {
        return false;
    }
    *last = csv->rows;
    while (*first < csv->rows && !(csv_number(csv, *first, column) >= from)) {
        (*first)++;
    }
    while (*last > *first && !(csv_number(csv, *last - 1, column) <= to)) {
        (*last)--;
    }
    return true;
}

static bool columns_read(struct curves *curves, const struct csv *csv, const char *list, size_t first, size_t last,
                         char problem[CSV_PROBLEM_MAX])
{
    for (const char *at = list; *at != '\0' && curves->columns < CURVES_MAX; at += *at == ',' ? 1 : 0) {
        const size_t length = strcspn(at, ","), i = curves->columns;
        const int column = column_of(csv, at, length, curves->unit[i], sizeof curves->unit[i]);
        (void)snprintf(curves->name[i], sizeof curves->name[i], "%.*s", (int)length, at);
        curves->values[i] = column >= 0 ? column_read(csv, column, first, last) : NULL;
        if (curves->values[i] == NULL) {
            (void)snprintf(problem, CSV_PROBLEM_MAX,
                           column < 0 ? "%.160s: no column %s; record --signals has it written"
                                      : "%.160s: column %s holds more than numbers",
                           curves->title, curves->name[i]);
            return false;
        }
        (void)figure_label(curves->name[i], curves->name[i], sizeof curves->name[i]);
        (void)figure_label(curves->unit[i], curves->unit[i], sizeof curves->unit[i]);
        curves->columns++;
        at += length;
    }
    return true;
}

/* A map has no time: its table is another one. */
static int draw_map(const struct csv *csv, const struct curves *curves)
{
    char problem[CSV_PROBLEM_MAX];

    if (!scan_map_draw(csv, curves->title, curves->path, problem)) {
        return fail(problem);
    }
    printf("%s.svg\n%s.png\n", curves->path, curves->path);
    return EXIT_OK;
}

static int draw(const struct arguments *arguments, const struct kind *kind, const struct csv *csv,
                struct curves *curves)
{
    const char *list = arguments_text(arguments, "--signals");
    char problem[CSV_PROBLEM_MAX], unit[8];
    const int time = column_of(csv, "t", 1, unit, sizeof unit);
    size_t first = 0, last = 0;

    if (time < 0) {
        return fail("no column t: this is no table that record has written");
    }
    if (!rows_find(arguments, csv, time, &first, &last)) {
        return EXIT_USAGE;
    }
    if (last < first + 2) {
        return fail("less than two samples to draw");
    }
    curves->count = last - first;
    curves->t_s = column_read(csv, time, first, last);
    if (curves->t_s == NULL || !columns_read(curves, csv, list != NULL ? list : kind->standard, first, last, problem)) {
        return fail(curves->t_s == NULL ? "column t holds more than numbers" : problem);
    }
    if (curves->columns < kind->least || curves->columns > kind->most) {
        fprintf(stderr, "squeal: plot %s takes %zu to %zu signals\n", kind->name, kind->least, kind->most);
        return EXIT_USAGE;
    }
    curves_scale(curves);
    if (!kind->draw(curves, problem)) {
        return fail(problem);
    }
    printf("%s.svg\n%s.png\n", curves->path, curves->path);
    return EXIT_OK;
}

/* name.csv gives name-phase.svg beside it, unless told otherwise. */
static void path_name(char path[PATH_SIZE], const struct arguments *arguments, const char *file, const char *kind)
{
    const char *out = arguments_text(arguments, "--out");
    const char *suffix = strrchr(file, '.');

    if (out != NULL) {
        (void)snprintf(path, PATH_SIZE, "%s", out);
    } else {
        (void)snprintf(path, PATH_SIZE, "%.*s-%s", (int)(suffix != NULL ? (size_t)(suffix - file) : strlen(file)), file,
                       kind);
    }
}

int command_plot(const struct arguments *arguments)
{
    const struct kind *kind = NULL;
    char path[PATH_SIZE], problem[CSV_PROBLEM_MAX];
    struct curves curves = {0};
    struct csv csv;

    if (!arguments_has_operands(arguments, 2, 2)) {
        return EXIT_USAGE;
    }
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++) {
        kind = strcmp(kinds[i].name, arguments->operands[0]) == 0 ? &kinds[i] : kind;
    }
    if (kind == NULL) {
        fprintf(stderr, "squeal: plot draws phase, time, spectrum or map\n");
        return EXIT_USAGE;
    }
    const char *file = arguments->operands[1], *slash = strrchr(file, '/');
    if (!csv_read(&csv, file, problem)) {
        return fail(problem);
    }
    curves.title = slash != NULL ? slash + 1 : file;
    path_name(path, arguments, file, kind->name);
    curves.path = path;
    const int code = !figure_is_possible() ? fail("gnuplot is not installed; make setup installs it")
                     : kind->draw == NULL  ? draw_map(&csv, &curves)
                                           : draw(arguments, kind, &csv, &curves);
    for (size_t i = 0; i < CURVES_MAX; i++) {
        free(curves.values[i]);
    }
    free(curves.t_s);
    csv_free(&csv);
    return code;
}
