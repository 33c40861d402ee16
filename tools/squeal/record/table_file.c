/* Breakpoints from a file, and into one. */
#include "squeal/record/table_file.h"

#include "base/decimal.h"

#include <string.h>

static const char *const names[PARAMS_TABLES] = {"load", "speed"};
static const char *const columns[PARAMS_TABLES] = {"N[N]", "v0[m/s]"};

bool table_file_find(const char *name, enum params_table_index *index)
{
    for (int i = 0; i < PARAMS_TABLES; i++) {
        if (strcmp(name, names[i]) == 0) {
            *index = (enum params_table_index)i;
            return true;
        }
    }
    return false;
}

static bool read_cell(const struct csv *csv, size_t row, int column, float *value)
{
    const char *text = csv_cell(csv, row, column);

    return text != NULL && decimal_parse_f32(text, strlen(text), value);
}

static bool read_points(const struct csv *csv, const char *path, enum params_table_index index,
                        struct params_points *table, char problem[CSV_PROBLEM_MAX])
{
    const int time = csv_column(csv, "t[s]");
    const int value = csv_column(csv, columns[index]);

    if (time < 0 || value < 0) {
        (void)snprintf(problem, CSV_PROBLEM_MAX, "%.100s: columns t[s] and %s are wanted", path, columns[index]);
        return false;
    }
    if (csv->rows > PARAMS_POINTS_MAX) {
        (void)snprintf(problem, CSV_PROBLEM_MAX, "%.100s: a table holds at most %d points", path, PARAMS_POINTS_MAX);
        return false;
    }
    for (size_t row = 0; row < csv->rows; row++) {
        struct params_point point;
        if (!read_cell(csv, row, time, &point.time_s) || !read_cell(csv, row, value, &point.value) ||
            params_check_point(index, params_table_end_s(table), &point).error != ERROR_OK) {
            (void)snprintf(problem, CSV_PROBLEM_MAX,
                           "%.100s:%zu: a time not before the last one, and a value in the range of %s, are wanted",
                           path, csv->lines[row], params_table_values(index)->symbol);
            return false;
        }
        table->points[table->count++] = point;
    }
    return true;
}

bool table_file_read(const char *path, enum params_table_index index, struct params_points *table,
                     char problem[CSV_PROBLEM_MAX])
{
    struct csv csv;

    memset(table, 0, sizeof *table);
    if (!csv_read(&csv, path, problem)) {
        return false;
    }
    const bool is_good = read_points(&csv, path, index, table, problem);
    csv_free(&csv);
    return is_good;
}

void table_file_write(FILE *file, enum params_table_index index, const struct params_points *table)
{
    char time[DECIMAL_SIZE_MAX], value[DECIMAL_SIZE_MAX];

    (void)fprintf(file, "t[s],%s\n", columns[index]);
    for (uint32_t i = 0; i < table->count; i++) {
        (void)decimal_format_shortest(table->points[i].time_s, time);
        (void)decimal_format_shortest(table->points[i].value, value);
        (void)fprintf(file, "%s,%s\n", time, value);
    }
}
