/* Compares what the firmware measured with the reference columns of the table, where the table has them. The tolerances
 * belong to 64 steps a period in single precision; PHYSICS, golden data, and MODEL.md give their reasons. */
#include "squeal/golden/golden.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define LIMIT_X 1e-3             /* of the larger extreme over the first 20 periods */
#define LIMIT_X_FLOOR 3e-3       /* the same with a friction floor, whose kink is not located */
#define LIMIT_ABSOLUTE 1e-6      /* length units, where the reference does not move */
#define LIMIT_STICK 5e-3         /* share of the time */
#define LIMIT_XPP 2e-3           /* relative */
#define LIMIT_XPP_APERIODIC 2e-2 /* relative; the window decides which part of a torus is seen */
#define LIMIT_RUSTLE 4e-5        /* of the larger extreme: single precision rustles at 1e-5 of a static deflection */
#define LIMIT_F_UP 1e-4          /* relative */
#define LIMIT_T_V10 1e-2         /* relative */
#define STILL 1e-12              /* length units */
#define WATCH_SHARE 0.10         /* of the quiet rows */
#define NO_FLOOR (-1e29)

enum { FLOOR_SPP = 128 };

struct worst {
    double share; /* error in units of its tolerance */
    double error, limit;
    size_t row;
    bool is_known;
};

struct check {
    const struct golden_plan *plan;
    const struct golden_result *results;
    struct worst worst[GOLDEN_COLUMNS];
    struct golden_score score;
    size_t quiet;
    bool has_row_failed;
};

static double cell(const struct check *check, size_t row, const char *column)
{
    return csv_number(&check->plan->cases, row, csv_column(&check->plan->cases, column));
}

static bool starts_with(const char *text, const char *start) { return strncmp(text, start, strlen(start)) == 0; }

static const char *case_name(const struct check *check, size_t row)
{
    return csv_cell(&check->plan->cases, row, csv_column(&check->plan->cases, "case"));
}

static void row_report(struct check *check, size_t row, enum golden_column column, const char *expected)
{
    printf("%s: %s is %s, expected %s\n", case_name(check, row), golden_names[column],
           check->results[row].cells[column], expected);
    check->has_row_failed = true;
}

/* Compares one number. scale turns the difference into the tolerance's unit. A reference of nan asks for nothing. */
static void compare(struct check *check, size_t row, enum golden_column column, double scale, double limit)
{
    const double expected = cell(check, row, golden_names[column]);
    const double got = strtod(check->results[row].cells[column], NULL);
    const double error = fabs(got - expected) / scale;
    struct worst *worst = &check->worst[column];
    char text[96];

    if (isnan(expected)) {
        return;
    }
    if (!worst->is_known || !(error / limit <= worst->share)) {
        *worst = (struct worst){.share = error / limit, .error = error, .limit = limit, .row = row, .is_known = true};
    }
    if (!(error <= limit)) {
        (void)snprintf(text, sizeof text, "%.9g (error %.2e, limit %.0e)", expected, error, limit);
        row_report(check, row, column, text);
    }
}

static void must_be_nan(struct check *check, size_t row, int first, int last)
{
    for (int column = first; column <= last; column++) {
        if (strcmp(check->results[row].cells[column], "nan") != 0) {
            row_report(check, row, (enum golden_column)column, "nan, since the case has diverged by then");
        }
    }
}

static void check_start(struct check *check, const struct golden_reference *reference)
{
    static const enum golden_column displacements[] = {GOLDEN_X_20, GOLDEN_XMAX_20, GOLDEN_XMIN_20};
    const size_t row = reference->row;
    const bool has_floor = cell(check, row, "mumin") > NO_FLOOR && check->plan->steps_per_period < FLOOR_SPP;
    const double extreme = fmax(fabs(cell(check, row, "xmax_20")), fabs(cell(check, row, "xmin_20")));
    const bool is_still = extreme <= STILL * reference->length_m;

    for (size_t i = 0; i < sizeof displacements / sizeof displacements[0]; i++) {
        compare(check, row, displacements[i], is_still ? reference->length_m : extreme,
                is_still ? LIMIT_ABSOLUTE : (has_floor ? LIMIT_X_FLOOR : LIMIT_X));
    }
    compare(check, row, GOLDEN_STICK_20, 1.0, LIMIT_STICK);
}

static void check_attractor(struct check *check, const struct golden_reference *reference)
{
    static const char *const aperiodic[] = {"quasiperiodic", "longperiod", "locked-other", "chaotic"};
    const size_t row = reference->row;
    const double xpp = cell(check, row, "xpp");
    const double extreme = fmax(fabs(cell(check, row, "xmax")), fabs(cell(check, row, "xmin")));
    const double rustle_m = fmax(LIMIT_RUSTLE * extreme, LIMIT_ABSOLUTE * reference->length_m);
    const char *tail = reference->class == NULL ? NULL : strrchr(reference->class, '-');
    double limit = LIMIT_XPP;

    for (size_t i = 0; i < sizeof aperiodic / sizeof aperiodic[0] && reference->class != NULL; i++) {
        if (starts_with(reference->class, aperiodic[i])) {
            limit = LIMIT_XPP_APERIODIC;
        }
    }
    if (limit * xpp < rustle_m) {
        compare(check, row, GOLDEN_XPP, reference->length_m, rustle_m / reference->length_m);
    } else if (reference->kind != GOLDEN_MARGINAL) {
        compare(check, row, GOLDEN_XPP, xpp, limit);
    }
    if (tail != NULL && strcmp(tail, "-p1") == 0 && limit * xpp >= rustle_m) {
        compare(check, row, GOLDEN_F_UP, fabs(cell(check, row, "f_up")), LIMIT_F_UP);
    }
}

static void check_diverging(struct check *check, const struct golden_reference *reference)
{
    const size_t row = reference->row;
    const struct golden_result *result = &check->results[row];
    const double periods = check->plan->is_asymptotic ? cell(check, row, "ntrans") + cell(check, row, "nwin") : 100.0;

    if (reference->t_v10_s <= 20.0 * reference->period_s) {
        must_be_nan(check, row, GOLDEN_X_20, GOLDEN_STICK_20);
    } else {
        check_start(check, reference);
    }
    if (reference->t_v10_s <= 100.0 * reference->period_s) {
        must_be_nan(check, row, GOLDEN_X_100, GOLDEN_V_100);
    }
    if (reference->t_v10_s * (1.0 + LIMIT_T_V10) < periods * reference->period_s) {
        must_be_nan(check, row, GOLDEN_XPP, GOLDEN_F_UP);
        compare(check, row, GOLDEN_T_V10, fabs(reference->t_v10_s), LIMIT_T_V10);
        if (strcmp(result->cells[GOLDEN_VERDICT], "squeal") != 0) {
            row_report(check, row, GOLDEN_VERDICT, "squeal, since the case diverges");
        }
        if (strcmp(result->cells[GOLDEN_CLASS], "diverging") != 0) {
            row_report(check, row, GOLDEN_CLASS, "diverging");
        }
    }
}

/* A quiet row may be called watch now and then; how often is judged at the end. */
static void check_verdict(struct check *check, const struct golden_reference *reference)
{
    const char *verdict = check->results[reference->row].cells[GOLDEN_VERDICT];

    if (reference->kind == GOLDEN_LOUD && strcmp(verdict, "squeal") != 0) {
        row_report(check, reference->row, GOLDEN_VERDICT, "squeal");
    }
    if (reference->kind == GOLDEN_QUIET && strcmp(verdict, "quiet") != 0 && strcmp(verdict, "watch") != 0) {
        row_report(check, reference->row, GOLDEN_VERDICT, "quiet or watch");
    }
}

static void check_predicted(struct check *check, const struct golden_reference *reference)
{
    const char *predicted = check->results[reference->row].cells[GOLDEN_PREDICTED];
    const bool is_settled_load = reference->profile == GOLDEN_LOAD_CONSTANT || reference->profile == GOLDEN_LOAD_RAMP;

    if (!is_settled_load || !(cell(check, reference->row, "v0") > 0.0)) {
        return;
    }
    if ((reference->kind == GOLDEN_LOUD && strcmp(predicted, "quiet") == 0) ||
        (reference->kind == GOLDEN_QUIET && strcmp(predicted, "squeal") == 0)) {
        row_report(check, reference->row, GOLDEN_PREDICTED,
                   reference->kind == GOLDEN_LOUD ? "not quiet" : "not squeal");
    }
}

static void check_counters(struct check *check, const struct golden_reference *reference)
{
    const struct golden_result *result = &check->results[reference->row];

    check->score.caps += strtod(result->cells[GOLDEN_CAPS], NULL);
    check->score.overruns += strtod(result->cells[GOLDEN_OVERRUNS], NULL);
    if (!reference->is_diverging && strtod(result->cells[GOLDEN_SATURATIONS], NULL) > 0.0) {
        row_report(check, reference->row, GOLDEN_SATURATIONS, "0, since the case is bounded");
    }
}

static bool row_passes(struct check *check, size_t row)
{
    const struct golden_reference reference = golden_reference_of(&check->plan->cases, row);

    check->has_row_failed = false;
    if (check->results[row].reason[0] != '\0') {
        (void)fflush(stdout);
        fprintf(stderr, "%s: %s\n", case_name(check, row), check->results[row].reason);
        return false;
    }
    if (reference.is_diverging) {
        check_diverging(check, &reference);
    } else {
        check_start(check, &reference);
        if (check->plan->is_asymptotic) {
            check_attractor(check, &reference);
            check_verdict(check, &reference);
        }
    }
    check_predicted(check, &reference);
    check_counters(check, &reference);
    check->quiet += reference.kind == GOLDEN_QUIET ? 1U : 0U;
    return !check->has_row_failed;
}

/* Is it a quiet case, otherwise passed, that the firmware calls watch? */
static bool is_watched(const struct check *check, size_t row)
{
    return check->plan->is_asymptotic && check->results[row].reason[0] == '\0' &&
           golden_reference_of(&check->plan->cases, row).kind == GOLDEN_QUIET &&
           strcmp(check->results[row].cells[GOLDEN_VERDICT], "watch") == 0;
}

static bool has_reference(const struct check *check)
{
    for (int column = 0; column < GOLDEN_COLUMNS; column++) {
        if (csv_column(&check->plan->cases, golden_names[column]) >= 0) {
            return true;
        }
    }
    return false;
}

static void worst_print(const struct check *check)
{
    bool has_any = false;

    for (int column = 0; column < GOLDEN_COLUMNS; column++) {
        const struct worst *worst = &check->worst[column];
        if (worst->is_known) {
            printf("%s%-10s %9.2e  %6.0e  %s\n", has_any ? "" : "column         worst   limit  case\n",
                   golden_names[column], worst->error, worst->limit, case_name(check, worst->row));
            has_any = true;
        }
    }
    if (!has_reference(check)) {
        printf("the table has no reference columns: its rows only ran, nothing was compared\n");
    } else if (!has_any) {
        printf("no number of any row could be compared\n");
    }
}

struct golden_score golden_check(const struct golden_plan *plan, const struct golden_result *results)
{
    struct check check = {.plan = plan, .results = results};
    size_t watched = 0;

    for (size_t row = 0; row < plan->cases.rows; row++) {
        if (row_passes(&check, row)) {
            check.score.passed++;
            watched += is_watched(&check, row) ? 1U : 0U;
        } else {
            check.score.failed++;
        }
    }
    if ((double)watched > WATCH_SHARE * (double)check.quiet) {
        for (size_t row = 0; row < plan->cases.rows; row++) {
            if (is_watched(&check, row)) {
                row_report(&check, row, GOLDEN_VERDICT, "quiet, since more than a tenth of the quiet cases are watch");
            }
        }
        check.score.passed -= watched;
        check.score.failed += watched;
    }
    worst_print(&check);
    printf("caps %.0f, overruns %.0f, quiet cases called watch %zu of %zu\n", check.score.caps, check.score.overruns,
           watched, check.quiet);
    return check.score;
}
