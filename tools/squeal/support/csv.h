/* Tables as comma-separated text with a header line. Nothing is quoted: the cells are numbers and plain names. Lines
 * that begin with # say something about the table and are skipped. */
#ifndef SQUEAL_CSV_H
#define SQUEAL_CSV_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

enum { CSV_PROBLEM_MAX = 256 };

struct csv {
    char *text;   /* the whole file, cut into 0-terminated cells */
    char **cells; /* the header's, then row after row */
    size_t columns;
    size_t rows;   /* without the header */
    size_t *lines; /* line number of each row in the file, for messages */
};

/* Reads the file; LF and CR LF both end a line, empty lines are skipped. On false problem says in one line what is
 * wrong, with the line number of a row that has too few or too many cells, and there is nothing to free. */
bool csv_read(struct csv *csv, const char *path, char problem[CSV_PROBLEM_MAX]);

void csv_free(struct csv *csv);

/* The place of the column of that name, or -1. */
int csv_column(const struct csv *csv, const char *name);

/* The cell's text; NULL where column is -1. */
const char *csv_cell(const struct csv *csv, size_t row, int column);

/* The cell as a number; NaN where column is -1 or the cell is no number. */
double csv_number(const struct csv *csv, size_t row, int column);

/* A whole file, 0-terminated; NULL with the problem. free() takes it back. */
char *csv_read_text(const char *path, char problem[CSV_PROBLEM_MAX]);

/* Opens a file for writing; on NULL problem says why. */
FILE *csv_create(const char *path, char problem[CSV_PROBLEM_MAX]);

/* Closes a written file. False, with the problem, if any write to it failed: a full disk shows itself here at the
 * latest. */
bool csv_close(FILE *file, const char *path, char problem[CSV_PROBLEM_MAX]);

#endif
