/* Rows of doubles in one piece. */
#include "squeal/paper/table.h"

#include <math.h>
#include <string.h>

enum { ROWS_FIRST = 64, HEADER_SIZE = 1024 };

struct table table_begin(const char *header)
{
    struct table table = {.header = header, .columns = 1};

    for (const char *at = header; (at = strchr(at, ',')) != NULL; at++) {
        table.columns++;
    }
    return table;
}

void table_add(struct lab *lab, struct table *table, const double *row)
{
    const size_t size = table->columns * sizeof(double);

    if (table->rows == table->capacity) {
        const size_t capacity = table->capacity > 0 ? 2 * table->capacity : ROWS_FIRST;
        double *cells = lab_memory(lab, capacity, size);
        if (table->rows > 0) {
            memcpy(cells, table->cells, table->rows * size);
        }
        table->cells = cells;
        table->capacity = capacity;
    }
    memcpy(table->cells + table->rows * table->columns, row, size);
    table->rows++;
}

double table_at(const struct table *table, size_t row, size_t column)
{
    return table->cells[row * table->columns + column];
}

size_t table_peak(const struct table *table, size_t column)
{
    size_t peak = 0;

    for (size_t row = 1; row < table->rows; row++) {
        const double value = table_at(table, row, column), highest = table_at(table, peak, column);
        peak = value > highest || (isnan(highest) && !isnan(value)) ? row : peak;
    }
    return peak;
}

void table_save(struct lab *lab, const struct table *table, const char *name, const char *comment)
{
    char header[HEADER_SIZE];

    (void)snprintf(header, sizeof header, "# %s\n%s", comment, table->header);
    FILE *file = lab_csv_open(lab, name, header);
    for (size_t row = 0; row < table->rows; row++) {
        if (isnan(table_at(table, row, 0))) {
            continue;
        }
        for (size_t column = 0; column < table->columns; column++) {
            (void)fprintf(file, "%s%.9g", column > 0 ? "," : "", table_at(table, row, column));
        }
        (void)fputc('\n', file);
    }
    lab_csv_close(lab, file, name);
}

void table_block(FILE *script, const struct table *table, const char *block)
{
    (void)fprintf(script, "$%s << END\n", block);
    for (size_t row = 0; row < table->rows; row++) {
        for (size_t column = 0; column < table->columns && !isnan(table_at(table, row, 0)); column++) {
            const double value = table_at(table, row, column);
            (void)fprintf(script, isnan(value) ? "NaN " : "%.7g ", value);
        }
        (void)fputc('\n', script);
    }
    (void)fputs("END\n", script);
}
