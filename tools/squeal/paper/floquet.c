/* Growth of permanent slip over the stiffness: by the map over one period, in closed form, and by two plants on
 * the device. */
#include "squeal/paper/lab_model.h"
#include "squeal/paper/orbit.h"
#include "squeal/paper/table.h"

#include "analysis/floquet.h"
#include "squeal/plot/figure.h"

#include <math.h>

enum { CURVE_POINTS = 301, GROWING_PERIODS = 150, DYING_PERIODS = 800, TEXT_SIZE = 64 };

#define SHARE 0.9 /* N |alpha|/c */
#define FAST 100.0
#define LIMIT 0.01 /* of the rate without the normal oscillation's help, c/2m */

static const double places[] = {0.3,   0.4,  0.44,  0.47, 0.485, 0.49, 0.495, 0.497, 0.498, 0.5,  0.502, 0.503,
                                0.505, 0.51, 0.515, 0.53, 0.56,  0.6,  0.7,   0.85,  0.97,  1.03, 1.15,  1.3};

static void set(struct lab *lab, double z)
{
    lab_table1(lab, "k 0 kt %.9g v0 %.9g v_max %.9g alpha %.9g", z * z, FAST, 4.0 * FAST, -SHARE * 0.01);
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
        const double z = 0.25 + 1.1 * i / (CURVE_POINTS - 1);
        const struct floquet_problem problem = {scale.damping, -(float)SHARE * scale.damping, (float)(z * z), 1.0f};
        table_add(
            lab, &table,
            (const double[]){z, omega * (double)floquet_rate(&problem), omega * (double)floquet_rate_closed(&problem)});
    }
    return table;
}

/* What is small between two plants, whatever the load does to both. Where it grows, the pads must not reach the disc's speed. */
static struct table measure(struct lab *lab)
{
    const double limit = LIMIT * 0.01 / (2.0 * 0.3);
    struct table table = table_begin("Z,device[1/s]");

    for (size_t i = 0; i < sizeof places / sizeof places[0]; i += lab_options(lab)->is_small ? 3 : 1) {
        char subject[TEXT_SIZE];
        set(lab, places[i]);
        const double expected = (double)lab_analysis(lab).floquet_per_s;
        const unsigned to = expected > 0.0 ? GROWING_PERIODS : DYING_PERIODS;
        const double offset_m = expected > 0.0 ? 0.1 : 1.0;
        const double growth = orbit_parting(lab, offset_m, to / 2, to, NULL) / lab_period_s(lab);
        table_add(lab, &table, (const double[]){places[i], growth});
        (void)snprintf(subject, sizeof subject, "Z = %g", places[i]);
        lab_compare(lab, subject, "growth", growth, "1/s", expected, limit);
    }
    return table;
}

static const char commands[] =
    "set title 'Growth of permanent slip, N |" FIGURE_ALPHA "| = 0.9 c' offset 0,1.3\nset xrange [0.25:1.35]\n"
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
        lab, script, "floquet",
        "Growth of a disturbance of the slipping pad. Below 0 it dies out. At Z = 1/2 the normal oscillation feeds it: "
        "the tongue of parametric resonance. The one at Z = 1 is too weak to be seen.",
        commands);
    table_save(lab, &curve, "floquet",
               "growth of permanent slip over Z, by the map over one period and in closed form");
    table_save(lab, &device, "floquet-device", "growth over Z by two plants on the device");
}
