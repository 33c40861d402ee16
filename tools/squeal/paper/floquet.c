/* Growth of permanent slip over the stiffness: by the map over one period, in closed form, and by two plants on
 * the device. */
#include "squeal/paper/lab_model.h"
#include "squeal/paper/orbit.h"
#include "squeal/paper/table.h"

#include "analysis/floquet.h"
#include "squeal/plot/figure.h"

#include <math.h>

enum { CURVE_POINTS = 441, FEWEST_PERIODS = 24, MOST_PERIODS = 96, TEXT_SIZE = 64 };

#define SHARE 0.9   /* N |alpha|/c */
#define DAMPING 0.1 /* c in N s/m, ten times that of Table 1: the tongue gets wide enough to be seen */
#define SPEED 20.0  /* of the disc, in m/s: far from what the pad reaches */
#define OFFSET_M 0.05
#define FOLDS 5.0  /* of growth or decay, to be followed */
#define LIMIT 0.01 /* of the rate at which damping alone takes it away, c/2m */

static const double places[] = {0.3,  0.36, 0.4,   0.43, 0.445, 0.45, 0.46, 0.465, 0.47, 0.48, 0.49, 0.5, 0.51,
                                0.52, 0.53, 0.535, 0.55, 0.56,  0.58, 0.6,  0.7,   0.85, 0.95, 1.0,  1.1, 1.2};

/* Friction is 0 at the disc's speed, so that the load moves no pad that stands still, and all that moves is what one
 * put in. */
static void set(struct lab *lab, double z)
{
    const double slope = SHARE * DAMPING;

    lab_table1(lab, "k 0 kt %.9g c %.9g v0 %.9g alpha %.9g mu_s %.9g", z * z, DAMPING, SPEED, -slope, slope * SPEED);
}

static struct table curves(struct lab *lab)
{
    struct table table = table_begin("Z,monodromy[1/s],closed[1/s]");
    struct params params;
    struct scale scale;

    set(lab, 1.0);
    lab_model(lab, &params, &scale);
    const double omega = (double)scale.omega_rad_per_s;
    for (int i = 0; i < CURVE_POINTS; i++) {
        const double z = 0.25 + 1.0 * i / (CURVE_POINTS - 1);
        const struct floquet_problem problem = {scale.damping, -(float)SHARE * scale.damping, (float)(z * z), 1.0f};
        table_add(
            lab, &table,
            (const double[]){z, omega * (double)floquet_rate(&problem), omega * (double)floquet_rate_closed(&problem)});
    }
    return table;
}

/* A pad that stands, and one that starts five centimetres away from it. */
static struct table measure(struct lab *lab)
{
    const double limit = LIMIT * DAMPING / (2.0 * 0.3);
    struct table table = table_begin("Z,device[1/s]");

    for (size_t i = 0; i < sizeof places / sizeof places[0]; i += lab_options(lab)->is_small ? 3 : 1) {
        char subject[TEXT_SIZE];
        set(lab, places[i]);
        const double expected = (double)lab_analysis(lab).floquet_per_s;
        const double long_enough = FOLDS / fabs(expected) / lab_period_s(lab);
        const unsigned to = (unsigned)fmin(fmax(long_enough, FEWEST_PERIODS), MOST_PERIODS);
        const double growth = orbit_parting(lab, OFFSET_M, to / 2, to, NULL) / lab_period_s(lab);
        table_add(lab, &table, (const double[]){places[i], growth});
        (void)snprintf(subject, sizeof subject, "Z = %g", places[i]);
        lab_compare(lab, subject, "growth", growth, "1/s", expected, limit);
    }
    return table;
}

static const char commands[] =
    "set title 'Growth of permanent slip, N |" FIGURE_ALPHA
    "| = 0.9 c, c = 0.1 N s/m' offset 0,1.3\nset xrange [0.25:1.25]\n"
    "set xlabel 'Z, frequency of the pad over that of the normal direction'\nset ylabel 'growth  [1/s]' offset -1.5,0\n"
    "set lmargin 14\nset xzeroaxis lt 1 lc rgb '#606060'\nset offsets 0, 0, graph 0.06, graph 0.06\n"
    "plot $curves using 1:2 with lines lw 3 lc rgb '" FIGURE_COLOUR_DISC "' title 'map over one period', "
    "$curves using 1:3 with lines dt 2 lw 2 lc rgb '#303030' title 'closed form', "
    "$device using 1:2 with points pt 7 ps 1.3 lc rgb '" FIGURE_COLOUR_MOTION "' title 'device'\n";

void experiment_floquet(struct lab *lab)
{
    const struct table curve = curves(lab), device = measure(lab);
    FILE *script = lab_figure_open(lab);

    table_block(script, &curve, "curves");
    table_block(script, &device, "device");
    lab_figure_close(
        lab, script, "floquet-growth",
        "Growth of a disturbance of the slipping pad. Below 0 it dies out. At Z = 1/2 the normal oscillation feeds it: "
        "the tongue of parametric resonance. The one at Z = 1 is too weak to be seen.",
        commands);
    table_save(lab, &curve, "floquet-growth",
               "growth of permanent slip over Z, by the map over one period and in closed form");
    table_save(lab, &device, "floquet-device", "growth over Z by two plants on the device");
}
