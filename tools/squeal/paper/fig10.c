/* Figs. 10a and 10b: strobes of the pad over the friction coefficient and over the disc's speed, swept up and down
 * without a reset; where the period doubles, and which brake force the paper must have used. */
#include "squeal/paper/sweep.h"

#include "sim/detector.h"
#include "squeal/plot/figure.h"

#include <math.h>
#include <string.h>

enum { TEXT_SIZE = 512, CASES = 14, MOST_PERIODS = 3000 };

#define LIMIT_DOUBLING 2e-3 /* relative: the multiplier is extrapolated to 1 */
#define LIMIT_ALIKE 2e-3

struct diagram {
    const char *name, *symbol, *unit, *title, *axis,
        *set; /* the set has the parameter's largest value, which fixes the scale */
    double from, to;
    double paper;          /* where the paper's motion changes */
    double search_n[2];    /* forces without and with a doubled period there */
    double reference_n;    /* the force that doubles it there, by the reference solver */
    double one[2], two[2]; /* brackets of both ends of the bubble at 5 N: period 1, period 2 */
    double reference[2];   /* the ends, by the reference solver */
    const char *key;       /* in the names of the golden table, and the places that it has; ends with NaN */
    double cases[CASES];
    bool is_stable_below; /* as the paper has it */
};

/* The reference solver's Lyapunov exponent, extrapolated to 0. */
static const struct diagram diagrams[] = {
    {.name = "fig10a",
     .symbol = "mu_s",
     .unit = "1",
     .title = "Fig. 10a, v0 = 1 m/s, α = -0.02 s/m, β + γ = 1",
     .axis = "friction coefficient µs",
     .set = "alpha -0.02 kt 0.5 k 0.5 v_max 10 mu_s 1",
     .from = 0.03,
     .to = 1.0,
     .paper = 0.32,
     .search_n = {4.0, 5.0},
     .reference_n = 4.8783,
     .one = {0.2, 0.75},
     .two = {0.4, 0.5},
     .reference = {0.30996, 0.61739},
     .key = "mu",
     .cases = {0.05, 0.1, 0.2, 0.25, 0.3, 0.32, 0.34, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0},
     .is_stable_below = true},
    {.name = "fig10b",
     .symbol = "v0",
     .unit = "m/s",
     .title = "Fig. 10b, µs = 0.3, α = -0.02 s/m, β + γ = 1",
     .axis = "disc speed v0  [m/s]",
     .set = "alpha -0.02 kt 0.5 k 0.5 v_max 10 v0 1",
     .from = 0.05,
     .to = 2.5,
     .paper = 1.38,
     .search_n = {6.0, 7.0},
     .reference_n = 6.5841,
     .one = {0.3, 1.2},
     .two = {0.7, 0.8},
     .reference = {0.48592, 0.96789},
     .key = "v",
     .cases = {0.1, 0.25, 0.5, 0.75, 0.9, 1.0, 1.1, 1.25, 1.38, 1.5, 1.75, 2.0, (double)NAN},
     .is_stable_below = false}};

static void set(struct lab *lab, const struct diagram *diagram, double force_n)
{
    lab_table1(lab, "%s N0 %.9g", diagram->set, force_n);
}

/* --- The diagram -------------------------------------------------------------------------------------------------- */

static const char commands[] =
    "set title headline offset 0,1.3\nset xlabel axis\nset ylabel 'x once a normal period  [m]'\nset xrange [from:to]\n"
    "set offsets 0, 0, graph 0.05, graph 0.05\nset xtics autofreq\n"
    "do for [i=1:words(marks)] { set arrow i from first real(word(marks, i)), graph 0 to first real(word(marks, i)), "
    "graph 1 nohead dt 3 lw 1.5 lc rgb '#2e7d32' }\n"
    "set arrow 9 from first paper, graph 0 to first paper, graph 1 nohead dt 2 lw 1.5 lc rgb '#b02020'\n"
    "plot $strobes using 1:($2 > 0 ? $3 : NaN) with points pt 7 ps 0.7 lc rgb '" FIGURE_COLOUR_MOTION
    "' title 'upwards', "
    "$strobes using 1:($2 < 0 ? $3 : NaN) with points pt 6 ps 1.1 lc rgb '" FIGURE_COLOUR_DISC "' title 'downwards', "
    "NaN with lines dt 2 lw 1.5 lc rgb '#b02020' title \"the paper's change\", "
    "NaN with lines dt 3 lw 1.5 lc rgb '#2e7d32' title 'doubling'\n";

/* marks: where the period doubles, NaN for none. */
/* Returns places at which the motion does not repeat. */
static unsigned draw(struct lab *lab, const struct diagram *diagram, double force_n, const char *name,
                     const double marks[2])
{
    const char *what[] = {"N = %.4g N", "the force that doubles the period where the paper says, N = %.4g N"};
    char caption[TEXT_SIZE], force[TEXT_SIZE / 4];

    set(lab, diagram, force_n);
    const struct sweep sweep = sweep_make(lab, diagram->symbol, diagram->from, diagram->to);
    FILE *script = lab_figure_open(lab);
    (void)snprintf(force, sizeof force, what[strstr(name, "paper") != NULL ? 1 : 0], force_n);
    table_block(script, &sweep.strobes, "strobes");
    (void)fprintf(script, "headline = \"%s\\n{/*0.8 %s}\"\naxis = \"%s\"\nfrom = 0\nto = %.9g\npaper = %.9g\nmarks = '",
                  diagram->title, force, diagram->axis, diagram->to, diagram->paper);
    for (int i = 0; i < 2 && !isnan(marks[i]); i++) {
        (void)fprintf(script, "%.6g ", marks[i]);
    }
    (void)fputs("'\n", script);
    (void)snprintf(
        caption, sizeof caption,
        "%s, %s: x at whole normal periods once it repeats, each or every second time; all of the last %d where it "
        "does not.",
        diagram->title, force, ORBIT_STROBES);
    lab_figure_close(lab, script, name, caption, commands);
    lab_number(lab, force, "places of the sweep, up and down", 2.0 * sweep.places, "1");
    lab_number(lab, force, "not at rest after the longest wait", sweep.unsettled, "1");
    lab_number(lab, force, "ran away", sweep.diverged, "1");
    lab_number(lab, force, "differ upwards and downwards", sweep_hysteresis(&sweep), "1");
    table_save(lab, &sweep.strobes, name, "x once a normal period over the parameter, way 1 upwards, -1 downwards");
    return sweep.unsettled;
}

/* --- Where the period doubles ------------------------------------------------------------------------------------- */

static void compare_ends(struct lab *lab, const struct diagram *diagram, double ends[2])
{
    static const char *const names[] = {"N = 5 N, the period doubles from", "N = 5 N, the period doubles up to"};

    set(lab, diagram, 5.0);
    for (int i = 0; i < 2; i++) {
        ends[i] = orbit_doubling(lab, diagram->symbol, diagram->one[i], diagram->two[i]);
        lab_compare(lab, names[i], diagram->symbol, ends[i], diagram->unit, diagram->reference[i],
                    LIMIT_DOUBLING * diagram->reference[i]);
    }
}

static double find_force(struct lab *lab, const struct diagram *diagram)
{
    set(lab, diagram, diagram->search_n[1]);
    lab_setf(lab, "%s %.9g", diagram->symbol, diagram->paper);
    const double force_n = orbit_doubling(lab, "N0", diagram->search_n[0], diagram->search_n[1]);
    lab_compare(lab, "the force that doubles the period where the paper says", "N", force_n, "N", diagram->reference_n,
                LIMIT_DOUBLING * diagram->reference_n);
    return force_n;
}

/* The range of x at single places, beside the golden table. */
static void compare_cases(struct lab *lab, const struct diagram *diagram)
{
    char name[TEXT_SIZE], subject[TEXT_SIZE];

    for (size_t i = 0; i < CASES && !isnan(diagram->cases[i]); i += lab_options(lab)->is_small ? 4 : 1) {
        for (int force_n = 1; force_n <= 5; force_n += 4) {
            (void)snprintf(name, sizeof name, "%s_N%d_%s%g", diagram->name, force_n, diagram->key, diagram->cases[i]);
            (void)snprintf(subject, sizeof subject, "%s = %g%s, N = %d N", diagram->symbol, diagram->cases[i],
                           strcmp(diagram->unit, "1") == 0 ? "" : " m/s", force_n);
            set(lab, diagram, force_n);
            lab_setf(lab, "%s %.9g v_max 0", diagram->symbol, diagram->cases[i]);
            const double reference = lab_reference(lab, name, "xpp");
            lab_compare(lab, subject, "x, peak to peak", lab_xpp_m(lab, (unsigned)lab_reference(lab, name, "ntrans")),
                        "m", reference, LIMIT_DOUBLING * reference);
        }
    }
}

/* As the paper has it, it would be one change, with nothing on the other side of what it changes to. */
static void judge(struct lab *lab, const struct diagram *diagram, double force_n, const double ends[2],
                  unsigned unsettled)
{
    const bool is_once = isnan(ends[diagram->is_stable_below ? 1 : 0]);
    char name[TEXT_SIZE];

    (void)snprintf(name, sizeof name, "%s-n5", diagram->name);
    lab_claim(lab, diagram->name,
              isnan(force_n) ? PAPER_REFUTED
              : is_once      ? PAPER_HOLDS
                             : PAPER_IN_PART,
              name,
              "the period doubles at %.4g if N = %.4g N, which the paper does not state; it doubles over a bubble "
              "only, at N = 5 N "
              "from %.4g to %.4g, and is 1 again past it; the doubled motion is not unstable, and nothing doubles "
              "further: at "
              "all but %u places of these diagrams the motion repeats after one or two periods",
              diagram->paper, force_n, ends[0], ends[1], unsettled);
}

static void run(struct lab *lab, const struct diagram *diagram)
{
    static const double none[2] = {(double)NAN, (double)NAN};
    char name[TEXT_SIZE];
    double ends[2];

    lab_note(
        lab,
        "The paper does not state the force. With 1 N the period never doubles; with 5 N it does over a bubble that "
        "closes again. The ends of the bubble are where the multiplier of the alternating part of the motion, as it "
        "dies "
        "out on the device, reaches -1.");
    unsigned unsettled = 0;
    compare_ends(lab, diagram, ends);
    const double force_n = find_force(lab, diagram);
    (void)snprintf(name, sizeof name, "%s-n5", diagram->name);
    unsettled += draw(lab, diagram, 5.0, name, ends);
    if (!lab_options(lab)->is_small) {
        (void)snprintf(name, sizeof name, "%s-n1", diagram->name);
        unsettled += draw(lab, diagram, 1.0, name, none);
        (void)snprintf(name, sizeof name, "%s-paper", diagram->name);
        unsettled +=
            force_n > 0.0 ? draw(lab, diagram, force_n, name, (const double[2]){diagram->paper, (double)NAN}) : 0;
    }
    compare_cases(lab, diagram);
    judge(lab, diagram, force_n, ends, unsettled);
}

/* --- One diagram -------------------------------------------------------------------------------------------------- */

/* mu_s and v0 act by v0/mu_s alone: strobes over mu_s are those over v0 at the same ratio, in proportion. */
static double ratio_error(struct lab *lab)
{
    static const double ratios[] = {0.11, 0.4, 0.9};
    double largest = 0.0;

    for (size_t i = 0; i < sizeof ratios / sizeof ratios[0]; i++) {
        lab_table1(lab, "alpha -0.02 kt 0.5 k 0.5 N0 5 v_max 10 v0 1 mu_s %.9g", ratios[i]);
        const struct orbit by_friction = orbit_settle(lab, MOST_PERIODS);
        lab_table1(lab, "alpha -0.02 kt 0.5 k 0.5 N0 5 v_max 10 mu_s 0.3 v0 %.9g", 0.3 / ratios[i]);
        const struct orbit by_speed = orbit_settle(lab, MOST_PERIODS);
        for (int k = 0; k < ORBIT_STROBES; k++) {
            const double there = by_friction.x_m[k] / ratios[i], here = by_speed.x_m[k] / 0.3;
            largest = fmax(largest, fabs(here - there) / fabs(there));
        }
    }
    return largest;
}

/* Friction that would turn round below the disc's speed holds nothing. */
static void compare_lowest(struct lab *lab)
{
    set(lab, &diagrams[0], 5.0);
    lab_setf(lab, "mu_s 0.01");
    const struct device_point point = lab_trial(lab, MOST_PERIODS, ORBIT_STROBES);
    lab_compare_words(lab, "mu_s = 0.01 < |α| v0, N = 5 N", "motion", detector_class_name(point.motion), "diverging");
}

void experiment_fig10a(struct lab *lab)
{
    run(lab, &diagrams[0]);
    compare_lowest(lab);
}

/* So both figures, if they are of one brake, must change at the same v0/mu_s. */
static void judge_one_brake(struct lab *lab)
{
    const double error = ratio_error(lab), by_friction = 1.0 / diagrams[0].paper, by_speed = diagrams[1].paper / 0.3;

    lab_compare(lab, "strobes over mu_s and over v0 at the same v0/mu_s, N = 5 N", "greatest difference", error, "of x",
                0.0, LIMIT_ALIKE);
    lab_claim(lab, "fig10-one-brake",
              error > LIMIT_ALIKE                                   ? PAPER_IN_PART
              : fabs(by_friction / by_speed - 1.0) > LIMIT_DOUBLING ? PAPER_REFUTED
                                                                    : PAPER_HOLDS,
              "fig10b-n5",
              "friction and speed act by v0/mu_s alone, to %.1g of x on the device, so that both figures are one "
              "diagram; the "
              "paper's changes are at v0/mu_s = %.3g m/s and %.3g m/s and take two different forces",
              error, by_friction, by_speed);
}

void experiment_fig10b(struct lab *lab)
{
    run(lab, &diagrams[1]);
    judge_one_brake(lab);
}
