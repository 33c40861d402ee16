/* Term by term: the equations of motion give the term i+1 of every velocity from the terms up to i. */
#include "phase.h"

#include <math.h>

static const double two_pi = 6.283185307179586;

double phase_next_break_s(const struct plant *plant, double t_s)
{
    if (plant->load_kind != LOAD_CONSTANT && t_s < plant->load_start_s) {
        return plant->load_start_s;
    }
    if (plant->load_kind == LOAD_RAMP && t_s < plant->load_end_s) {
        return plant->load_end_s;
    }
    return HUGE_VAL;
}

static void add_sine(const struct plant *plant, double t_s, struct polynomial *load)
{
    const double omega = two_pi * plant->load_end_s;
    const double turn[4] = {sin(omega * t_s), cos(omega * t_s), -sin(omega * t_s), -cos(omega * t_s)};
    double scale = plant->load_end_n;

    for (int i = 0; i <= POLYNOMIAL_DEGREE; i++) {
        load->term[i] += scale * turn[i % 4];
        scale *= omega / (i + 1);
    }
}

/* N around t, valid up to the next break. */
static struct polynomial load_series(const struct plant *plant, double t_s)
{
    struct polynomial load = {{plant->load_n}};

    if (t_s < plant->load_start_s) {
        return load;
    }
    switch ((enum plant_load)plant->load_kind) {
    case LOAD_STEP:
        load.term[0] = plant->load_end_n;
        break;
    case LOAD_RAMP:
        if (t_s < plant->load_end_s) {
            load.term[1] = (plant->load_end_n - plant->load_n) / (plant->load_end_s - plant->load_start_s);
            load.term[0] += load.term[1] * (t_s - plant->load_start_s);
        } else {
            load.term[0] = plant->load_end_n;
        }
        break;
    case LOAD_SINE:
        add_sine(plant, t_s, &load);
        break;
    case LOAD_CONSTANT:
        break;
    }
    return load;
}

/* Term i of the product of two series. */
static double product_term(const struct polynomial *a, const struct polynomial *b, int i)
{
    double sum = 0.0;

    for (int j = 0; j <= i; j++) {
        sum += a->term[j] * b->term[i - j];
    }
    return sum;
}

static void expand_normal(const struct plant *plant, const struct plant_state *state, struct phase *phase)
{
    const struct polynomial load = load_series(plant, state->t_s);
    const bool is_free = plant->contact_kind == CONTACT_LIFT && !state->is_touching;
    const double spring = is_free ? 0.0 : plant->normal_n_per_m;

    phase->y.term[0] = state->y_m;
    phase->w.term[0] = state->w_m_per_s;
    for (int i = 0; i < POLYNOMIAL_DEGREE; i++) {
        const double force =
            load.term[i] - plant->normal_damping_n_s_per_m * phase->w.term[i] - spring * phase->y.term[i];

        phase->y.term[i + 1] = phase->w.term[i] / (i + 1);
        phase->w.term[i + 1] = force / plant->mass_kg / (i + 1);
    }
    phase->force = polynomial_affine(&phase->y, state->is_touching ? plant->normal_n_per_m : 0.0, 0.0);
}

/* Slip: mu |vr| depends on v alone, so friction is a product of two series. */
static void expand_slip(const struct plant *plant, const struct plant_state *state, struct phase *phase)
{
    const double sign = (double)state->mode;
    const double slope = state->is_on_floor ? 0.0 : plant->friction_slope_s_per_m;
    const double stiffness = plant_stiffness_n_per_m(plant);
    struct polynomial friction = {{0.0}}; /* sgn(vr) mu */

    friction.term[0] = sign * (state->is_on_floor ? plant->friction_floor_ratio : plant->friction_static_ratio) +
                       slope * (plant->disc_m_per_s - state->v_m_per_s);
    for (int i = 0; i < POLYNOMIAL_DEGREE; i++) {
        const double push = product_term(&friction, &phase->force, i);
        const double drag = -slope * product_term(&phase->dv, &phase->force, i);

        phase->x.term[i + 1] = phase->v.term[i] / (i + 1);
        phase->dx.term[i + 1] = phase->dv.term[i] / (i + 1);
        phase->v.term[i + 1] = (push - plant->damping_n_s_per_m * phase->v.term[i] - stiffness * phase->x.term[i]) /
                               plant->mass_kg / (i + 1);
        phase->dv.term[i + 1] = (drag - plant->damping_n_s_per_m * phase->dv.term[i] - stiffness * phase->dx.term[i]) /
                                plant->mass_kg / (i + 1);
        friction.term[i + 1] = -slope * phase->v.term[i + 1];
    }
}

struct phase phase_expand(const struct plant *plant, const struct plant_state *state)
{
    struct phase phase = {0};

    phase.mode = state->mode;
    phase.is_touching = state->is_touching;
    phase.x.term[0] = state->x_m;
    phase.v.term[0] = state->v_m_per_s;
    phase.dx.term[0] = state->dx;
    phase.dv.term[0] = state->dv;
    expand_normal(plant, state, &phase);
    if (state->mode == MODE_STICK) {
        phase.x.term[1] = plant->disc_m_per_s;
    } else {
        expand_slip(plant, state, &phase);
    }
    return phase;
}

void phase_evaluate(const struct phase *phase, double t, struct plant_state *state)
{
    state->x_m = polynomial_value(&phase->x, t);
    state->v_m_per_s = polynomial_value(&phase->v, t);
    state->y_m = polynomial_value(&phase->y, t);
    state->w_m_per_s = polynomial_value(&phase->w, t);
    state->dx = polynomial_value(&phase->dx, t);
    state->dv = polynomial_value(&phase->dv, t);
}
