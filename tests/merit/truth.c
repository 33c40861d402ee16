/* From the columns of a golden table to a family. */
#include "truth.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define RATE_MARGINAL 6e-4 /* growth or decay a period: too slow to call, tests/golden/README.md */
#define SHARE_NONE 1e-6
#define FOLDS_SETTLED (-13.8) /* of a disturbance before the window: 1e-6, the tolerance of the oracle's classes */

const char *const truth_family_names[TRUTH_FAMILIES] = {
    "rest",  "forced",          "stickslip-p1",         "stickslip-p2", "stickslip-p3", "stickslip-p4..",
    "cross", "limitcycle-slip", "limitcycle-stickslip", "aperiodic",    "diverging",    "settling"};

/* A class by the start of its name. */
static const struct {
    const char *start;
    enum truth_family family;
} families[] = {
    {"rest", TRUTH_REST},
    {"forced-", TRUTH_FORCED},
    {"stickslip-", TRUTH_STICKSLIP_N},
    {"cross-", TRUTH_CROSS},
    {"limitcycle-slip", TRUTH_LIMITCYCLE_SLIP},
    {"limitcycle-stickslip", TRUTH_LIMITCYCLE_STICKSLIP},
    {"quasiperiodic", TRUTH_APERIODIC},
    {"longperiod", TRUTH_APERIODIC},
    {"chaotic", TRUTH_APERIODIC},
    {"locked-other", TRUTH_APERIODIC},
    {"diverging", TRUTH_DIVERGING},
    {"beating", TRUTH_SETTLING},
};

static double cell(const struct csv *table, size_t row, const char *name)
{
    return csv_number(table, row, csv_column(table, name));
}

static bool starts_with(const char *text, const char *start) { return strncmp(text, start, strlen(start)) == 0; }

static bool find_family(const char *class, struct truth *truth)
{
    const char *tail = strstr(class, "-p");

    truth->multiplicity = tail != NULL ? (int)strtol(tail + 2, NULL, 10) : 0;
    for (size_t i = 0; i < sizeof families / sizeof families[0]; i++) {
        if (starts_with(class, families[i].start)) {
            truth->family = families[i].family;
            if (truth->family == TRUTH_STICKSLIP_N && truth->multiplicity <= 3) {
                truth->family = (enum truth_family)(TRUTH_STICKSLIP_1 + truth->multiplicity - 1);
            }
            return true;
        }
    }
    return false;
}

static bool find_drawn(const char *name, struct truth *truth)
{
    for (int kind = 0; kind < DRAW_KINDS; kind++) {
        const size_t length = strlen(draw_kind_names[kind]);

        if (strncmp(name, draw_kind_names[kind], length) == 0 && name[length] == '-') {
            truth->drawn = (enum draw_kind)kind;
            return true;
        }
    }
    return false;
}

static bool is_partial(double share) { return share > SHARE_NONE && share < 1.0 - SHARE_NONE; }

/* Loud by the class alone. What slips on and still settles is quiet if permanent slip is stable: it only decays. */
static enum truth_kind kind_of(const struct truth *truth, double rate)
{
    if (truth->family == TRUTH_DIVERGING) {
        return TRUTH_LOUD;
    }
    if (!(fabs(rate) >= RATE_MARGINAL)) {
        return TRUTH_MARGINAL;
    }
    switch (truth->family) {
    case TRUTH_REST:
    case TRUTH_FORCED:
        return TRUTH_QUIET;
    case TRUTH_SETTLING:
        return rate < 0.0 ? TRUTH_QUIET : TRUTH_UNSETTLED;
    case TRUTH_APERIODIC:
        return truth->has_events ? TRUTH_LOUD : TRUTH_QUIET;
    case TRUTH_STICKSLIP_1:
    case TRUTH_STICKSLIP_2:
    case TRUTH_STICKSLIP_3:
    case TRUTH_STICKSLIP_N:
    case TRUTH_CROSS:
    case TRUTH_LIMITCYCLE_SLIP:
    case TRUTH_LIMITCYCLE_STICKSLIP:
    case TRUTH_DIVERGING:
    case TRUTH_FAMILIES:
    default:
        return TRUTH_LOUD;
    }
}

bool truth_of_row(const struct csv *table, size_t row, struct truth *truth, char problem[CSV_PROBLEM_MAX])
{
    const char *name = csv_cell(table, row, csv_column(table, "case"));
    const char *class = csv_cell(table, row, csv_column(table, "class"));
    const double rate = cell(table, row, "slip_floquet_rate") * cell(table, row, "T_n");
    const double range = cell(table, row, "vmax") - cell(table, row, "vmin");

    *truth = (struct truth){.row = row};
    if (name == NULL || class == NULL || !find_drawn(name, truth)) {
        (void)snprintf(problem, CSV_PROBLEM_MAX, "row %zu: no class, or a case of no kind that is drawn", row + 1);
        return false;
    }
    if (!find_family(class, truth) || isnan(rate) || isnan(cell(table, row, "ntrans"))) {
        (void)snprintf(problem, CSV_PROBLEM_MAX, "case %.60s: class %.60s, or no rate or span", name, class);
        return false;
    }
    truth->has_events = is_partial(cell(table, row, "stick")) || is_partial(cell(table, row, "slipminus"));
    truth->folds = rate * cell(table, row, "ntrans");
    truth->motion_ratio = 0.5 * range / fabs(cell(table, row, "v0"));
    truth->kind = kind_of(truth, rate);
    truth->is_settled =
        truth->family == TRUTH_REST ||
        !(cell(table, row, "lle") * cell(table, row, "T_n") * cell(table, row, "ntrans") > FOLDS_SETTLED);
    return true;
}
