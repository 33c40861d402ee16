/* Counting and printing. */
#include "table.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#define ALARMS_MOST 0.005  /* of the quiet rows */
#define CLASS_LEAST 0.95   /* of the rows of a family that must be named */
#define LATENCY_MOST 40.0f /* periods, median */

enum { MOTIONS = CLASS_DIVERGING + 1 };

struct interval {
    double low, high;
};

/* Where the true share lies with 95 % certainty, after Wilson. */
static struct interval interval_of(size_t count, size_t all)
{
    const double z = 1.959964;
    const double n = (double)all;
    const double share = (double)count / n;
    const double middle = share + z * z / (2.0 * n);
    const double half = z * sqrt(share * (1.0 - share) / n + z * z / (4.0 * n * n));
    const double whole = 1.0 + z * z / n;

    return all > 0 ? (struct interval){fmax(0.0, middle - half) / whole, fmin(1.0, (middle + half) / whole)}
                   : (struct interval){0.0, 1.0};
}

static double share_of(size_t count, size_t all) { return all > 0 ? (double)count / (double)all : 0.0; }

/* "   3 of  4321   0.07 (0.02..0.20)" */
static void print_share(size_t count, size_t all)
{
    const struct interval interval = interval_of(count, all);

    printf("%5zu of %5zu %6.2f (%.2f..%.2f)", count, all, 100.0 * share_of(count, all), 100.0 * interval.low,
           100.0 * interval.high);
}

/* Is this row of this kind, or is any kind meant? */
static bool is_drawn(const struct truth *truth, int drawn) { return drawn == DRAW_KINDS || (int)truth->drawn == drawn; }

static const char *drawn_name(int drawn) { return drawn == DRAW_KINDS ? "all" : draw_kind_names[drawn]; }

static const char *case_name(const struct table *table, size_t row)
{
    return csv_cell(table->cases, row, csv_column(table->cases, "case"));
}

static size_t count_kind(const struct truth *truth, size_t rows, int drawn, enum truth_kind kind)
{
    size_t count = 0;

    for (size_t row = 0; row < rows; row++) {
        count += is_drawn(&truth[row], drawn) && truth[row].kind == kind;
    }
    return count;
}

static size_t count_fault(const struct table *table, int drawn, enum judge_fault fault)
{
    size_t count = 0;

    for (size_t row = 0; row < table->cases->rows; row++) {
        count += is_drawn(&table->truth[row], drawn) && table->judgement[row].has[fault];
    }
    return count;
}

void table_print_truth(const struct truth *truth, size_t rows)
{
    printf("%-10s %8s %8s %8s %10s\n", "truth", "loud", "quiet", "marginal", "unsettled");
    for (int drawn = 0; drawn <= DRAW_KINDS; drawn++) {
        printf("%-10s %8zu %8zu %8zu %10zu\n", drawn_name(drawn), count_kind(truth, rows, drawn, TRUTH_LOUD),
               count_kind(truth, rows, drawn, TRUTH_QUIET), count_kind(truth, rows, drawn, TRUTH_MARGINAL),
               count_kind(truth, rows, drawn, TRUTH_UNSETTLED));
    }
}

static void print_verdicts(const struct table *table)
{
    const size_t rows = table->cases->rows;

    printf("\n%-10s %-34s %-34s %s\n", table->arith, "missed, % (95 % interval)", "false alarms, % (95 % interval)",
           "quiet called watch");
    for (int drawn = 0; drawn <= DRAW_KINDS; drawn++) {
        const size_t quiet = count_kind(table->truth, rows, drawn, TRUTH_QUIET);

        printf("%-10s ", drawn_name(drawn));
        print_share(count_fault(table, drawn, JUDGE_MISS), count_kind(table->truth, rows, drawn, TRUTH_LOUD));
        printf("   ");
        print_share(count_fault(table, drawn, JUDGE_ALARM), quiet);
        printf("   ");
        print_share(count_fault(table, drawn, JUDGE_WATCH), quiet);
        printf("\n");
    }
}

/* Rows of a family that must be named, and how many of them were. */
static void count_named(const struct table *table, int family, size_t *asked, size_t *right)
{
    for (size_t row = 0; row < table->cases->rows; row++) {
        if ((int)table->truth[row].family == family && table->judgement[row].is_class_asked) {
            *asked += 1u;
            *right += !table->judgement[row].has[JUDGE_CLASS];
        }
    }
}

static void print_confusion_row(const struct table *table, int family)
{
    size_t called[MOTIONS] = {0};
    size_t asked = 0;
    size_t right = 0;

    for (size_t row = 0; row < table->cases->rows; row++) {
        const struct truth *truth = &table->truth[row];

        called[table->run[row].motion] +=
            (int)truth->family == family && (truth->kind == TRUTH_LOUD || truth->kind == TRUTH_QUIET);
    }
    printf("%-21s", truth_family_names[family]);
    for (int motion = 0; motion < MOTIONS; motion++) {
        printf(" %6zu", called[motion]);
    }
    count_named(table, family, &asked, &right);
    if (asked > 0) {
        printf("  %.1f %% right", 100.0 * share_of(right, asked));
    }
    printf("\n");
}

/* Rows that would have to be named, had the oracle seen them settle. */
static size_t count_unsettled(const struct table *table)
{
    size_t count = 0;

    for (size_t row = 0; row < table->cases->rows; row++) {
        const struct truth *truth = &table->truth[row];

        count += (truth->kind == TRUTH_LOUD || truth->kind == TRUTH_QUIET) && judge_asks_class(truth->family) &&
                 !truth->is_settled;
    }
    return count;
}

/* A family fails when its share is too low by more than its number of rows explains; all together must reach it. */
static bool print_confusion(const struct table *table)
{
    size_t asked = 0;
    size_t right = 0;
    bool is_good = true;

    printf("\ntruth, called:        unsett   rest  decay   grow forced   s-sl  cross  lc-sl  lc-ss  aper. diverg\n");
    for (int family = 0; family < TRUTH_FAMILIES; family++) {
        size_t asked_here = 0;
        size_t right_here = 0;

        print_confusion_row(table, family);
        count_named(table, family, &asked_here, &right_here);
        is_good = is_good && interval_of(right_here, asked_here).high >= CLASS_LEAST;
        asked += asked_here;
        right += right_here;
    }
    printf("named: %zu of %zu, %.2f %%; of %zu rows more the truth had not settled\n", right, asked,
           100.0 * share_of(right, asked), count_unsettled(table));
    return is_good && share_of(right, asked) >= CLASS_LEAST;
}

static int compare_floats(const void *a, const void *b)
{
    const float x = *(const float *)a;
    const float y = *(const float *)b;

    return (x > y) - (x < y);
}

/* Value below which so many of a hundred lie; sorts the values. */
static float percentile(float *values, size_t count, size_t percent)
{
    qsort(values, count, sizeof *values, compare_floats);
    return count > 0 ? values[(count - 1) * percent / 100] : NAN;
}

static bool has_latency(const struct table *table, size_t row)
{
    const struct truth *truth = &table->truth[row];

    return truth->kind == TRUTH_LOUD && truth->has_events && table->run[row].has_onset;
}

/* Returns the median in periods. */
static float print_latency_of(const struct table *table, int drawn, float *periods, float *ms)
{
    size_t count = 0;
    float median;

    for (size_t row = 0; row < table->cases->rows; row++) {
        if (is_drawn(&table->truth[row], drawn) && has_latency(table, row)) {
            periods[count] = table->run[row].latency_periods;
            ms[count] = table->run[row].latency_ms;
            count++;
        }
    }
    median = percentile(periods, count, 50);
    printf("%-10s %6zu rows %8.1f %8.1f periods %10.4g %10.4g ms\n", drawn_name(drawn), count, (double)median,
           (double)percentile(periods, count, 99), (double)percentile(ms, count, 50),
           (double)percentile(ms, count, 99));
    return median;
}

static bool print_latency(const struct table *table)
{
    float *periods = calloc(table->cases->rows, sizeof *periods);
    float *ms = calloc(table->cases->rows, sizeof *ms);
    float median = NAN;

    if (periods != NULL && ms != NULL) {
        printf("\nfrom first touch to flag: rows, median and 99th percentile\n");
        for (int drawn = 0; drawn <= DRAW_KINDS; drawn++) {
            median = print_latency_of(table, drawn, periods, ms);
        }
    }
    free(periods);
    free(ms);
    return median <= LATENCY_MOST;
}

static void print_extremes(const struct table *table)
{
    size_t loudest = 0;
    size_t softest = 0;
    double most = -1.0;
    double least = (double)INFINITY;

    for (size_t row = 0; row < table->cases->rows; row++) {
        const struct truth *truth = &table->truth[row];
        const struct run *run = &table->run[row];

        if (truth->kind == TRUTH_QUIET && truth->family == TRUTH_REST && (double)run->speed_ratio > most) {
            most = (double)run->speed_ratio;
            loudest = row;
        }
        if (truth->kind == TRUTH_LOUD && run->propensity == PROPENSITY_SQUEAL && truth->motion_ratio < least) {
            least = truth->motion_ratio;
            softest = row;
        }
    }
    if (most >= 0.0) {
        printf("\nlargest speed reported of a pad at rest: %.2e of v0, %.2e Vref (%s)\n", most,
               (double)table->run[loudest].speed_vref, case_name(table, loudest));
    }
    if (isfinite(least)) {
        printf("smallest squeal that was called so: speed %.3g of v0 (%s)\n", least, case_name(table, softest));
    }
}

static void print_counters(const struct table *table)
{
    const size_t rows = table->cases->rows;
    size_t asked = 0;
    double caps = 0.0;
    double periods = 0.0;
    double cut_periods = 0.0;

    for (size_t row = 0; row < rows; row++) {
        const struct run *run = &table->run[row];
        const bool is_called = run->predicted == PREDICTION_QUIET || run->predicted == PREDICTION_SQUEAL;

        asked += (table->truth[row].kind == TRUTH_LOUD || table->truth[row].kind == TRUTH_QUIET) && is_called;
        caps += (double)run->caps;
        periods += (double)run->periods;
        cut_periods += (double)run->cut_periods;
    }
    printf("loud, but the firmware's plant had not begun to move: %zu\n", count_fault(table, DRAW_KINDS, JUDGE_ASLEEP));
    printf("loud, but slower than v0/32, which is not called squeal: %zu\n",
           count_fault(table, DRAW_KINDS, JUDGE_SMALL));
    printf("quiet, called squeal on the way without a touch: %zu\n", count_fault(table, DRAW_KINDS, JUDGE_FLASH));
    printf("cut short: %zu verdicts of %zu differ, %.1f %% of the periods saved\n",
           count_fault(table, DRAW_KINDS, JUDGE_CUT),
           count_kind(table->truth, rows, DRAW_KINDS, TRUTH_LOUD) +
               count_kind(table->truth, rows, DRAW_KINDS, TRUTH_QUIET),
           100.0 * (1.0 - cut_periods / periods));
    printf("predictor: ");
    print_share(count_fault(table, DRAW_KINDS, JUDGE_PREDICTION), asked);
    printf(" wrong outside its margin\n");
    printf("bounded rows with saturations: %zu; steps at the cap of switches, all rows: %.0f of %.0f periods\n",
           count_fault(table, DRAW_KINDS, JUDGE_SATURATED), caps, periods);
}

static bool must(bool is_good, const char *what)
{
    if (!is_good) {
        printf("FAILED: %s\n", what);
    }
    return is_good;
}

bool table_print(const struct table *table)
{
    const size_t quiet = count_kind(table->truth, table->cases->rows, DRAW_KINDS, TRUTH_QUIET);
    const double alarms = share_of(count_fault(table, DRAW_KINDS, JUDGE_ALARM), quiet);
    bool is_named;
    bool is_prompt;
    bool is_good;

    print_verdicts(table);
    is_named = print_confusion(table);
    is_prompt = print_latency(table);
    print_extremes(table);
    print_counters(table);
    is_good = must(count_fault(table, DRAW_KINDS, JUDGE_REFUSED) == 0, "a set was refused");
    is_good = must(count_fault(table, DRAW_KINDS, JUDGE_MISS) == 0, "squeal was missed") && is_good;
    is_good = must(alarms <= ALARMS_MOST, "more than 0.5 % false alarms") && is_good;
    is_good = must(is_named, "fewer than 95 % of the motions named as they are") && is_good;
    is_good = must(is_prompt, "the flag comes more than 40 periods after the first touch") && is_good;
    return must(count_fault(table, DRAW_KINDS, JUDGE_SATURATED) == 0, "numbers overflowed in a bounded motion") &&
           is_good;
}
