/* A brake force that fluctuates: N (1 + depth sin), from the quiet Table 1, over the frequency. */
#include "squeal/paper/lab_live.h"
#include "squeal/paper/table.h"

#include "squeal/plot/figure.h"

#include <math.h>

enum { SETTLE_PERIODS = 600, WINDOW_PERIODS = 120, DEPTHS = 4, POINTS = 99, POINTS_SMALL = 15, TEXT_SIZE = 64 };
enum { COLUMN_RATIO, COLUMN_DEPTH, COLUMN_XPP, COLUMN_LOUD };

#define NORMAL_DAMPING 0.0219 /* N s/m: 2 % as in the realistic brake, or a force at fn would swing without bound */

static const double depths[DEPTHS] = {0.05, 0.1, 0.2, 0.5};

static void sweep(struct lab *lab, double depth, struct table *table)
{
    const int points = lab_options(lab)->is_small ? POINTS_SMALL : POINTS;
    const struct device_span span = {SETTLE_PERIODS, WINDOW_PERIODS, true};
    char axis[TEXT_SIZE];
    size_t count;

    lab_table1(lab, "load sine N0 1 N1 %.9g y0 1 fN 0.1 cn %.9g contact no_pull", depth, NORMAL_DAMPING);
    const double fn_hz = 1.0 / lab_period_s(lab);
    (void)snprintf(axis, sizeof axis, "fN %.9g %.9g %d", 0.05 * fn_hz, 2.5 * fn_hz, points);
    const struct device_point *at = lab_scan(lab, axis, &span, &count);
    for (size_t i = 0; i < count; i++) {
        table_add(
            lab, table,
            (const double[]){(double)at[i].at[0] / fn_hz, depth, lab_point_xpp_m(&at[i]), at[i].is_loud ? 1.0 : 0.0});
    }
    table_add(lab, table, (const double[]){(double)NAN, depth, (double)NAN, (double)NAN});
}

static const char commands[] =
    "set title 'A force that fluctuates: N (1 + depth sin 2\317\200 f t), Table 1, normal damping 2 %' offset 0,1.3\n"
    "set logscale y\nset format y '10^{%L}'\nset xlabel 'frequency of the force, over fn'\nset ylabel 'x, peak to peak "
    " [m]'\n"
    "set xrange [0:2.5]\ncolours = '#7a7a7a #2e7d32 " FIGURE_COLOUR_DISC " " FIGURE_COLOUR_MOTION "'\n"
    "set arrow from pad, graph 0 to pad, graph 1 nohead dt 3 lw 1.5 lc rgb '#606060'\n"
    "set label 'pad' at pad, graph 0.04 left offset 0.5,0 tc rgb '#606060'\n"
    "set arrow from 1, graph 0 to 1, graph 1 nohead dt 3 lw 1.5 lc rgb '#606060'\n"
    "set label 'fn' at 1, graph 0.04 left offset 0.5,0 tc rgb '#606060'\n"
    "plot for [i=1:words(depths)] $size using 1:3 every :::(i-1)::(i-1) with lines lw 2 lc rgb word(colours, i) "
    "title word(depths, i).' %', "
    "$size using 1:($4 > 0.5 ? $3 : NaN) with points pt 7 ps 1 lc rgb '#b02020' title 'squeals'\n";

static void draw(struct lab *lab, const struct table *table)
{
    FILE *script = lab_figure_open(lab);

    table_block(script, table, "size");
    (void)fputs("depths = '", script);
    for (int i = 0; i < DEPTHS; i++) {
        (void)fprintf(script, "%g ", 100.0 * depths[i]);
    }
    (void)fprintf(script, "'\npad = %.9g\n", sqrt((lab_get(lab, "kt") + lab_get(lab, "k")) / lab_get(lab, "ke")));
    lab_figure_close(
        lab, script, "fluctuation-size",
        "Range of x over the frequency of the force's fluctuation, by its depth. It answers where the force meets the "
        "normal direction's frequency or the pad's; red: the device calls it squeal.",
        commands);
    table_save(lab, table, "fluctuation-size", "range of x over the frequency of the force, over fn, and its depth");
}

/* Of one depth: where it squeals, and how much larger than at the lowest frequency the motion gets. */
static void tell(struct lab *lab, const struct table *table, double depth, unsigned *loud, unsigned *count)
{
    double first = (double)NAN, largest = 0.0;
    char subject[TEXT_SIZE];

    *loud = *count = 0;
    for (size_t row = 0; row < table->rows; row++) {
        if (table_at(table, row, COLUMN_DEPTH) != depth || isnan(table_at(table, row, COLUMN_RATIO))) {
            continue;
        }
        first = *count == 0 ? table_at(table, row, COLUMN_XPP) : first;
        largest = fmax(largest, table_at(table, row, COLUMN_XPP));
        *loud += table_at(table, row, COLUMN_LOUD) > 0.0 ? 1 : 0;
        (*count)++;
    }
    (void)snprintf(subject, sizeof subject, "depth %g %%", 100.0 * depth);
    lab_number(lab, subject, "largest over slowest", largest / first, "1");
    lab_number(lab, subject, "share of frequencies that squeal", (double)*loud / *count, "1");
}

void experiment_fluctuation(struct lab *lab)
{
    struct table table = table_begin("f/fn,depth,xpp[m],loud");
    unsigned loud[DEPTHS], count;

    for (int i = 0; i < DEPTHS; i++) {
        sweep(lab, depths[i], &table);
        tell(lab, &table, depths[i], &loud[i], &count);
    }
    draw(lab, &table);
    lab_claim(
        lab, "fluctuation",
        loud[DEPTHS - 1] == count ? PAPER_HOLDS
        : loud[DEPTHS - 1] > 0    ? PAPER_IN_PART
                                  : PAPER_REFUTED,
        "fluctuation-size",
        "a fluctuation of %g %% makes it squeal at %u of %u frequencies from 0.05 fn to 2.5 fn, one of %g %% at %u",
        100.0 * depths[0], loud[0], count, 100.0 * depths[DEPTHS - 1], loud[DEPTHS - 1]);
}
