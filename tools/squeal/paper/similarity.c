/* Are stiffnesses of a newton a metre as good as real ones? A soft brake with the dimensionless groups of the realistic
 * one. */
#include "squeal/paper/lab_live.h"
#include "squeal/paper/table.h"

#include "sim/detector.h"
#include "squeal/plot/figure.h"

#include <math.h>

enum { SETTLE_PERIODS = 2600, WINDOW_PERIODS = 64, FORCES = 5, BRAKES = 2, SHOWN_PERIODS = 12, TEXT_SIZE = 128 };
enum { REAL, SOFT };

#define SCALE 1e4 /* of impedance and frequency: the soft brake has 1 N/m for 10^8 N/m */
#define LIMIT 2e-3
#define SHOWN_N 3000.0

static const double forces_n[FORCES] = {1000.0, 1900.0, 2100.0, 3000.0, 5000.0};

/* Impedances are scaled by it, and times by its inverse; friction, its slope and speeds stay. Run-out is left out in
 * both: its pace is that of the disc, which would take a radius of a kilometre. */
static void set(struct lab *lab, int brake, double force_n)
{
    lab_preset(lab, "brake");
    if (brake == REAL) {
        lab_setf(lab, "runout 0 N1 %.9g N_max 20000", force_n);
        return;
    }
    lab_setf(lab, "runout 0 c %.9g cn %.9g ke %.9g kt %.9g k %.9g N1 %.9g N_max 2 t2 %.9g", lab_get(lab, "c") / SCALE,
             lab_get(lab, "cn") / SCALE, lab_get(lab, "ke") / SCALE / SCALE, lab_get(lab, "kt") / SCALE / SCALE,
             lab_get(lab, "k") / SCALE / SCALE, force_n / SCALE, lab_get(lab, "t2") * SCALE);
}

static struct device_point trial(struct lab *lab, int brake, double force_n)
{
    set(lab, brake, force_n);
    return lab_trial(lab, SETTLE_PERIODS, WINDOW_PERIODS);
}

/* Is what the device says of both the same? */
static bool is_alike(struct lab *lab, double force_n)
{
    const struct device_point real = trial(lab, REAL, force_n), soft = trial(lab, SOFT, force_n);
    const bool is_loud = real.propensity == PROPENSITY_SQUEAL;
    const double size = lab_point_xpp_m(&soft) / SCALE, pitch = (double)soft.frequency_hz * SCALE;
    char subject[TEXT_SIZE];

    (void)snprintf(subject, sizeof subject, "N = %g N", force_n);
    lab_compare_words(lab, subject, "propensity of the soft brake", detector_propensity_name(soft.propensity),
                      detector_propensity_name(real.propensity));
    lab_compare_words(lab, subject, "motion of the soft brake", detector_class_name(soft.motion),
                      detector_class_name(real.motion));
    if (is_loud) {
        lab_compare(lab, subject, "x, peak to peak, soft, scaled", size, "m", lab_point_xpp_m(&real),
                    LIMIT * lab_point_xpp_m(&real));
        lab_compare(lab, subject, "frequency, soft, scaled", pitch, "Hz", (double)real.frequency_hz,
                    LIMIT * (double)real.frequency_hz);
    }
    return soft.propensity == real.propensity && soft.motion == real.motion &&
           (!is_loud || fabs(size / lab_point_xpp_m(&real) - 1.0) < LIMIT);
}

static const char commands[] =
    "set title 'Squeal of the realistic brake and of a soft one, N = 3000 N' offset 0,1.3\n"
    "set xlabel 'x over N/ke'\nset ylabel 'dx/dt over v0'\nset offsets graph 0.05, graph 0.05, graph 0.05, graph 0.05\n"
    "plot $portrait using 2:3 with lines lw 2 lc rgb '" FIGURE_COLOUR_MOTION "' title 'ke = 10^8 N/m, 2 kHz', "
    "$portrait using 4:5 every 4 with points pt 6 ps 1.1 lc rgb '" FIGURE_COLOUR_DISC "' title 'ke = 1 N/m, 0.2 Hz'\n";

/* The end of the trial at 3000 N, in units of N/ke and v0. */
static struct lab_track portrait(struct lab *lab, int brake, double unit[2])
{
    set(lab, brake, SHOWN_N);
    unit[0] = lab_get(lab, "N1") / lab_get(lab, "ke");
    unit[1] = lab_get(lab, "v0");
    (void)lab_settle(lab, SETTLE_PERIODS);
    return lab_record(lab, "x,xd", SHOWN_PERIODS, 1);
}

static void draw(struct lab *lab)
{
    struct table table = table_begin("step,x_real,v_real,x_soft,v_soft");
    double real_unit[2], soft_unit[2];
    const struct lab_track real = portrait(lab, REAL, real_unit), soft = portrait(lab, SOFT, soft_unit);

    for (size_t i = 0; i < real.count && i < soft.count; i++) {
        table_add(lab, &table,
                  (const double[]){(double)real.step[i], real.value[0][i] / real_unit[0],
                                   real.value[1][i] / real_unit[1], soft.value[0][i] / soft_unit[0],
                                   soft.value[1][i] / soft_unit[1]});
    }
    FILE *script = lab_figure_open(lab);
    table_block(script, &table, "portrait");
    lab_figure_close(
        lab, script, "similarity-portrait",
        "Phase portrait in units of N/ke and v0: a brake of newtons a metre with the same dimensionless groups is the "
        "same brake, ten thousand times slower.",
        commands);
    table_save(lab, &table, "similarity-portrait", "phase portraits at 3000 N in units of N/ke and v0");
}

void experiment_similarity(struct lab *lab)
{
    unsigned alike = 0, tried = 0;

    for (int i = 0; i < FORCES; i++) {
        if (!lab_options(lab)->is_small || i == 1 || i == 3) {
            alike += is_alike(lab, forces_n[i]) ? 1 : 0;
            tried++;
        }
    }
    draw(lab);
    lab_claim(lab, "small-stiffness",
              alike == tried ? PAPER_HOLDS
              : alike > 0    ? PAPER_IN_PART
                             : PAPER_REFUTED,
              "similarity-portrait",
              "at %u of %u forces, quiet and loud, a brake with ke = 1 N/m and the dimensionless groups of one with "
              "10^8 N/m has its "
              "verdict, its motion, and its size and frequency in proportion to %g",
              alike, tried, LIMIT);
}
