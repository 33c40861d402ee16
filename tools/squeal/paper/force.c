/* Between the panels of Fig. 5: the size of the motion over the brake force, and from which force on the pad sticks. */
#include "squeal/paper/lab_live.h"
#include "squeal/paper/table.h"

#include "squeal/plot/figure.h"

#include <math.h>

enum { SETTLE_PERIODS = 1200, WINDOW_PERIODS = 40, HALVINGS = 12, HALVINGS_WIDE = 16 };
enum { COLUMN_N, COLUMN_XPP, COLUMN_STICKS };

#define PAPER_STICK_N 5.0
#define NEAR 0.05 /* relative: near enough to be the paper's number */

/* By the reference solver, a point each. */
#define REFERENCE_STICK_N 1.8443
#define REFERENCE_TOUCH_N 1.1048
static const double reference_dip[2][2] = {{3.0, 2.10004}, {4.9, 2.07536}};
#define LIMIT 2e-3

static bool sticks_at_last(struct lab *lab, double force_n)
{
    lab_setf(lab, "N0 %.9g", force_n);
    const struct device_point point = lab_trial(lab, SETTLE_PERIODS, WINDOW_PERIODS);
    return lab_point_has_events(&point);
}

static bool ever_touches(struct lab *lab, double force_n)
{
    lab_setf(lab, "N0 %.9g", force_n);
    (void)lab_settle(lab, WINDOW_PERIODS);
    return lab_events(lab) > 0.0;
}

static void sweep(struct lab *lab, struct table *table)
{
    const struct device_span span = {SETTLE_PERIODS, WINDOW_PERIODS, true};
    size_t count;
    const struct device_point *points =
        lab_scan(lab, lab_options(lab)->is_small ? "N0 0.2 50 13 log" : "N0 0.2 50 97 log", &span, &count);

    for (size_t i = 0; i < count; i++) {
        table_add(lab, table,
                  (const double[]){(double)points[i].at[0], lab_point_xpp_m(&points[i]),
                                   lab_point_has_events(&points[i]) ? 1.0 : 0.0});
    }
}

static const char commands[] =
    "set title 'Size of the motion over the brake force, Table 1' offset 0,1.3\nset logscale xy\n"
    "set xlabel 'brake force N  [N]'\nset ylabel 'x, peak to peak  [m]'\nset xrange [0.2:50]\nset format '%g'\n"
    "set arrow from stick, graph 0 to stick, graph 1 nohead dt 2 lw 1.5 lc rgb '" FIGURE_COLOUR_DISC "'\n"
    "set arrow from paper, graph 0 to paper, graph 1 nohead dt 2 lw 1.5 lc rgb '#b02020'\n"
    "set label sprintf('sticks from %.3f N', stick) at stick, graph 0.06 right offset -0.6,0 tc rgb "
    "'" FIGURE_COLOUR_DISC "'\nset label \"the paper's 5 N\" at paper, graph 0.06 left offset 0.6,0 tc rgb '#b02020'\n"
    "plot $size using 1:2 with lines lw 1 lc rgb '#9fb3c8' notitle, "
    "$size using 1:($3 < 0.5 ? $2 : NaN) with points pt 6 ps 1.2 lc rgb '" FIGURE_COLOUR_MOTION "' title 'slips on', "
    "$size using 1:($3 > 0.5 ? $2 : NaN) with points pt 7 ps 1.2 lc rgb '" FIGURE_COLOUR_MOTION "' title 'sticks'\n";

static void draw(struct lab *lab, const struct table *table, double stick_n)
{
    FILE *script = lab_figure_open(lab);

    table_block(script, table, "size");
    (void)fprintf(script, "stick = %.9g\npaper = %.9g\n", stick_n, PAPER_STICK_N);
    lab_figure_close(
        lab, script, "force-size",
        "Range of x on the attractor over the brake force; filled where the pad sticks or overtakes the disc. At "
        "5 N, where the paper has its change, nothing happens.",
        commands);
    table_save(lab, table, "force-size",
               "range of x on the attractor from rest; sticks: 1 if the pad sticks or overtakes the disc");
}

/* The deepest fall of the size on the way up, of the size there. */
static double deepest_dip(const struct table *table, double *from_n)
{
    double highest = 0.0, highest_n = 0.0, deepest = 0.0;

    for (size_t row = 0; row < table->rows; row++) {
        const double xpp = table_at(table, row, COLUMN_XPP);
        if (xpp > highest) {
            highest = xpp;
            highest_n = table_at(table, row, COLUMN_N);
        } else if (1.0 - xpp / highest > deepest) {
            deepest = 1.0 - xpp / highest;
            *from_n = highest_n;
        }
    }
    return deepest;
}

void experiment_force(struct lab *lab)
{
    struct table table = table_begin("N0[N],xpp[m],sticks");
    double from_n = 0.0;

    lab_table1(lab, "N_max 400");
    sweep(lab, &table);
    /* From well below to well beyond the paper's number, so that it might be found. */
    const double stick_n = lab_bisect(lab, 0.5, 2.0 * PAPER_STICK_N, HALVINGS_WIDE, sticks_at_last);
    const double touch_n = lab_bisect(lab, 0.8, 1.5, HALVINGS, ever_touches);
    draw(lab, &table, stick_n);
    lab_compare(lab, "first touch of the disc's speed, in the transient", "N", touch_n, "N", REFERENCE_TOUCH_N,
                LIMIT * REFERENCE_TOUCH_N);
    lab_compare(lab, "first stick on the attractor", "N", stick_n, "N", REFERENCE_STICK_N, LIMIT * REFERENCE_STICK_N);
    for (size_t i = 0; i < 2; i++) {
        lab_setf(lab, "N0 %.9g", reference_dip[i][0]);
        lab_compare(lab, i == 0 ? "N = 3 N, before the dip" : "N = 4.9 N, in the dip", "x, peak to peak",
                    lab_xpp_m(lab, SETTLE_PERIODS), "m", reference_dip[i][1], LIMIT * reference_dip[i][1]);
    }
    lab_claim(lab, "stick-from-5n", fabs(stick_n / PAPER_STICK_N - 1.0) < NEAR ? PAPER_HOLDS : PAPER_REFUTED,
              "force-size",
              "the pad sticks from %.4g N on, where its forced motion reaches the disc's speed, and touches that speed "
              "in the "
              "transient from %.4g N on",
              stick_n, touch_n);
    const double dip = deepest_dip(&table, &from_n);
    const double growth = table_at(&table, table.rows - 1, COLUMN_XPP) / table_at(&table, 0, COLUMN_XPP);
    lab_claim(
        lab, "size-force",
        growth < 1.0  ? PAPER_REFUTED
        : dip > LIMIT ? PAPER_IN_PART
                      : PAPER_HOLDS,
        "force-size",
        "%.3g times from 0.2 N to 50 N, in proportion as long as the pad slips; then slower, with a dip of %.2g %% "
        "above %.2g N",
        growth, 100.0 * dip, from_n);
}
