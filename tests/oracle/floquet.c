/* Two disturbances are carried over some periods of P; the largest eigenvalue of that map gives the rate. */
#include "floquet.h"

#include "orbit.h"

#include <math.h>

enum { PERIODS_MANY = 64, PERIODS_SETTLE_MAX = 2000 };

static const double settle_exponents = 40.0; /* a damped normal oscillation is gone after this */

/* Permanent slip has no meeting and no sticking: only contact can switch. */
static void slip_on(const struct plant *plant, struct plant_state *state, double until_s)
{
    const double step_s = 0.7 / plant_fastest_per_s(plant);

    while (state->t_s < until_s) {
        const double left_s = fmin(until_s, phase_next_break_s(plant, state->t_s)) - state->t_s;
        const double start_s = state->t_s;
        const struct phase phase = phase_expand(plant, state);
        double duration_s = fmin(step_s, left_s);
        double passage_s;
        bool is_passing = false;

        if (plant->contact_kind != CONTACT_BILATERAL) {
            struct polynomial side = polynomial_affine(&phase.y, state->is_touching ? 1.0 : -1.0, 0.0);

            side = state->is_contact_just_met ? polynomial_deflate(&side, 1) : side;
            is_passing = polynomial_first_negative(&side, duration_s, &passage_s);
            duration_s = is_passing ? passage_s : duration_s;
        }
        phase_evaluate(&phase, duration_s, state);
        state->t_s = !is_passing && left_s <= step_s ? start_s + left_s : start_s + duration_s;
        switching_apply(plant, is_passing ? EVENT_CONTACT : EVENT_NONE, &phase, duration_s, state);
        if (!is_passing && !(state->t_s > start_s)) {
            return;
        }
    }
}

/* The larger eigenvalue's modulus of {{a, b}, {c, d}}. */
static double spectral_radius(double a, double b, double c, double d)
{
    const double half_trace = 0.5 * (a + d);
    const double determinant = a * d - b * c;
    const double root = half_trace * half_trace - determinant;

    return root >= 0.0 ? fabs(half_trace) + sqrt(root) : sqrt(determinant);
}

double floquet_slip_rate_per_s(const struct plant *plant)
{
    const double period_s = plant_period_s(plant);
    const bool is_periodic = plant->load_kind != LOAD_SINE && plant->contact_kind != CONTACT_LIFT;
    const double span_s = (is_periodic ? 1.0 : PERIODS_MANY) * period_s;
    struct plant smooth = *plant;
    struct plant_state state = {.y_m = plant->y_initial_m, .w_m_per_s = plant->yd_initial_m_per_s};
    struct plant_state disturbed[2];
    double settled_s = plant_load_settled_s(plant);

    if (plant->normal_damping_n_s_per_m > 0.0) {
        const double damped_s = settle_exponents * 2.0 * plant->mass_kg / plant->normal_damping_n_s_per_m;

        settled_s += fmin(damped_s, PERIODS_SETTLE_MAX * period_s);
    }
    /* Only P and the slope matter: the orbit itself may be any, so it is kept at rest by a law without a constant. */
    smooth.friction_static_ratio = plant->friction_slope_s_per_m * -plant->disc_m_per_s;
    smooth.friction_floor_ratio = -1e30;
    switching_start(&smooth, &state);
    state.mode = MODE_SLIP_PLUS;
    slip_on(&smooth, &state, settled_s);
    for (int i = 0; i < 2; i++) {
        disturbed[i] = state;
        disturbed[i].dx = i == 0 ? 1.0 : 0.0;
        disturbed[i].dv = i == 1 ? plant_omega_rad_per_s(plant) : 0.0;
        slip_on(&smooth, &disturbed[i], settled_s + span_s);
    }
    disturbed[0].dv /= plant_omega_rad_per_s(plant);
    disturbed[1].dv /= plant_omega_rad_per_s(plant);
    return log(spectral_radius(disturbed[0].dx, disturbed[1].dx, disturbed[0].dv, disturbed[1].dv)) / span_s;
}
