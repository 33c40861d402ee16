/* A table of numbers, of which both a CSV file and a picture are made. */
#ifndef SQUEAL_TABLE_H
#define SQUEAL_TABLE_H

#include "squeal/paper/lab.h"

struct table {
    const char *header; /* "N[N],xpp[m]": a column for each name */
    size_t columns, rows, capacity;
    double *cells;
};

struct table table_begin(const char *header);

/* Adds a row: as many values as there are columns. */
void table_add(struct lab *lab, struct table *table, const double *row);

double table_at(const struct table *table, size_t row, size_t column);

/* The row with the largest value in a column; NaN is never the largest. */
size_t table_peak(const struct table *table, size_t column);

/* NAME.csv. comment: what it holds. */
void table_save(struct lab *lab, const struct table *table, const char *name, const char *comment);

/* The same for gnuplot, $block; a row that begins with NaN parts it into two. */
void table_block(FILE *script, const struct table *table, const char *block);

#endif
