/* The check that the paper announces: its analytic solution of forced slip beside the device. Error by error in print,
 * and set right order by order (model/MODEL.md, "The paper's analytic solution"). */
#include "squeal/paper/lab_model.h"

#include "analysis/perturbation.h"
#include "squeal/plot/figure.h"

#include <math.h>

enum { PERIODS = 10, SHOWN_PERIODS = 2, SPP = 256, TEXT_SIZE = 512 };

/* Rounding of single precision in the device and in the solution. */
#define ROUNDING 4e-6
#define LIMIT_NORMAL 1e-5
#define LIMIT_RELATIVE 0.15
#define NONE ((double)NAN)
#define GOOD 0.05 /* an error that hardly shows in a picture */

#define COLOURS                                                                                           \
    "colour0 = '#b02020'\ncolour1 = '" FIGURE_COLOUR_DISC "'\ncolour2 = '#7a7a7a'\ncolour3 = '#2e7d32'\n" \
    "colour4 = '" FIGURE_COLOUR_MOTION "'\n"

struct form {
    const char *name;
    enum perturbation_form form;
    unsigned order;
};

enum { FORM_PRINTED, FORM_WITH_COS, FORM_ORDER_0, FORM_ORDER_1, FORM_ORDER_2, FORMS };

static const struct form forms[FORMS] = {[FORM_PRINTED] = {"as printed", PERTURBATION_PRINTED, 2},
                                         [FORM_WITH_COS] = {"printed, but 1 - cos", PERTURBATION_WITH_COS, 2},
                                         [FORM_ORDER_0] = {"corrected, order 0", PERTURBATION_CORRECTED, 0},
                                         [FORM_ORDER_1] = {"corrected, order 1", PERTURBATION_CORRECTED, 1},
                                         [FORM_ORDER_2] = {"corrected, order 2", PERTURBATION_CORRECTED, 2}};

/* For each form the error against the reference solution, which does not round; NaN: not known. */
static const struct analytic_case {
    const char *name, *title, *assignments;
    double reference[FORMS];
} cases[] = {
    {"analytic-a0.002", "N = 1 N, α = -0.002 s/m", "alpha -0.002", {1.4, 4.8e-3, 9.3e-4, 2.9e-6, 1.8e-9}},
    {"analytic-z1", "Z² = 1, v0 = 100 m/s, α = -0.002 s/m", "kt 0.5 k 0.5 v0 100", {NONE, NONE, NONE, NONE, NONE}},
    {"analytic-a0.009", "N = 1 N, α = -0.009 s/m", "alpha -0.009", {NONE, 2.2e-2, 4e-3, 5.9e-5, 1.6e-7}},
    {"analytic-z1-a0.0002",
     "Z² = 1, v0 = 100 m/s, α = -0.0002 s/m",
     "kt 0.5 k 0.5 v0 100 alpha -0.0002",
     {NONE, NONE, 2.4e-4, 1.2e-6, 8e-11}},
};

/* A solution in the units of the device. */
struct solution {
    struct params params;
    struct scale scale;
    struct perturbation forms[FORMS];
};

/* The set in force, as the device has it. */
static void solution_read(struct lab *lab, struct solution *solution)
{
    lab_model(lab, &solution->params, &solution->scale);
    if (!perturbation_is_served(&solution->params, &solution->scale)) {
        lab_fail(lab, "the analytic solution does not serve this set");
    }
    for (int i = 0; i < FORMS; i++) {
        perturbation_derive(&solution->forms[i], &solution->params, &solution->scale, forms[i].form, forms[i].order);
    }
}

static double forced_m(const struct solution *solution, int form, uint64_t step)
{
    const uint32_t turns = (uint32_t)(step % SPP) * (UINT32_C(0xffffffff) / SPP + 1u);

    return (double)(perturbation_forced(&solution->forms[form], turns).x * solution->scale.length_m);
}

static double half_range(const struct lab_track *track)
{
    double low = track->value[0][0], high = low;

    for (size_t i = 0; i < track->count; i++) {
        low = fmin(low, track->value[0][i]);
        high = fmax(high, track->value[0][i]);
    }
    return 0.5 * (high - low);
}

static double error_of(const struct solution *solution, int form, const struct lab_track *track)
{
    double largest = 0.0;

    for (size_t i = 0; i < track->count; i++) {
        largest = fmax(largest, fabs(track->value[0][i] - forced_m(solution, form, track->step[i])));
    }
    return largest / half_range(track);
}

/* Puts the device on the orbit of the best solution, from where it goes on by itself. */
static struct lab_track run_on_orbit(struct lab *lab, struct solution *solution, const char *assignments)
{
    char start[TEXT_SIZE];

    lab_preset(lab, "table1");
    lab_set(lab, assignments);
    lab_set(lab, "spp 256");
    solution_read(lab, solution);
    const struct perturbation_state state = perturbation_forced(&solution->forms[FORM_ORDER_2], 0);
    (void)snprintf(start, sizeof start, "x0 %.9g xd0 %.9g", (double)(state.x * solution->scale.length_m),
                   (double)(state.v * solution->scale.speed_m_per_s));
    lab_set(lab, start);
    return lab_record(lab, "x", PERIODS, 1);
}

/* --- Pictures ----------------------------------------------------------------------------------------------------- */

/* Time in periods, the device, then every form: over the first periods. */
static void write_motion(FILE *script, const struct solution *solution, const struct lab_track *track)
{
    const double half = half_range(track);

    (void)fputs("$motion << END\n", script);
    for (size_t i = 0; i < track->count && track->step[i] <= SHOWN_PERIODS * SPP; i += 2) {
        (void)fprintf(script, "%.6g %.9g", (double)track->step[i] / SPP, track->value[0][i]);
        for (int form = 0; form < FORMS; form++) {
            const double x_m = forced_m(solution, form, track->step[i]);
            (void)fprintf(script, " %.9g %.3g", x_m, fmax(fabs(x_m - track->value[0][i]) / half, 1e-9));
        }
        (void)fputc('\n', script);
    }
    (void)fputs("END\n", script);
}

static const char motion_commands[] = COLOURS
    "set multiplot title headline offset 0,-0.5\nset origin 0,0.46\nset size 1,0.49\nset tmargin 3.5\nset bmargin 1\n"
    "set key font ',15' maxrows 1 width -2\n"
    "set xrange [0:2]\nset format x ''\nset ylabel 'x  [m]'\nset xlabel ''\nset ytics autofreq\n"
    "set offsets 0, 0, graph 0.05, graph 0.05\n"
    "plot $motion using 1:3 with lines lw 1.5 lc rgb colour0 title name0, "
    "$motion using 1:5 with lines lw 1.5 lc rgb colour1 title name1, "
    "$motion using 1:11 with lines lw 3 lc rgb colour4 title name4, "
    "$motion using 1:2 every 4 with points pt 6 ps 0.7 lc rgb '#000000' title 'device'\n"
    "set origin 0,0\nset size 1,0.47\nset tmargin 3\nset bmargin 3.5\nset format x '%g'\n"
    "set logscale y\nset format y '10^{%L}'\nset yrange [1e-7:10]\n"
    "set ylabel 'error / half range'\nset xlabel 'time  [normal periods Tn]'\n"
    "set key at graph 1,1.02 right bottom horizontal maxrows 1 samplen 1.2 font ',14' width -3\n"
    "plot for [i=0:4] $motion using 1:(column(4+2*i)) with lines lw 1.5 lc rgb value(sprintf('colour%d',i)) "
    "title value(sprintf('name%d',i))\nunset multiplot\n";

static void draw_motion(struct lab *lab, const struct analytic_case *what, const struct solution *solution,
                        const struct lab_track *track)
{
    char caption[TEXT_SIZE];
    FILE *script = lab_figure_open(lab);

    write_motion(script, solution, track);
    for (int form = 0; form < FORMS; form++) {
        (void)fprintf(script, "name%d = \"%s\"\n", form, forms[form].name);
    }
    (void)fprintf(script, "headline = \"The analytic solution, %s\"\n", what->title);
    (void)snprintf(caption, sizeof caption,
                   "Forced slip on its orbit, %s: Eq. 19 as printed, with 1 - cos in Eq. 9, and set right, over the "
                   "device; below, how far each is from the device, in half the range of x.",
                   what->title);
    lab_figure_close(lab, script, what->name, caption, motion_commands);
}

/* Largest error of each form, from the worst case. */
static void run_case(struct lab *lab, const struct analytic_case *what, double worst[FORMS])
{
    struct solution solution;
    const struct lab_track track = run_on_orbit(lab, &solution, what->assignments);

    draw_motion(lab, what, &solution, &track);
    for (int form = 0; form < FORMS; form++) {
        const double error = error_of(&solution, form, &track), reference = what->reference[form];
        worst[form] = fmax(worst[form], error);
        if (isnan(reference)) {
            lab_number(lab, what->title, forms[form].name, error, "of half range");
        } else {
            lab_compare(lab, what->title, forms[form].name, error, "of half range", reference,
                        LIMIT_RELATIVE * reference + ROUNDING);
        }
    }
    lab_csv_tracks(lab, what->name, &track, 1);
}

/* --- The normal direction ----------------------------------------------------------------------------------------- */

/* Distance of y from N/ke (1 - wave), in N/ke. */
static double normal_error(struct lab *lab, const struct lab_track *track, double (*wave)(double))
{
    const double size_m = lab_get(lab, "N0") / lab_get(lab, "ke");
    double largest = 0.0;

    for (size_t i = 0; i < track->count; i++) {
        const double tau = 2.0 * acos(-1.0) * track->t_s[i] / lab_period_s(lab);
        largest = fmax(largest, fabs(track->value[0][i] / size_m - (1.0 - wave(tau))));
    }
    return largest;
}

static void run_normal(struct lab *lab)
{
    FILE *script = lab_figure_open(lab);

    lab_preset(lab, "table1");
    const struct lab_track track = lab_record(lab, "y", SHOWN_PERIODS, 1);
    const double sine = normal_error(lab, &track, sin), cosine = normal_error(lab, &track, cos);
    (void)fputs("$normal << END\n", script);
    for (size_t i = 0; i < track.count; i++) {
        (void)fprintf(script, "%.6g %.6g\n", track.t_s[i] / lab_period_s(lab), track.value[0][i]);
    }
    (void)fprintf(script, "END\nsize = %.9g\n", lab_get(lab, "N0") / lab_get(lab, "ke"));
    lab_figure_close(
        lab, script, "eq9",
        "Eq. 9: the normal direction after the brake is applied at rest. As printed it does not even begin "
        "where the pad is.",
        "set title 'Eq. 9: normal displacement from rest' offset 0,1.3\nset xlabel 'time  [normal periods "
        "Tn]'\nset ylabel 'normal displacement y  [m]'\nset xrange [0:2]\nset samples 400\n"
        "set offsets 0, 0, graph 0.06, graph 0.06\nset key font ',16' width -2\n"
        "plot size*(1-sin(2*pi*x)) with lines lw 2 lc rgb '#b02020' title '1 - sin, as printed', "
        "size*(1-cos(2*pi*x)) with lines lw 2 lc rgb '" FIGURE_COLOUR_MOTION "' title '1 - cos', "
        "$normal using 1:2 every 2 with points pt 6 ps 0.7 lc rgb '#000000' title 'device'");
    lab_number(lab, "y against N/ke (1 - sin wn t)", "greatest distance", sine, "N/ke");
    lab_compare(lab, "y against N/ke (1 - cos wn t)", "greatest distance", cosine, "N/ke", 0.0, LIMIT_NORMAL);
    lab_csv_tracks(lab, "eq9", &track, 1);
    lab_claim(lab, "normal-motion",
              sine < GOOD     ? PAPER_HOLDS
              : cosine < GOOD ? PAPER_REFUTED
                              : PAPER_IN_PART,
              "eq9", "%.2g N/ke off as printed; 1 - cos instead of 1 - sin is %.1g off", sine, cosine);
}

void experiment_analytic(struct lab *lab)
{
    double worst[FORMS] = {0.0};
    const size_t count = lab_options(lab)->is_small ? 2 : sizeof cases / sizeof cases[0]; /* the second is the worst */

    run_normal(lab);
    for (size_t i = 0; i < count; i++) {
        run_case(lab, &cases[i], worst);
    }
    lab_claim(
        lab, "analytic-solution",
        worst[FORM_PRINTED] < GOOD    ? PAPER_HOLDS
        : worst[FORM_WITH_COS] < GOOD ? PAPER_IN_PART
                                      : PAPER_REFUTED,
        cases[1].name,
        "as printed up to %.0f %% of half the range off; with 1 - cos %.2g %%; set right, %.1g, %.1g and %.1g of it "
        "in orders 0, 1 and 2",
        100.0 * worst[FORM_PRINTED], 100.0 * worst[FORM_WITH_COS], worst[FORM_ORDER_0], worst[FORM_ORDER_1],
        worst[FORM_ORDER_2]);
}
