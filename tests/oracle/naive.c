/* The equations of motion typed a second time, deliberately without any of plant.c's or phase.c's helpers. */
#include "naive.h"

#include <math.h>
#include <string.h>

enum { PERIODS = 20 };

static double load_at(const struct plant *p, double t)
{
    if (p->load_kind > 2.5) {
        return p->load_n + (t >= p->load_start_s ? p->load_end_n * sin(6.283185307179586 * p->load_end_s * t) : 0.0);
    }
    if (p->load_kind > 1.5 && t >= p->load_start_s && t < p->load_end_s) {
        return p->load_n + (p->load_end_n - p->load_n) * (t - p->load_start_s) / (p->load_end_s - p->load_start_s);
    }
    return p->load_kind > 0.5 && t >= p->load_start_s ? p->load_end_n : p->load_n;
}

/* s = {x, v, y, w} */
static void rate(const struct plant *p, double t, const double s[4], double d[4])
{
    const double vr = p->disc_m_per_s - s[1];
    const bool is_off = p->contact_kind > 0.5 && s[2] < 0.0;
    const double force = is_off ? 0.0 : p->normal_n_per_m * s[2];
    const double spring = is_off && p->contact_kind > 1.5 ? 0.0 : p->normal_n_per_m * s[2];
    const double mu = fmax(p->friction_static_ratio + p->friction_slope_s_per_m * fabs(vr), p->friction_floor_ratio);
    const double friction = vr > 0.0 ? mu * force : vr < 0.0 ? -mu * force : 0.0;

    d[0] = s[1];
    d[1] = (friction - p->damping_n_s_per_m * s[1] - (p->contact_n_per_m + p->caliper_n_per_m) * s[0]) / p->mass_kg;
    d[2] = s[3];
    d[3] = (load_at(p, t) - p->normal_damping_n_s_per_m * s[3] - spring) / p->mass_kg;
}

static void step(const struct plant *p, double t, double h, double s[4])
{
    double k[4][4];
    double at[4];

    rate(p, t, s, k[0]);
    for (int stage = 1; stage < 4; stage++) {
        const double part = stage < 3 ? 0.5 * h : h;

        for (int i = 0; i < 4; i++) {
            at[i] = s[i] + part * k[stage - 1][i];
        }
        rate(p, t + part, at, k[stage]);
    }
    for (int i = 0; i < 4; i++) {
        s[i] += h / 6.0 * (k[0][i] + 2.0 * (k[1][i] + k[2][i]) + k[3][i]);
    }
}

void naive_solve(const struct plant *plant, long steps_per_period, struct result *result)
{
    const double period_s = 6.283185307179586 * sqrt(plant->mass_kg / plant->normal_n_per_m);
    const double h = period_s / (double)steps_per_period;
    double s[4] = {plant->x_initial_m, plant->xd_initial_m_per_s, plant->y_initial_m, plant->yd_initial_m_per_s};

    result_clear(result);
    result->T_n = period_s;
    result->xmax_20 = result->xmin_20 = s[0];
    result->vmax_20 = result->vmin_20 = s[1];
    for (long i = 0; i < PERIODS * steps_per_period; i++) {
        step(plant, (double)i * h, h, s);
        result->xmax_20 = fmax(result->xmax_20, s[0]);
        result->xmin_20 = fmin(result->xmin_20, s[0]);
        result->vmax_20 = fmax(result->vmax_20, s[1]);
        result->vmin_20 = fmin(result->vmin_20, s[1]);
    }
    result->x_20 = s[0];
    result->v_20 = s[1];
    result->y_20 = s[2];
    strcpy(result->name, "naive");
}
