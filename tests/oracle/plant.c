/* What follows from the parameters alone. */
#include "plant.h"

#include <math.h>

static const double two_pi = 6.283185307179586;

double plant_stiffness_n_per_m(const struct plant *plant) { return plant->contact_n_per_m + plant->caliper_n_per_m; }

double plant_omega_rad_per_s(const struct plant *plant) { return sqrt(plant->normal_n_per_m / plant->mass_kg); }

double plant_period_s(const struct plant *plant) { return two_pi / plant_omega_rad_per_s(plant); }

double plant_load_max_n(const struct plant *plant)
{
    const double start = fabs(plant->load_n);
    const double end = fabs(plant->load_end_n);

    switch ((enum plant_load)plant->load_kind) {
    case LOAD_STEP:
    case LOAD_RAMP:
        return fmax(start, end);
    case LOAD_SINE:
        return start + end;
    case LOAD_CONSTANT:
        break;
    }
    return start;
}

double plant_load_settled_s(const struct plant *plant)
{
    switch ((enum plant_load)plant->load_kind) {
    case LOAD_STEP:
    case LOAD_SINE:
        return plant->load_start_s;
    case LOAD_RAMP:
        return fmax(plant->load_start_s, plant->load_end_s);
    case LOAD_CONSTANT:
        break;
    }
    return 0.0;
}

double plant_fastest_per_s(const struct plant *plant)
{
    const double damping =
        plant->damping_n_s_per_m + 2.0 * plant_load_max_n(plant) * fabs(plant->friction_slope_s_per_m);
    const double load = plant->load_kind == LOAD_SINE ? two_pi * plant->load_end_s : 0.0;
    double fastest = fmax(plant_omega_rad_per_s(plant), sqrt(plant_stiffness_n_per_m(plant) / plant->mass_kg));

    fastest = fmax(fastest, damping / plant->mass_kg);
    return fmax(fmax(fastest, plant->normal_damping_n_s_per_m / plant->mass_kg), load);
}

double plant_force_n(const struct plant *plant, const struct plant_state *state)
{
    return state->is_touching ? plant->normal_n_per_m * state->y_m : 0.0;
}

double plant_need_n(const struct plant *plant, const struct plant_state *state)
{
    return plant->damping_n_s_per_m * plant->disc_m_per_s + plant_stiffness_n_per_m(plant) * state->x_m;
}

bool plant_has_floor(const struct plant *plant) { return plant->friction_floor_ratio > -1e29; }

double plant_friction_ratio(const struct plant *plant, double v_m_per_s)
{
    return plant->friction_static_ratio + plant->friction_slope_s_per_m * fabs(plant->disc_m_per_s - v_m_per_s);
}
