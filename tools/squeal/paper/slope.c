/* Between the panels of Fig. 6: the size of the motion over the slope of friction, where it loses its period, and
 * whether what comes then is chaos. */
#include "squeal/paper/orbit.h"
#include "squeal/paper/table.h"

#include "sim/detector.h"
#include "squeal/plot/figure.h"

#include <math.h>

enum {
    SETTLE_PERIODS = 4000,
    EARLY_PERIODS = 40,
    WINDOW_PERIODS = 400,
    PART_PERIODS = 2400,
    PART_FROM = 400,
    PARTS = 3
};
enum { COLUMN_SLOPE, COLUMN_XPP, COLUMN_EARLY, COLUMN_APERIODIC };

#define CHANGE 0.01         /* s/m: the paper's change */
#define LIMIT_CHANGE 1e-3   /* relative: the device's own bracket */
#define LIMIT_EXPONENT 1e-3 /* a period: less is no chaos */
#define OFFSET_M 1e-3
#define NEAR 0.05 /* relative: near enough to be the paper's number */

static void sweep(struct lab *lab, struct table *table, const char *axis)
{
    const struct device_span span = {SETTLE_PERIODS, WINDOW_PERIODS, true}, early = {0, EARLY_PERIODS, true};
    size_t count;
    const struct device_point *late = lab_scan(lab, axis, &span, &count), *soon = lab_scan(lab, axis, &early, NULL);

    for (size_t i = 0; i < count; i++) {
        table_add(lab, table,
                  (const double[]){-(double)late[i].at[0], lab_point_xpp_m(&late[i]), lab_point_xpp_m(&soon[i]),
                                   late[i].motion == CLASS_APERIODIC ? 1.0 : 0.0});
    }
}

static const char commands[] =
    "set title 'Size of the motion over the slope of friction, N = 1 N' offset 0,1.3\nset logscale x\n"
    "set xlabel '|" FIGURE_ALPHA
    "|  [s/m]'\nset ylabel 'x, peak to peak  [m]'\nset format '%g'\nset xrange [4e-4:0.12]\nset yrange [0:*]\n"
    "set arrow from change, graph 0 to change, graph 1 nohead dt 2 lw 1.5 lc rgb '" FIGURE_COLOUR_DISC "'\n"
    "set label sprintf('N |" FIGURE_ALPHA
    "| = c at %.5f s/m', change) at change, graph 0.06 right offset -0.6,0 tc rgb '" FIGURE_COLOUR_DISC "'\n"
    "plot $size using 1:3 with linespoints pt 6 ps 0.8 lc rgb '#9fb3c8' title 'first 40 periods', "
    "$size using 1:($4 < 0.5 ? $2 : NaN) with points pt 7 ps 1.2 lc rgb '" FIGURE_COLOUR_MOTION
    "' title 'at last, a period', "
    "$size using 1:($4 > 0.5 ? $2 : NaN) with points pt 5 ps 1.2 lc rgb '#b02020' title 'at last, none'\n";

static double change_find(struct lab *lab)
{
    lab_preset(lab, "table1");
    const double change = -(double)lab_border(lab, "alpha").below.border;
    lab_compare(lab, "where the motion loses its period", "|α|", change, "s/m", CHANGE, LIMIT_CHANGE * CHANGE);
    return change;
}

static void judge_size(struct lab *lab, const struct table *table, size_t below)
{
    const double late = table_at(table, below - 1, COLUMN_XPP) / table_at(table, 0, COLUMN_XPP);
    const double early = table_at(table, below - 1, COLUMN_EARLY) / table_at(table, 0, COLUMN_EARLY);

    lab_claim(lab, "size-slope",
              late > 1.0    ? PAPER_HOLDS
              : early > 1.0 ? PAPER_IN_PART
                            : PAPER_REFUTED,
              "slope-size",
              "from %.4g s/m to %.4g s/m the size on the attractor becomes %.4g of itself; a picture of the first %d "
              "periods, in which the transient still lasts, is %.3g times as large",
              table_at(table, 0, COLUMN_SLOPE), table_at(table, below - 1, COLUMN_SLOPE), late, EARLY_PERIODS, early);
}

/* --- Chaos? ------------------------------------------------------------------------------------------------------- */

/* Returns the growth of their distance in e-folds a period. */
static double part(struct lab *lab, double slope, struct table *table)
{
    double *distance_m = lab_memory(lab, PART_PERIODS, sizeof *distance_m);

    lab_setf(lab, "alpha %.9g", -slope);
    const double exponent = orbit_parting(lab, OFFSET_M, PART_FROM, PART_PERIODS, distance_m);
    for (int i = 0; i < PART_PERIODS; i++) {
        table_add(lab, table, (const double[]){(double)i, slope, distance_m[i]});
    }
    table_add(lab, table, (const double[]){(double)NAN, slope, (double)NAN});
    return exponent;
}

static const char part_commands[] =
    "set title 'Two plants that start 1 mm apart, N = 1 N' offset 0,1.3\nset logscale y\nset format y '10^{%L}'\n"
    "set xlabel 'time  [normal periods Tn]'\nset ylabel 'distance at whole periods  [m]'\nset yrange [1e-7:10]\n"
    "set key at graph 0.98,0.98 right top Left reverse vertical maxrows 4\n"
    "colours = '" FIGURE_COLOUR_MOTION " " FIGURE_COLOUR_DISC " #2e7d32'\n"
    "plot for [i=1:words(slopes)] $parting using 1:3 every :::(i-1)::(i-1) with lines lw 1.2 lc rgb word(colours, i) "
    "title sprintf('" FIGURE_ALPHA " = -%s s/m', word(slopes, i))\n";

static void draw_parting(struct lab *lab, const struct table *table, const double slopes[PARTS])
{
    FILE *script = lab_figure_open(lab);

    table_block(script, table, "parting");
    (void)fprintf(script, "slopes = '%g %g %g'\n", slopes[0], slopes[1], slopes[2]);
    lab_figure_close(
        lab, script, "parting",
        "Distance at whole normal periods of two plants that start 1 mm apart. In chaos it would grow on a straight "
        "line here, until it is as large as the motion.",
        part_commands);
    table_save(lab, table, "parting",
               "distance in the phase plane of two plants that start 1 mm apart, at whole periods");
}

static void judge_beyond(struct lab *lab, const struct table *table, size_t below, double change)
{
    bool has_begun;
    static const double slopes[PARTS] = {0.02, 0.04, 0.1};
    struct table parting = table_begin("period,slope[s/m],distance[m]");
    double fastest = -(double)INFINITY;
    size_t aperiodic = 0;

    lab_preset(lab, "table1");
    for (int i = 0; i < PARTS; i++) {
        char subject[64];
        const double exponent = part(lab, slopes[i], &parting);
        (void)snprintf(subject, sizeof subject, "two plants, α = -%g s/m", slopes[i]);
        lab_number(lab, subject, "growth of their distance", exponent, "1 a period");
        fastest = fmax(fastest, exponent);
    }
    draw_parting(lab, &parting, slopes);
    for (size_t row = below; row < table->rows; row++) {
        aperiodic += table_at(table, row, COLUMN_APERIODIC) > 0.0 ? 1 : 0;
    }
    has_begun = 2 * aperiodic > table->rows - below && fabs(change / CHANGE - 1.0) < NEAR;
    lab_claim(
        lab, "beyond-slope",
        !has_begun                 ? PAPER_REFUTED
        : fastest > LIMIT_EXPONENT ? PAPER_HOLDS
                                   : PAPER_IN_PART,
        "parting",
        "from %.5g s/m on, where N |alpha| = c, %zu of %zu motions have no period; two plants that start 1 mm apart "
        "part by no more than %.1g of their distance a period: %s",
        change, aperiodic, table->rows - below, fastest,
        fastest > LIMIT_EXPONENT ? "chaotic" : "quasi-periodic, not chaotic");
}

void experiment_slope(struct lab *lab)
{
    const bool is_small = lab_options(lab)->is_small;
    struct table table = table_begin("slope[s/m],xpp[m],early_xpp[m],aperiodic");

    const double change = change_find(lab);
    lab_preset(lab, "table1");
    sweep(lab, &table, is_small ? "alpha -0.001 -0.009 4 log" : "alpha -0.0005 -0.009 25 log");
    const size_t below = table.rows;
    sweep(lab, &table, is_small ? "alpha -0.012 -0.1 5 log" : "alpha -0.0115 -0.1 31 log");
    FILE *script = lab_figure_open(lab);
    table_block(script, &table, "size");
    (void)fprintf(script, "change = %.9g\n", change);
    lab_figure_close(
        lab, script, "slope-size",
        "Range of x over the slope of friction: at last, and over the first 40 periods from rest, which is what a "
        "short run shows.",
        commands);
    table_save(lab, &table, "slope-size",
               "range of x at last and over the first 40 periods; aperiodic: 1 if it has no period");
    judge_size(lab, &table, below);
    judge_beyond(lab, &table, below, change);
}
