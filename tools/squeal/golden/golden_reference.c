/* What the table says of a case: its units, and whether it is loud, quiet, or on the threshold. */
#include "squeal/golden/golden.h"

#include <math.h>
#include <string.h>

#define SHARE_STILL 1e-6   /* a share of time below this, or as close to 1, counts as none or all */
#define RATE_MARGINAL 6e-4 /* growth or decay per normal period */

static double cell(const struct csv *cases, size_t row, const char *column)
{
    return csv_number(cases, row, csv_column(cases, column));
}

/* A missing cell of an optional column. */
static double or_0(double value) { return isnan(value) ? 0.0 : value; }

static double load_peak_n(const struct csv *cases, const struct golden_reference *reference)
{
    const double n0 = fabs(cell(cases, reference->row, "N0"));
    const double n1 = fabs(or_0(cell(cases, reference->row, "N1")));

    if (reference->profile == GOLDEN_LOAD_CONSTANT) {
        return n0;
    }
    return reference->profile == GOLDEN_LOAD_SINE ? n0 + n1 : fmax(n0, n1);
}

static bool is_partial(double share) { return share > SHARE_STILL && share < 1.0 - SHARE_STILL; }

static enum golden_kind kind_of(const struct csv *cases, const struct golden_reference *reference)
{
    const double rate = cell(cases, reference->row, "slip_floquet_rate");

    if (reference->class == NULL) {
        return GOLDEN_UNKNOWN;
    }
    if (reference->is_diverging) {
        return GOLDEN_LOUD;
    }
    if (strcmp(reference->class, "beating") == 0 || fabs(rate) * reference->period_s < RATE_MARGINAL) {
        return GOLDEN_MARGINAL;
    }
    if (strncmp(reference->class, "limitcycle", strlen("limitcycle")) == 0 ||
        is_partial(cell(cases, reference->row, "stick")) || is_partial(cell(cases, reference->row, "slipminus"))) {
        return GOLDEN_LOUD;
    }
    return GOLDEN_QUIET;
}

struct golden_reference golden_reference_of(const struct csv *cases, size_t row)
{
    struct golden_reference reference = {.row = row};
    const double m = cell(cases, row, "m");
    const double ke = cell(cases, row, "ke");

    reference.class = csv_cell(cases, row, csv_column(cases, "class"));
    reference.is_diverging = reference.class != NULL && strcmp(reference.class, "diverging") == 0;
    reference.profile = (enum golden_load)or_0(cell(cases, row, "ntype"));
    reference.period_s = 2.0 * acos(-1.0) * sqrt(m / ke);
    reference.length_m =
        fmax(fabs(cell(cases, row, "v0")), cell(cases, row, "mus") * load_peak_n(cases, &reference) / sqrt(m * ke)) /
        sqrt(ke / m);
    reference.t_v10_s = cell(cases, row, "t_v10");
    reference.kind = kind_of(cases, &reference);
    return reference;
}
