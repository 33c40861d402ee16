/* The pad-disc oscillator in SI units, as the paper prints it (errata mended), with its options:
 *
 *   m x'' + c x' + (k+kt) x = mu(vr) P sgn(vr)      vr = v0 - x'      mu = mu_s + alpha |vr|, not below the floor
 *   m y'' + cn y' + ke y = N(t)                     P = ke y */
#ifndef ORACLE_PLANT_H
#define ORACLE_PLANT_H

#include <stdbool.h>

struct plant {
#define INPUT(field, name) double field;
#define OUTPUT(name)
#include "columns.def"
#undef INPUT
#undef OUTPUT
};

enum plant_load { LOAD_CONSTANT, LOAD_STEP, LOAD_RAMP, LOAD_SINE };

enum plant_contact {
    CONTACT_BILATERAL, /* as printed: P may pull */
    CONTACT_NO_PULL,   /* no friction while y < 0, the y equation unchanged */
    CONTACT_LIFT       /* the normal spring leaves too */
};

enum plant_mode { MODE_SLIP_MINUS = -1, MODE_STICK = 0, MODE_SLIP_PLUS = 1 }; /* the sign of vr */

struct plant_state {
    double t_s, x_m, v_m_per_s, y_m, w_m_per_s;
    double dx, dv; /* perturbation of x and v that travels along, for the Lyapunov exponent */
    enum plant_mode mode;
    bool is_touching;       /* always true for CONTACT_BILATERAL */
    bool is_on_floor;       /* friction is at its floor */
    int vr_zeros;           /* leading terms of vr's series that are zero: 1 after a crossing, 2 after sticking */
    bool is_floor_just_met; /* the condition that changed last is exactly zero now */
    bool is_contact_just_met;
};

double plant_stiffness_n_per_m(const struct plant *plant); /* k + kt: only the sum acts */
double plant_omega_rad_per_s(const struct plant *plant);   /* sqrt(ke/m) */
double plant_period_s(const struct plant *plant);
double plant_fastest_per_s(const struct plant *plant);  /* of all time constants of a smooth phase */
double plant_load_max_n(const struct plant *plant);     /* largest |N| */
double plant_load_settled_s(const struct plant *plant); /* when N has become constant or periodic */
double plant_force_n(const struct plant *plant, const struct plant_state *state); /* P that friction sees */
double plant_need_n(const struct plant *plant, const struct plant_state *state);  /* friction that sticking needs */
bool plant_has_floor(const struct plant *plant);
double plant_friction_ratio(const struct plant *plant, double v_m_per_s); /* mu, without the floor */

#endif
