/* What the reference solver says of a row, sorted by what a detector can be asked. */
#ifndef MERIT_TRUTH_H
#define MERIT_TRUTH_H

#include "draw.h"

/* Does the brake squeal? On a threshold both answers are right; unsettled, the truth itself is still under way. */
enum truth_kind { TRUTH_QUIET, TRUTH_LOUD, TRUTH_MARGINAL, TRUTH_UNSETTLED, TRUTH_KINDS };

enum truth_family {
    TRUTH_REST,
    TRUTH_FORCED,
    TRUTH_STICKSLIP_1,
    TRUTH_STICKSLIP_2,
    TRUTH_STICKSLIP_3,
    TRUTH_STICKSLIP_N, /* four and more */
    TRUTH_CROSS,
    TRUTH_LIMITCYCLE_SLIP,
    TRUTH_LIMITCYCLE_STICKSLIP,
    TRUTH_APERIODIC, /* quasi-periodic, long period, chaotic, locked to something else */
    TRUTH_DIVERGING,
    TRUTH_SETTLING, /* slips on and repeats in nothing: beats, or has not settled yet */
    TRUTH_FAMILIES
};

extern const char *const truth_family_names[TRUTH_FAMILIES];

struct truth {
    size_t row;
    enum draw_kind drawn;
    enum truth_kind kind;
    enum truth_family family;
    int multiplicity;    /* of classes that have one, else 0 */
    bool is_settled;     /* the class is that of the attractor, not of what is left of the transient */
    bool has_events;     /* sticks or overtakes the disc for part of the time */
    double folds;        /* growth of permanent slip before the window, in e-folds; negative: decay */
    double motion_ratio; /* half the range of the speed over the disc's speed; NaN if it diverged */
};

/* Reads a row. On false problem says in one line why it cannot be used. */
bool truth_of_row(const struct csv *table, size_t row, struct truth *truth, char problem[CSV_PROBLEM_MAX]);

#endif
