/* Tables as comma-separated text. */
#include "squeal/support/csv.h"

#include "squeal/support/fields.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { READ_STEP = 65536 };

/* The whole file, 0-terminated; NULL with errno set on failure. */
static char *file_read(FILE *file)
{
    char *text = NULL;
    size_t length = 0;

    for (;;) {
        char *longer = realloc(text, length + READ_STEP + 1);
        if (longer == NULL) {
            free(text);
            return NULL;
        }
        text = longer;
        errno = 0;
        const size_t count = fread(text + length, 1, READ_STEP, file);
        length += count;
        if (count < READ_STEP) {
            break;
        }
    }
    if (ferror(file)) {
        free(text);
        return NULL;
    }
    text[length] = '\0';
    return text;
}

static size_t count_of(const char *text, char wanted)
{
    size_t count = 0;

    for (; *text != '\0'; text++) {
        count += *text == wanted ? 1U : 0U;
    }
    return count;
}

/* Cuts one line into cells at out. Returns how many there are. */
static size_t line_cut(char *line, char **out)
{
    size_t count = 0;

    for (;;) {
        char *comma = strchr(line, ',');
        out[count++] = line;
        if (comma == NULL) {
            return count;
        }
        *comma = '\0';
        line = comma + 1;
    }
}

static bool text_cut(struct csv *csv, const char *path, char problem[CSV_PROBLEM_MAX])
{
    size_t used = 0;
    size_t line_number = 0;
    char *line = csv->text;

    while (*line != '\0') {
        char *end = line + strcspn(line, "\n");
        char *next = *end == '\0' ? end : end + 1;
        line_number++;
        *end = '\0';
        if (end > line && end[-1] == '\r') {
            end[-1] = '\0';
        }
        if (*line != '\0' && *line != '#') {
            const size_t count = line_cut(line, csv->cells + used);
            if (csv->columns == 0) {
                csv->columns = count;
            } else if (count != csv->columns) {
                (void)snprintf(problem, CSV_PROBLEM_MAX, "%s:%zu: %zu cells where the header has %zu", path,
                               line_number, count, csv->columns);
                return false;
            } else {
                csv->lines[csv->rows++] = line_number;
            }
            used += count;
        }
        line = next;
    }
    if (csv->columns == 0) {
        (void)snprintf(problem, CSV_PROBLEM_MAX, "%s: empty, not even a header", path);
        return false;
    }
    return true;
}

char *csv_read_text(const char *path, char problem[CSV_PROBLEM_MAX])
{
    FILE *file = fopen(path, "r");
    char *text = file != NULL ? file_read(file) : NULL;

    if (text == NULL) {
        (void)snprintf(problem, CSV_PROBLEM_MAX, "%s: %s", path, strerror(errno));
    }
    if (file != NULL) {
        (void)fclose(file);
    }
    return text;
}

bool csv_read(struct csv *csv, const char *path, char problem[CSV_PROBLEM_MAX])
{
    memset(csv, 0, sizeof *csv);
    csv->text = csv_read_text(path, problem);
    if (csv->text == NULL) {
        return false;
    }
    const size_t lines = count_of(csv->text, '\n') + 1;
    csv->cells = calloc(lines + count_of(csv->text, ','), sizeof *csv->cells);
    csv->lines = calloc(lines, sizeof *csv->lines);
    bool is_good = csv->cells != NULL && csv->lines != NULL;
    if (!is_good) {
        (void)snprintf(problem, CSV_PROBLEM_MAX, "%s: out of memory", path);
    }
    is_good = is_good && text_cut(csv, path, problem);
    if (!is_good) {
        csv_free(csv);
    }
    return is_good;
}

void csv_free(struct csv *csv)
{
    free(csv->text);
    free(csv->cells);
    free(csv->lines);
    memset(csv, 0, sizeof *csv);
}

int csv_column(const struct csv *csv, const char *name)
{
    for (size_t i = 0; i < csv->columns; i++) {
        if (strcmp(csv->cells[i], name) == 0) {
            return (int)i;
        }
    }
    return -1;
}

const char *csv_cell(const struct csv *csv, size_t row, int column)
{
    return column < 0 ? NULL : csv->cells[(row + 1) * csv->columns + (size_t)column];
}

double csv_number(const struct csv *csv, size_t row, int column)
{
    double value = (double)NAN;
    const char *text = csv_cell(csv, row, column);

    return text != NULL && fields_parse(text, &value) ? value : (double)NAN;
}

FILE *csv_create(const char *path, char problem[CSV_PROBLEM_MAX])
{
    FILE *file = fopen(path, "w");

    if (file == NULL) {
        (void)snprintf(problem, CSV_PROBLEM_MAX, "%s: %s", path, strerror(errno));
    }
    return file;
}

bool csv_close(FILE *file, const char *path, char problem[CSV_PROBLEM_MAX])
{
    errno = 0;
    const bool was_good = fflush(file) == 0 && ferror(file) == 0;
    const int reason = errno;
    const bool is_closed = fclose(file) == 0;

    if (!was_good || !is_closed) {
        (void)snprintf(problem, CSV_PROBLEM_MAX, "%s: %s", path,
                       strerror(reason != 0 ? reason : (errno != 0 ? errno : EIO)));
        return false;
    }
    return true;
}
