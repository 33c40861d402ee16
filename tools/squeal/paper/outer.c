/* Where slip grows, sticking holds the pad back, but only below a speed: an unstable cycle parts bounded motion from
 * running away. */
#include "squeal/paper/lab_live.h"
#include "squeal/paper/table.h"

#include "analysis/eigen.h"
#include "sim/detector.h"
#include "squeal/plot/figure.h"

#include <math.h>

enum { CASES = 3, LIFE_PERIODS = 3000, HALVINGS = 22, SEEN_FROM = 4, SEEN_PERIODS = 32, TEXT_SIZE = 64 };

#define FORCE_N 1.0
#define LIMIT 3e-3 /* relative */

/* Start against the disc's sense from which on the pad runs away, by the reference solver: halfway between two
 * trials. */
static const struct {
    double slope, reference;
} cases[CASES] = {{0.02, 38.19}, {0.05, 9.482}, {0.1, 4.0725}};

/* Started at that speed, does the pad run away? The load is there from the start, so that nothing swings into the
 * disc. */
static void start(struct lab *lab, double speed) { lab_setf(lab, "xd0 %.9g", -speed); }

static bool runs_away(struct lab *lab, double speed)
{
    start(lab, speed);
    const struct device_point point = lab_trial(lab, LIFE_PERIODS, 8);
    return point.motion == CLASS_DIVERGING;
}

/* The starting speed between both fates, and the speed amplitude of what stays long beside the cycle. */
static double cycle_find(struct lab *lab, double slope, double guess, double *start_m_per_s)
{
    lab_table1(lab, "alpha %.9g N0 %.9g y0 %.9g x0 %.9g v_max %.9g", -slope, FORCE_N, FORCE_N, 0.3 * FORCE_N / 2.0,
               4.0 * guess);
    *start_m_per_s = lab_bisect(lab, 0.4 * guess, 1.6 * guess, HALVINGS, runs_away);
    start(lab, *start_m_per_s);
    (void)lab_settle(lab, SEEN_FROM);
    const struct lab_motion motion = lab_measure(lab, SEEN_PERIODS, NULL);
    return 0.5 * (motion.vmax_m_per_s - motion.vmin_m_per_s);
}

/* What becomes of the pad a little slower, and a little faster. */
static void fates(struct lab *lab, double start_m_per_s, struct lab_track tracks[2])
{
    for (int i = 0; i < 2; i++) {
        start(lab, start_m_per_s * (i == 0 ? 0.97 : 1.02));
        tracks[i] = lab_record(lab, "x,xd", i == 0 ? 60 : 24, 1);
    }
}

static const char commands[] =
    "set title 'The outer cycle, N = 1 N, constant load, " FIGURE_ALPHA " = -0.1 s/m' offset 0,1.3\n"
    "set xlabel 'displacement x  [m]'\nset ylabel 'velocity dx/dt  [m/s]'\n"
    "set xrange [-0.8*shown:0.8*shown]\nset yrange [-shown:shown]\n"
    "set arrow from graph 0, first 1 to graph 1, first 1 nohead lw 1.5 dt 2 lc rgb '" FIGURE_COLOUR_DISC "'\n"
    "set label 'v0' at graph 1.005, first 1 tc rgb '" FIGURE_COLOUR_DISC "'\n"
    "plot $slower with lines lw 1 lc rgb '" FIGURE_COLOUR_MOTION "' title '3 % slower: comes to stick', "
    "$faster with lines lw 1.2 lc rgb '#b02020' title '2 % faster: runs away', "
    "$cycle with lines lw 3 lc rgb '#303030' title 'at the border'\n";

static void draw(struct lab *lab, double start_m_per_s, double cycle)
{
    struct lab_track tracks[2];
    FILE *script;

    start(lab, start_m_per_s);
    (void)lab_settle(lab, SEEN_FROM);
    const struct lab_track orbit = lab_record(lab, "x,xd", 1, 1);
    fates(lab, start_m_per_s, tracks);
    script = lab_figure_open(lab);
    lab_figure_block(script, "slower", &tracks[0], 0, 1);
    lab_figure_block(script, "faster", &tracks[1], 0, 1);
    lab_figure_block(script, "cycle", &orbit, 0, 1);
    (void)fprintf(script, "shown = %.9g\n", isnan(cycle) ? 10.0 : 2.0 * cycle);
    lab_figure_close(
        lab, script, "outer-cycle",
        "A pad that starts a little below the border comes to stick and stays; a little above it runs away. The "
        "orbit between is an unstable cycle, which no run from rest shows.",
        commands);
    lab_csv_tracks(lab, "outer-cycle", tracks, 2);
}

void experiment_outer(struct lab *lab)
{
    double start_m_per_s = (double)NAN, cycle = (double)NAN;
    unsigned bounded = 0;

    for (int i = lab_options(lab)->is_small ? CASES - 1 : 0; i < CASES; i++) {
        char subject[TEXT_SIZE];
        const double formula =
            (double)eigen_outer_speed((float)(0.3 * FORCE_N), (float)(-cases[i].slope * FORCE_N), 0.01f);
        cycle = cycle_find(lab, cases[i].slope, formula, &start_m_per_s);
        (void)snprintf(subject, sizeof subject, "α = -%g s/m", cases[i].slope);
        lab_compare(lab, subject, "runs away if it starts faster than", start_m_per_s, "m/s", cases[i].reference,
                    LIMIT * cases[i].reference);
        lab_number(lab, subject, "speed amplitude of the outer cycle", cycle, "m/s");
        lab_number(lab, subject, "by the describing function, 4 µs N/(π (N |α| - c))", formula, "m/s");
        start(lab, 0.0);
        bounded += runs_away(lab, 0.0) ? 0 : 1;
    }
    draw(lab, start_m_per_s, cycle);
    lab_claim(
        lab, "diverges-beyond-c", bounded > 0 ? (cycle > 0.0 ? PAPER_IN_PART : PAPER_REFUTED) : PAPER_HOLDS,
        "outer-cycle",
        "from rest %u of the cases tried stay bounded, by sticking; a pad runs away only if it is faster than an "
        "unstable "
        "outer cycle, %.3g m/s at alpha = -0.1 s/m, and only as long as no floor keeps friction from turning round",
        bounded, cycle);
}
