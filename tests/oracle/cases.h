/* Tables of cases: comma-separated values, a header line with column names, one case a line. */
#ifndef ORACLE_CASES_H
#define ORACLE_CASES_H

#include <stdio.h>

#include "solve.h"

enum { CASES_COLUMNS_MAX = 128, CASES_LINE_SIZE = 8192 };

struct cases_header {
    char text[CASES_LINE_SIZE];
    char *name[CASES_COLUMNS_MAX]; /* into text */
    int count;
};

struct cases_row {
    char text[CASES_LINE_SIZE];
    char *cell[CASES_COLUMNS_MAX];
    struct plant plant;
    struct solve_span span;
};

/* Each returns NULL, or what is wrong in words; cases_read_row says "" at the end of the file. */
const char *cases_read_header(FILE *file, struct cases_header *header);
const char *cases_read_row(FILE *file, const struct cases_header *header, struct cases_row *row);

void cases_write_header(FILE *file);

/* The parameters exactly as they were read, then the results. */
void cases_write_row(FILE *file, const struct cases_header *header, const struct cases_row *row,
                     const struct result *result);

#endif
