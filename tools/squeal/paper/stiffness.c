/* Between the panels of Fig. 7: the size of the motion over the stiffness ke = kt = k, and below which one it runs
 * away. */
#include "squeal/paper/lab_live.h"
#include "squeal/paper/table.h"

#include "sim/detector.h"
#include "squeal/plot/figure.h"

#include <math.h>

enum { SETTLE_PERIODS = 1600, WINDOW_PERIODS = 200, HALVINGS = 10, POINTS = 31, POINTS_SMALL = 6 };
enum { COLUMN_KE, COLUMN_PRINTED, COLUMN_FLOOR };

#define REFERENCE_RUNAWAY 7434.5 /* N/m, by the reference solver */
#define LIMIT_RUNAWAY 0.01       /* relative: the pad passes the border after hundreds of periods */

static struct device_point trial(struct lab *lab, double ke, bool has_floor)
{
    lab_preset(lab, "fig7-ke10000");
    lab_setf(lab, "ke %.9g kt %.9g k %.9g mu_floor %s", ke, ke, ke, has_floor ? "0" : "-1e30");
    return lab_trial(lab, SETTLE_PERIODS, WINDOW_PERIODS);
}

static bool stays(struct lab *lab, double ke)
{
    const struct device_point point = trial(lab, ke, false);
    return point.motion != CLASS_DIVERGING;
}

static struct table sweep(struct lab *lab)
{
    const int count = lab_options(lab)->is_small ? POINTS_SMALL : POINTS;
    struct table table = table_begin("ke[N/m],xpp[m],xpp_floor[m]");

    for (int i = 0; i < count; i++) {
        const double ke = 2500.0 * pow(400.0, (double)i / (count - 1));
        const struct device_point printed = trial(lab, ke, false), floor = trial(lab, ke, true);
        table_add(lab, &table, (const double[]){ke, lab_point_xpp_m(&printed), lab_point_xpp_m(&floor)});
    }
    return table;
}

static const char commands[] =
    "set title 'Size of the motion over the stiffness, N = 100 N, " FIGURE_ALPHA
    " = -0.15 s/m' offset 0,1.3\nset logscale xy\n"
    "set xlabel 'stiffness ke = kt = k  [N/m]'\nset ylabel 'x, peak to peak  [m]'\nset format '10^{%L}'\n"
    "set xrange [2500:1e6]\n"
    "set arrow from runaway, graph 0 to runaway, graph 1 nohead dt 2 lw 1.5 lc rgb '#b02020'\n"
    "set label sprintf('runs away below %.0f N/m', runaway) at runaway, graph 0.06 left offset 0.6,0 tc rgb '#b02020'\n"
    "plot $size using 1:3 with linespoints pt 6 ps 1.1 lw 1 lc rgb '" FIGURE_COLOUR_DISC "' title 'µ kept from 0 on', "
    "$size using 1:2 with linespoints pt 7 ps 0.9 lw 1 lc rgb '" FIGURE_COLOUR_MOTION "' title 'as printed'\n";

/* Places at which the motion of a column does not get smaller. */
static size_t rises(const struct table *table, size_t column)
{
    size_t count = 0;

    for (size_t row = 1; row < table->rows; row++) {
        count += table_at(table, row, column) >= table_at(table, row - 1, column) ? 1 : 0;
    }
    return count;
}

void experiment_stiffness(struct lab *lab)
{
    const struct table table = sweep(lab);
    const double runaway = lab_bisect(lab, 6500.0, 8500.0, HALVINGS, stays);
    const size_t printed = rises(&table, COLUMN_PRINTED), floor = rises(&table, COLUMN_FLOOR), last = table.rows - 1;
    FILE *script = lab_figure_open(lab);

    table_block(script, &table, "size");
    (void)fprintf(script, "runaway = %.9g\n", runaway);
    lab_figure_close(
        lab, script, "stiffness-size",
        "Range of x over the stiffness: as printed, and with friction kept from turning round. At the paper's 5000 "
        "N/m the printed law runs away.",
        commands);
    table_save(lab, &table, "stiffness-size",
               "range of x over ke = kt = k, as printed (nan: runs away) and with mu_floor 0");
    lab_compare(lab, "the printed law runs away", "below ke", runaway, "N/m", REFERENCE_RUNAWAY,
                LIMIT_RUNAWAY * REFERENCE_RUNAWAY);
    lab_claim(lab, "stiffer-smaller",
              table_at(&table, last, COLUMN_FLOOR) > table_at(&table, 0, COLUMN_FLOOR) ? PAPER_REFUTED
              : printed + floor > 0                                                    ? PAPER_IN_PART
                                                                                       : PAPER_HOLDS,
              "stiffness-size",
              "with friction kept positive from %.3g m at %.4g N/m to %.3g m at %.2g N/m, growing at %zu of %zu places "
              "between "
              "(as printed %zu); as printed the pad runs away below %.4g N/m, so also at the paper's 5000 N/m",
              table_at(&table, 0, COLUMN_FLOOR), table_at(&table, 0, COLUMN_KE), table_at(&table, last, COLUMN_FLOOR),
              table_at(&table, last, COLUMN_KE), floor, last, printed, runaway);
}
