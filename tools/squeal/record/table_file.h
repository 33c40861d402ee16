/* A table of breakpoints as CSV: a column t[s], and N[N] of the brake force or v0[m/s] of the disc's speed. */
#ifndef SQUEAL_TABLE_FILE_H
#define SQUEAL_TABLE_FILE_H

#include <stdio.h>

#include "model/params.h"
#include "squeal/support/csv.h"

/* "load" or "speed" to its table; false for any other name. */
bool table_file_find(const char *name, enum params_table_index *index);

/* Reads a file. On false problem says what is wrong, with the line. */
bool table_file_read(const char *path, enum params_table_index index, struct params_points *table,
                     char problem[CSV_PROBLEM_MAX]);

/* Writes one that reads back as the same bits. */
void table_file_write(FILE *file, enum params_table_index index, const struct params_points *table);

#endif
