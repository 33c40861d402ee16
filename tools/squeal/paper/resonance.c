/* Figs. 8 and 9 in between: the size of the motion over beta + gamma, at several speeds of the disc; where the pad
 * sticks; and whether the harmonics of the normal oscillation show. */
#include "squeal/paper/lab_live.h"
#include "squeal/paper/lab_map.h"
#include "squeal/paper/table.h"

#include "sim/detector.h"
#include "squeal/plot/figure.h"

#include <math.h>

enum { SETTLE_PERIODS = 600, WINDOW_PERIODS = 40, HALVINGS = 11, SPEEDS = 4, HARMONICS = 2 };
enum { COLUMN_SUM, COLUMN_SPEED, COLUMN_XPP };

/* By the reference solver: largest range of x and where, its place to the width of a hundredth. */
static const struct {
    double speed, place, xpp_m;
} peaks[SPEEDS] = {{1.0, 1.33, 1.61676}, {2.0, 1.13, 2.81939}, {5.0, 1.03, 6.15106}, {60.0, 1.00, 24.6476}};

/* Likewise, the ranges about the harmonics. */
static const struct {
    double sum[3], xpp_m[3];
} harmonics[HARMONICS] = {{{3.8, 4.0, 4.2}, {0.212889, 0.198665, 0.186277}},
                          {{8.6, 9.0, 9.4}, {0.0784212, 0.0744999, 0.0709521}}};
static const double sticks_between[2] = {0.455, 1.54};

#define BETA_GAMMA "\316\262 + \316\263"
#define LIMIT_PLACE 0.015
#define LIMIT 2e-3
#define NEAR 0.05
#define NEARBY 0.15 /* a place of the coarsest sweep */

/* The sweep of one speed. Returns where it is largest. */
static double sweep(struct lab *lab, int which, struct table *table)
{
    const struct device_span span = {SETTLE_PERIODS, WINDOW_PERIODS, true};
    const bool is_small = lab_options(lab)->is_small;
    size_t count, peak = 0;

    lab_table1(lab, "k 0 v0 %.9g", peaks[which].speed);
    const struct device_point *points = lab_scan(lab, is_small ? "kt 0.05 4.4 30" : "kt 0.05 4.4 175", &span, &count);
    for (size_t i = 0; i < count; i++) {
        table_add(lab, table,
                  (const double[]){(double)points[i].at[0], peaks[which].speed, lab_point_xpp_m(&points[i])});
        peak = lab_point_xpp_m(&points[i]) > lab_point_xpp_m(&points[peak]) ? i : peak;
    }
    table_add(lab, table, (const double[]){(double)NAN, peaks[which].speed, (double)NAN});
    return (double)points[peak].at[0];
}

/* The top of the curve, by a finer scan about where the sweep has it, and the size there. */
static double peak_find(struct lab *lab, int which, double about)
{
    const struct device_span span = {SETTLE_PERIODS, WINDOW_PERIODS, true};
    struct table table = table_begin("kt[N/m],xpp[m]");
    char axis[64], subject[64];
    size_t count;

    lab_table1(lab, "k 0 v0 %.9g", peaks[which].speed);
    (void)snprintf(axis, sizeof axis, "kt %.9g %.9g %d", about - NEARBY, about + NEARBY,
                   lab_options(lab)->is_small ? 31 : 61);
    const struct device_point *points = lab_scan(lab, axis, &span, &count);
    for (size_t i = 0; i < count; i++) {
        table_add(lab, &table, (const double[]){(double)points[i].at[0], lab_point_xpp_m(&points[i])});
    }
    const size_t peak = table_peak(&table, 1);
    (void)snprintf(subject, sizeof subject, "v0 = %g m/s", peaks[which].speed);
    lab_compare(lab, subject, "largest at β + γ", table_at(&table, peak, 0), "1", peaks[which].place, LIMIT_PLACE);
    lab_setf(lab, "kt %.9g", peaks[which].place);
    const double xpp_m = lab_xpp_m(lab, SETTLE_PERIODS);
    lab_compare(lab, subject, "x, peak to peak there", xpp_m, "m", peaks[which].xpp_m, LIMIT * peaks[which].xpp_m);
    return table_at(&table, peak, 0);
}

static bool sticks_at(struct lab *lab, double sum)
{
    lab_setf(lab, "kt %.9g", sum);
    const struct device_point point = lab_trial(lab, SETTLE_PERIODS, WINDOW_PERIODS);
    return lab_point_has_events(&point);
}

/* Is the motion larger at n^2 than on both sides of it? */
static bool harmonic_shows(struct lab *lab, int which)
{
    double xpp_m[3];

    lab_table1(lab, "k 0");
    for (int i = 0; i < 3; i++) {
        char subject[64];
        lab_setf(lab, "kt %.9g", harmonics[which].sum[i]);
        xpp_m[i] = lab_xpp_m(lab, SETTLE_PERIODS);
        (void)snprintf(subject, sizeof subject, "β + γ = %.3g", harmonics[which].sum[i]);
        lab_compare(lab, subject, "x, peak to peak", xpp_m[i], "m", harmonics[which].xpp_m[i],
                    LIMIT * harmonics[which].xpp_m[i]);
    }
    return xpp_m[1] > xpp_m[0] && xpp_m[1] > xpp_m[2];
}

static const char commands[] =
    "set title 'Size of the motion over " BETA_GAMMA ", N = 1 N' offset 0,1.3\nset logscale y\n"
    "set xlabel '" BETA_GAMMA
    " = (kt + k)/ke'\nset ylabel 'x, peak to peak, over v0/wn'\nset xrange [0:4.4]\nset format y '%g'\n"
    "set arrow from sticks0, graph 0 to sticks0, graph 1 nohead dt 2 lw 1.5 lc rgb '#7a7a7a'\n"
    "set arrow from sticks1, graph 0 to sticks1, graph 1 nohead dt 2 lw 1.5 lc rgb '#7a7a7a'\n"
    "set label 'sticks between' at sticks1, graph 0.05 left offset 0.6,0 tc rgb '#606060'\n"
    "colours = '" FIGURE_COLOUR_MOTION " " FIGURE_COLOUR_DISC " #2e7d32 #b02020'\nspeeds = '1 2 5 60'\n"
    "plot for [i=1:4] $size using 1:($3/$2*wn) every :::(i-1)::(i-1) with lines lw 2 lc rgb word(colours, i) "
    "title sprintf('v0 = %s m/s', word(speeds, i))\n";

static void draw(struct lab *lab, const struct table *table, const double sticks[2])
{
    FILE *script = lab_figure_open(lab);

    table_block(script, table, "size");
    (void)fprintf(script, "sticks0 = %.9g\nsticks1 = %.9g\nwn = %.9g\n", sticks[0], sticks[1],
                  2.0 * acos(-1.0) / lab_period_s(lab));
    lab_figure_close(
        lab, script, "resonance-size",
        "Range of x over beta + gamma, in units of v0/wn. The slow disc holds the pad: its largest motion is flat and "
        "lies above 1; the faster it turns, the nearer comes resonance to 1. Dashed: where the pad sticks at 1 m/s. "
        "Nothing shows at 4.",
        commands);
    table_save(lab, table, "resonance-size", "range of x over beta + gamma (kt, k = 0, ke = 1), by the disc's speed");
}

static void judge(struct lab *lab, const double sticks[2], const double places[SPEEDS])
{
    const bool is_at_one = fabs(places[0] - 1.0) < NEAR, comes_to_one = fabs(places[SPEEDS - 1] - 1.0) < NEAR;
    const bool shows_4 = harmonic_shows(lab, 0), shows_9 = harmonic_shows(lab, 1);

    lab_claim(lab, "resonance",
              is_at_one      ? PAPER_HOLDS
              : comes_to_one ? PAPER_IN_PART
                             : PAPER_REFUTED,
              "resonance-size",
              "at the paper's 1 m/s the motion is largest at %.3g, and the pad sticks from %.3g to %.3g; at 2, 5 and "
              "60 m/s, where "
              "the disc holds the pad less and less, it is largest at %.3g, %.3g and %.3g",
              places[0], sticks[0], sticks[1], places[1], places[2], places[3]);
    lab_claim(lab, "resonance-squares", shows_4 || shows_9 ? PAPER_IN_PART : PAPER_REFUTED, "resonance-size",
              "the motion is %s at 4 and %s at 9 than on both sides, within 5 %%", shows_4 ? "larger" : "not larger",
              shows_9 ? "larger" : "not larger");
}

void experiment_resonance(struct lab *lab)
{
    struct table table = table_begin("sum,v0[m/s],xpp[m]");
    double places[SPEEDS], sticks[2];

    for (int i = 0; i < SPEEDS; i++) {
        const double about = sweep(lab, i, &table);
        places[i] = peak_find(lab, i, about);
    }
    lab_table1(lab, "k 0");
    sticks[0] = lab_bisect(lab, 0.4, 0.6, HALVINGS, sticks_at);
    sticks[1] = lab_bisect(lab, 1.7, 1.4, HALVINGS, sticks_at);
    draw(lab, &table, sticks);
    for (int i = 0; i < 2; i++) {
        lab_compare(lab, "v0 = 1 m/s, sticks", i == 0 ? "from β + γ" : "up to β + γ", sticks[i], "1", sticks_between[i],
                    0.01 * sticks_between[i]);
    }
    judge(lab, sticks, places);
}

void experiment_resonance_map(struct lab *lab)
{
    const unsigned points = lab_options(lab)->is_small ? 8 : 40;
    const struct lab_map map = {
        .name = "resonance-force",
        .title = "Where Table 1 squeals: " BETA_GAMMA " and the brake force",
        .subtitle = "v0 = 1 m/s, alpha = -0.002 s/m, c = 0.01 N s/m",
        .caption = "Trials over beta + gamma and the brake force, with the border that the closed form "
                   "predicts: above it the forced motion alone reaches the disc's speed.",
        .axes = {{"kt", BETA_GAMMA, 0.1, 4.0, points, false}, {"N0", "brake force N  [N]", 0.2, 10.0, points, true}},
        .transient = 360,
        .window = 40,
        .is_metric = true};
    size_t count, right = 0;

    lab_table1(lab, "k 0 N_max 40");
    const struct device_point *at = lab_map_make(lab, &map, &count);
    for (size_t i = 0; i < count; i++) {
        right += (at[i].predicted == PROPENSITY_SQUEAL) == at[i].is_loud || at[i].predicted == PROPENSITY_WATCH ? 1 : 0;
    }
    lab_number(lab, map.name, "trials", (double)count, "1");
    lab_number(lab, map.name, "predicted right", (double)right, "1");
}
