/* One case: from a plant to a row of results. */
#ifndef ORACLE_SOLVE_H
#define ORACLE_SOLVE_H

#include "classify.h"
#include "plant.h"

struct result {
#define INPUT(field, name)
#define OUTPUT(name) double name;
#include "columns.def"
#undef INPUT
#undef OUTPUT
    char name[CLASSIFY_NAME_SIZE];
};

/* Periods to wait for the attractor and to look at it. */
struct solve_span {
    double transient; /* not a number: chosen from the plant */
    double window;
};

/* Everything nan, the name "none". */
void result_clear(struct result *result);

/* Fills the result; columns later than `horizon` periods stay nan. Returns false when memory is short. */
bool solve_case(const struct plant *plant, struct solve_span span, long horizon, struct result *result);

#endif
