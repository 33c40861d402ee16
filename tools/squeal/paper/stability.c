/* Is it N |alpha| < c that keeps the brake quiet? A map of trials, and the border of permanent slip over beta +
 * gamma. */
#include "squeal/paper/lab_live.h"
#include "squeal/paper/lab_map.h"
#include "squeal/paper/lab_model.h"
#include "squeal/paper/table.h"

#include "analysis/floquet.h"
#include "sim/detector.h"
#include "squeal/plot/figure.h"

#include <math.h>

enum { LINE_POINTS = 100, TONGUE_POINTS = 41, TONGUE_POINTS_SMALL = 9, HALVINGS = 30, TEXT_SIZE = 256 };
enum { COLUMN_SUM, COLUMN_DEVICE, COLUMN_MONODROMY };

#define DAMPING 0.01 /* c of Table 1, N s/m */
#define FAST 100.0   /* m/s: a disc on which the pad slips for ever */
#define LIMIT_BORDER 3e-3
#define TONGUE 0.25
#define LOW_SLOPE 0.0005
#define HIGH_SLOPE 0.03

/* Borders of N |alpha|/c by the reference solver. */
static const double references[][2] = {{2.0, 1.0}, {TONGUE, 0.6670}};

/* --- The map ------------------------------------------------------------------------------------------------------ */

struct counts {
    unsigned below, below_loud, beyond, beyond_quiet, right;
};

static struct counts count(const struct device_point *points, size_t points_count)
{
    struct counts counts = {0};

    for (const struct device_point *point = points; point < points + points_count; point++) {
        const bool is_below = (double)point->at[0] * fabs((double)point->at[1]) < DAMPING;
        counts.below += is_below ? 1 : 0;
        counts.below_loud += is_below && point->is_loud ? 1 : 0;
        counts.beyond += is_below ? 0 : 1;
        counts.beyond_quiet += is_below || point->is_loud ? 0 : 1;
        counts.right +=
            point->predicted == PROPENSITY_WATCH || (point->predicted == PROPENSITY_SQUEAL) == point->is_loud ? 1 : 0;
    }
    return counts;
}

static struct counts map_make(struct lab *lab)
{
    const unsigned side = lab_options(lab)->is_small ? 10 : 40;
    double line[LINE_POINTS][2];
    size_t points_count;

    for (int i = 0; i < LINE_POINTS; i++) {
        const double slope = HIGH_SLOPE + (LOW_SLOPE - HIGH_SLOPE) * i / (LINE_POINTS - 1);
        line[i][0] = DAMPING / slope;
        line[i][1] = -slope;
    }
    const struct lab_map map = {
        .name = "stability-map",
        .title = "Where Table 1 squeals: brake force and slope of friction",
        .subtitle = "v0 = 1 m/s, beta + gamma = 2; black: N |" FIGURE_ALPHA "| = c",
        .caption = "Trials over the brake force and the slope of friction. Black: N |alpha| = c; blue: the border that "
                   "the closed "
                   "form predicts. Below N |alpha| = c the brake is loud where the forced motion alone reaches the "
                   "disc's speed.",
        .axes = {{"N0", "brake force N  [N]", 0.2, 20.0, side, true},
                 {"alpha", "slope of friction " FIGURE_ALPHA "  [s/m]", -HIGH_SLOPE, -LOW_SLOPE, side, false}},
        .transient = 360,
        .window = 40,
        .is_metric = true,
        .line = (const double(*)[2])line,
        .line_points = LINE_POINTS,
        .line_label = ""};
    lab_table1(lab, "N_max 80 v_max 60");
    const struct device_point *points = lab_map_make(lab, &map, &points_count);
    const struct counts counts = count(points, points_count);
    lab_number(lab, "all trials", "trials", (double)points_count, "1");
    lab_number(lab, "all trials", "as the closed form predicts", counts.right, "1");
    lab_number(lab, "N |α| < c", "trials", counts.below, "1");
    lab_number(lab, "N |α| < c", "loud", counts.below_loud, "1");
    lab_number(lab, "N |α| > c", "trials", counts.beyond, "1");
    lab_number(lab, "N |α| > c", "quiet", counts.beyond_quiet, "1");
    return counts;
}

/* --- Permanent slip ----------------------------------------------------------------------------------------------- */

/* The device's own search for the slope beyond which slip grows, as N |alpha|/c. */
static double border_measure(struct lab *lab, double sum)
{
    lab_table1(lab, "k 0 kt %.9g v0 %.9g v_max %.9g alpha -0.005", sum, FAST, FAST);
    return fabs((double)lab_border(lab, "alpha").below.border) / DAMPING;
}

/* The same by the map over one period. */
static double border_by_monodromy(const struct scale *scale, double sum)
{
    double low = 0.0, high = 2.0;

    for (int i = 0; i < HALVINGS; i++) {
        const double middle = 0.5 * (low + high);
        const struct floquet_problem problem = {scale->damping, -(float)middle * scale->damping, (float)sum, 1.0f};
        *(floquet_rate(&problem) > 0.0f ? &high : &low) = middle;
    }
    return 0.5 * (low + high);
}

static struct table borders(struct lab *lab)
{
    const int points = lab_options(lab)->is_small ? TONGUE_POINTS_SMALL : TONGUE_POINTS;
    struct table table = table_begin("sum,device,monodromy");
    struct params params;
    struct scale scale;

    lab_preset(lab, "table1");
    lab_model(lab, &params, &scale);
    for (int i = 0; i < points; i++) {
        const double sum = 0.21 + 0.08 * i / (points - 1);
        table_add(lab, &table, (const double[]){sum, border_measure(lab, sum), border_by_monodromy(&scale, sum)});
    }
    return table;
}

static const char commands[] =
    "set title 'Where permanent slip begins to grow' offset 0,1.3\nset xlabel '\316\262 + \316\263 = (kt + k)/ke'\n"
    "set ylabel 'N |" FIGURE_ALPHA "| / c at the border'\nset yrange [0.6:1.05]\nset xrange [0.21:0.29]\n"
    "set arrow from 0.21,1 to 0.29,1 nohead dt 2 lw 1.5 lc rgb '#b02020'\n"
    "set label \"the paper's border\" at 0.289,1.01 right tc rgb '#b02020'\n"
    "plot $border using 1:3 with lines lw 2 lc rgb '" FIGURE_COLOUR_DISC "' title 'map over one period', "
    "$border using 1:2 with points pt 7 ps 1.2 lc rgb '" FIGURE_COLOUR_MOTION "' title 'device'\n";

static void draw(struct lab *lab, const struct table *table)
{
    FILE *script = lab_figure_open(lab);

    table_block(script, table, "border");
    lab_figure_close(
        lab, script, "stability-tongue",
        "The slope of friction beyond which permanent slip grows, near beta + gamma = 1/4: there the normal "
        "oscillation feeds the pad at half its frequency, and two thirds of the paper's N |alpha| suffice.",
        commands);
    table_save(lab, table, "stability-tongue", "N |alpha|/c at which permanent slip begins to grow");
}

void experiment_stability(struct lab *lab)
{
    const struct counts counts = map_make(lab);
    const struct table table = borders(lab);
    double ratio[2];

    draw(lab, &table);
    for (int i = 0; i < 2; i++) {
        char subject[TEXT_SIZE];
        ratio[i] = border_measure(lab, references[i][0]);
        (void)snprintf(subject, sizeof subject, "permanent slip, β + γ = %g", references[i][0]);
        lab_compare(lab, subject, "N |α|/c where it begins to grow", ratio[i], "1", references[i][1], LIMIT_BORDER);
    }
    const bool is_border = fabs(ratio[0] - 1.0) < LIMIT_BORDER, is_all = fabs(ratio[1] - 1.0) < LIMIT_BORDER;
    lab_claim(
        lab, "stable-below-c",
        !is_border                         ? PAPER_REFUTED
        : is_all && counts.below_loud == 0 ? PAPER_HOLDS
                                           : PAPER_IN_PART,
        "stability-map",
        "permanent slip begins to grow at N |alpha| = %.4g c with beta + gamma = 2, but at %.4g c with 1/4; and of %u "
        "trials with N |alpha| < c %u are loud, since the forced motion reaches the disc's speed; of %u beyond it %u "
        "are quiet",
        ratio[0], ratio[1], counts.below, counts.below_loud, counts.beyond, counts.beyond_quiet);
}
