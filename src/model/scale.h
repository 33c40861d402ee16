/* From SI parameters to the dimensionless model and back.
 *
 * Inside, time is counted in 1/wn, speed in Vref, length in Vref/wn, brake force in n_max and normal displacement in
 * n_max/ke, with wn = sqrt(ke/m) and Vref = max(v_max, mu_s n_max / sqrt(m ke)). Eq. 20 of the paper then reads
 *
 *     x'' = -C x' - Z2 x + s (mu + eps |vr|) p      vr = v0 - x', s = sgn vr
 *     y'' = n - Cn y' - y                           p = y (contact force), n = N/n_max
 *
 * and nothing in it exceeds a few units, from 0.3 Hz toys to 16 kHz squeal. Derivation: MODEL.md.
 */
#ifndef MODEL_SCALE_H
#define MODEL_SCALE_H

#include <stdbool.h>
#include <stdint.h>

#include "model/params.h"

/* Limits of what the scaled model holds; MODEL.md has the reasons. */
#define SCALE_STEP_MAX 0.40f      /* largest z = h max(1, Z, C, Cn) */
#define SCALE_STIFFNESS_MAX 15.0f /* largest Z2 */
#define SCALE_FRICTION_MAX 8.0f   /* largest mu and |eps| */
#define SCALE_REACH_MAX 15.0f     /* how far a ramp, a sine, pulses or a table may reach beyond the limits, in units */
#define SCALE_RESERVE 4.0f        /* headroom for live changes where N_max or v_max is not given */
#define SCALE_LENGTH_SHIFT_MAX 8u
#define SCALE_UNIT_MIN 1e-30f           /* smallest unit, SI: an initial state in it is still a number */
#define SCALE_ROUGHNESS_PEAK 1.7320508f /* largest over rms of a uniform distribution: sqrt 3 */
#define SCALE_DISPLACEMENT_MAX 4096.0f  /* x beyond it, in the model's units, is outside the domain */
#define SCALE_NORMAL_MAX 64.0f          /* the same of y and y' */
#define SCALE_FAULT_SPEED 10.0f         /* the plant has left its domain beyond this multiple of max(|v0|, Vref) */

struct scale {
    /* one unit of the model in SI */
    float omega_rad_per_s; /* wn; time is in 1/wn */
    float speed_m_per_s;   /* Vref */
    float length_m;        /* Vref/wn */
    float load_n;          /* n_max */
    float normal_m;        /* n_max/ke */
    float force_n;         /* m wn Vref: tangential force */
    float step_s;          /* physical duration of one model step */

    /* dimensionless groups */
    float damping;        /* C = c/sqrt(m ke) */
    float stiffness;      /* Z2 = (kt + k)/ke, beta + gamma of the paper */
    float friction;       /* mu = mu_s n_max/(sqrt(m ke) Vref) */
    float friction_slope; /* eps = alpha n_max/sqrt(m ke) */
    float friction_floor; /* mu_floor in the unit of mu; meaningful if has_floor */
    float normal_damping; /* Cn = cn/sqrt(m ke) */
    bool has_floor;
    uint8_t contact;       /* CONTACT_..., params.h */
    uint32_t length_shift; /* integer readers see x/2^length_shift, so that it fits where Z2 is small */

    uint32_t steps_per_period; /* spp */
    float step;                /* h = 2 pi/spp */
};

/* Derives the scale of a set. With latched, which is the scale since the last reset, the units are kept and what does
 * not fit them is refused; with NULL they are chosen afresh. The ranges of single parameters are checked first. On a
 * problem
 * *scale is left undefined. [MAIN] */
struct params_problem scale_derive(const struct params *params, const struct scale *latched, struct scale *scale);

/* Steps per normal period of a set, 16 ... 1024. [ANY] */
uint32_t scale_steps_per_period(const struct params *params);

/* Largest brake force and disc speed that the set reaches, N and m/s; the force with its roughness and run-out.
 * [MAIN] */
float scale_load_peak_n(const struct params *params);
float scale_speed_peak_m_per_s(const struct params *params);

/* How far roughness and run-out lift the brake force above its profile; exactly 1 without them. [ANY] */
float scale_peak_factor(const struct params *params);

/* Relative amplitude that RK4 takes from an undamped normal oscillation in one period: 2 pi h^5/144. [ANY] */
float scale_rk4_loss_per_period(const struct scale *scale);

#endif
