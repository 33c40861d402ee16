/* From measurements to a name. */
#include "classify.h"

#include <math.h>
#include <stdio.h>

enum { MULTIPLICITY_MAX = 64, CYCLE_MAX = 16 };

static const double same = 1e-6;        /* two states of a settled motion */
static const double none = 1e-6;        /* a share within this of nothing or all; a motion against its unit */
static const double lle_chaotic = 3e-3; /* per period: more stretching than a finite window feigns on a torus */
static const double lle_torus = -1e-3;
static const double lle_locked = -1e-2;

int classify_multiplicity(const struct classify_strobe *strobe, size_t count, const struct window *window)
{
    const double x_range = window->x_max - window->x_min;
    const double v_range = window->v_max - window->v_min;

    for (size_t p = 1; p <= MULTIPLICITY_MAX && 2 * p <= count; p++) {
        double worst = 0.0;

        for (size_t i = p; i < count; i++) {
            worst = fmax(worst, fabs(strobe[i].x_m - strobe[i - p].x_m) / x_range);
            worst = fmax(worst, fabs(strobe[i].v_m_per_s - strobe[i - p].v_m_per_s) / v_range);
        }
        if (worst < same) {
            return (int)p;
        }
    }
    return 0;
}

/* How many of its own maxima a self-excited motion needs to repeat, in height and interval; 0: it does not. */
static int cycle_multiplicity(const struct window *window)
{
    const double range = window->x_max - window->x_min;

    for (int q = 1; q <= CYCLE_MAX && 4 * q < window->maxima; q++) {
        const double turn = window->maximum_s[q] - window->maximum_s[0];
        double worst = 0.0;

        for (int i = 0; i + 2 * q < window->maxima; i++) {
            const double interval = window->maximum_s[i + 2 * q] - window->maximum_s[i + q];
            const double before = window->maximum_s[i + q] - window->maximum_s[i];

            worst = fmax(worst, fabs(window->maximum_m[i + q] - window->maximum_m[i]) / range);
            worst = fmax(worst, fabs(interval - before) / turn);
        }
        if (worst < same) {
            return q;
        }
    }
    return 0;
}

static bool is_partial(double share) { return share > none && share < 1.0 - none; }

/* What no number of normal periods repeats. A pad that bounces has a period of its own, which x then follows. */
static const char *name_other(bool has_events, bool has_own_period, double lle_per_period)
{
    if (!has_events) {
        return has_own_period ? "locked-other" : "beating";
    }
    if (lle_per_period > lle_chaotic) {
        return "chaotic";
    }
    if (lle_per_period > lle_torus) {
        return "quasiperiodic";
    }
    return lle_per_period > lle_locked ? "longperiod" : "locked-other";
}

void classify_name(const struct window *window, int multiplicity, double lle_per_period, char name[CLASSIFY_NAME_SIZE])
{
    const struct plant *plant = window->plant;
    const double stiffness = plant_stiffness_n_per_m(plant);
    const double unit =
        fmax(fabs(plant->disc_m_per_s) / plant_omega_rad_per_s(plant),
             stiffness > 0.0 ? plant->friction_static_ratio * plant_load_max_n(plant) / stiffness : 0.0);
    const bool sticks = is_partial(window_share(window, window->stick_s));
    const bool crosses = is_partial(window_share(window, window->slip_minus_s));
    const bool is_steady = window->y_max - window->y_min <= same * fmax(fabs(window->y_max), fabs(window->y_min));
    const int cycles = cycle_multiplicity(window);

    if (window->x_max - window->x_min < none * unit) {
        snprintf(name, CLASSIFY_NAME_SIZE, "rest");
    } else if (multiplicity > 0) {
        snprintf(name, CLASSIFY_NAME_SIZE, "%s-p%d", sticks ? "stickslip" : crosses ? "cross" : "forced", multiplicity);
    } else if (is_steady && cycles > 0) {
        snprintf(name, CLASSIFY_NAME_SIZE, "limitcycle-%s-p%d", sticks || crosses ? "stickslip" : "slip", cycles);
    } else {
        snprintf(name, CLASSIFY_NAME_SIZE, "%s", name_other(sticks || crosses, cycles > 0, lle_per_period));
    }
}
