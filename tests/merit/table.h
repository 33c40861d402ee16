/* All rows of one arithmetic together: the printed table. */
#ifndef MERIT_TABLE_H
#define MERIT_TABLE_H

#include "judge.h"

struct table {
    const char *arith;
    const struct csv *cases;
    const struct truth *truth; /* one for each row, as the next two */
    const struct run *run;
    const struct judgement *judgement;
};

/* What the rows are, before anything is run on them. */
void table_print_truth(const struct truth *truth, size_t rows);

/* Prints the figures of merit. Returns whether all of them are what they must be, and says which are not. */
bool table_print(const struct table *table);

#endif
