/* A case: the columns of the plant as the oracle names them, in SI units, and how long to look. */
#ifndef MERIT_SET_H
#define MERIT_SET_H

#include "model/params.h"
#include "squeal/support/csv.h"

struct set {
#define INPUT(field, name) double name;
#define OUTPUT(name)
#include "tests/oracle/columns.def"
#undef INPUT
#undef OUTPUT
    double ntrans, nwin; /* periods before the attractor, and of it */
};

/* The case of a row; an absent or unreadable cell is NaN. */
struct set set_of_row(const struct csv *table, size_t row);

/* The same for the firmware: normal direction exact, 64 steps a period. arith is ARITH_F32 or ARITH_Q27. */
struct params set_params(const struct set *set, int arith);

#endif
