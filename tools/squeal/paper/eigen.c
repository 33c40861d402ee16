/* Complex eigenvalues of steady sliding beside the device: growth over the brake force, frequency over the contact
 * stiffness, of the preset brake. */
#include "squeal/paper/lab_model.h"
#include "squeal/paper/orbit.h"
#include "squeal/paper/table.h"

#include "squeal/plot/figure.h"

#include <math.h>

enum { FROM_PERIODS = 4, TO_PERIODS = 36, SETTLE_PERIODS = 1200, WINDOW_PERIODS = 40, TEXT_SIZE = 64 };

#define OFFSET 1e-3          /* of the displacement in equilibrium */
#define LIMIT_GROWTH 1.0     /* 1/s */
#define LIMIT_FREQUENCY 0.02 /* relative: sticking holds the pad up a little */

/* In equilibrium under a constant load, without roughness. */
static void balance(struct lab *lab, double force_n)
{
    lab_preset(lab, "brake");
    const double friction =
        fmax(lab_get(lab, "mu_s") + lab_get(lab, "alpha") * lab_get(lab, "v0"), lab_get(lab, "mu_floor"));
    lab_setf(lab, "load constant N0 %.9g rough 0 runout 0 y0 %.9g x0 %.9g", force_n, force_n / lab_get(lab, "ke"),
             friction * force_n / (lab_get(lab, "kt") + lab_get(lab, "k")));
}

static struct table growths(struct lab *lab)
{
    const int points = lab_options(lab)->is_small ? 5 : 19;
    struct table table = table_begin("N[N],device[1/s],eigenvalue[1/s]");

    for (int i = 0; i < points; i++) {
        const double force_n = 500.0 + 4500.0 * i / (points - 1);
        char subject[TEXT_SIZE];
        balance(lab, force_n);
        const double expected = (double)lab_analysis(lab).tangential.growth_per_s;
        const double growth =
            orbit_parting(lab, OFFSET * lab_get(lab, "x0"), FROM_PERIODS, TO_PERIODS, NULL) / lab_period_s(lab);
        table_add(lab, &table, (const double[]){force_n, growth, expected});
        (void)snprintf(subject, sizeof subject, "N = %g N", force_n);
        lab_compare(lab, subject, "growth", growth, "1/s", expected, LIMIT_GROWTH);
    }
    return table;
}

static struct table frequencies(struct lab *lab)
{
    const int points = lab_options(lab)->is_small ? 3 : 25;
    struct table table = table_begin("kt[N/m],device[Hz],eigenvalue[Hz],normal[Hz]");
    double worst = 0.0;

    for (int i = 0; i < points; i++) {
        const double contact = 1e7 + 1.4e8 * i / (points - 1);
        lab_preset(lab, "brake");
        lab_setf(lab, "kt %.9g", contact);
        const struct analysis analysis = lab_analysis(lab);
        const struct device_point point = lab_trial(lab, SETTLE_PERIODS, WINDOW_PERIODS);
        const double expected = (double)analysis.tangential.frequency_hz;
        table_add(
            lab, &table,
            (const double[]){contact, (double)point.frequency_hz, expected, (double)analysis.normal.frequency_hz});
        worst = fmax(worst, fabs((double)point.frequency_hz / expected - 1.0));
    }
    lab_compare(lab, "squeal against the eigenvalue, over kt", "greatest distance in frequency", worst, "of it", 0.0,
                LIMIT_FREQUENCY);
    return table;
}

static const char growth_commands[] =
    "set title 'Growth of a disturbance of steady sliding, preset brake' offset 0,1.3\nset xlabel 'brake force N  "
    "[N]'\n"
    "set ylabel 'growth  [1/s]'\nset xzeroaxis lt 1 lc rgb '#606060'\n"
    "plot $growth using 1:3 with lines lw 2 lc rgb '" FIGURE_COLOUR_DISC "' title 'complex eigenvalue', "
    "$growth using 1:2 with points pt 7 ps 1.3 lc rgb '" FIGURE_COLOUR_MOTION "' title 'device'\n";

static const char frequency_commands[] =
    "set title 'Frequency over the contact stiffness kt, preset brake, N = 3000 N' offset 0,1.3\n"
    "set xlabel 'contact stiffness kt  [N/\302\265m]'\nset ylabel 'frequency  [kHz]'\nset yrange [0:*]\n"
    "plot $frequency using ($1*1e-6):($3*1e-3) with lines lw 2 lc rgb '" FIGURE_COLOUR_DISC
    "' title 'eigenvalue, along the "
    "disc', "
    "$frequency using ($1*1e-6):($4*1e-3) with lines dt 2 lw 2 lc rgb '#7a7a7a' title 'into the disc', "
    "$frequency using ($1*1e-6):($2*1e-3) with points pt 7 ps 1.3 lc rgb '" FIGURE_COLOUR_MOTION
    "' title 'squeal of the device'\n";

static void draw(struct lab *lab, const struct table *table, const char *name, const char *block, const char *caption,
                 const char *commands)
{
    FILE *script = lab_figure_open(lab);

    table_block(script, table, block);
    lab_figure_close(lab, script, name, caption, commands);
    table_save(lab, table, name, caption);
}

void experiment_eigen(struct lab *lab)
{
    const struct table growth = growths(lab);
    draw(lab, &growth, "eigen-force", "growth",
         "Real part of the eigenvalue of steady sliding over the brake force, and the growth of a disturbance of a "
         "thousandth on "
         "the device: the brake squeals where it is above 0.",
         growth_commands);
    const struct table frequency = frequencies(lab);
    draw(lab, &frequency, "eigen-stiffness", "frequency",
         "Imaginary part of both eigenvalues over the contact stiffness, and the frequency of the squeal on the "
         "device. The modes "
         "cross without meeting, since the pad's motion does not act back on the normal direction.",
         frequency_commands);
}
