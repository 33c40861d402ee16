/* What a set asks of the brake and of the disc over time, in SI units: one shape for force and speed alike.
 *
 *   base(t) of the profile + offset -> limits -> lag -> + dither
 *
 * Of an inertia, offset and limits are for the speed that it starts with.
 * sim/acting makes values of it, one a step. */
#ifndef MODEL_DEMAND_H
#define MODEL_DEMAND_H

#include "model/params.h"

/* The order of the choices of both `load` and `speed`. */
enum demand_kind {
    DEMAND_CONSTANT,
    DEMAND_STEP,
    DEMAND_RAMP,
    DEMAND_SINE,
    DEMAND_PULSES,
    DEMAND_TABLE,
    DEMAND_INERTIA /* of the speed alone */
};

/* Forces in N, speeds in m/s. */
struct demand {
    enum demand_kind kind;
    float from, to; /* sine: mean and amplitude */
    float start_s, end_s, frequency_hz;
    float rise_s, hold_s, fall_s, every_s;
    float offset, low, high;
    float lag_s, dither, dither_hz;
    const struct params_points *table; /* of the set, which must outlive this */
};

struct demand demand_of_load(const struct params *params);
struct demand demand_of_speed(const struct params *params);

/* A value of the base with its offset, within the limits. */
float demand_limit(const struct demand *demand, float base);

/* What is asked for before anything changes. */
float demand_begin(const struct demand *demand);

/* What it leads to: the last value, a sine's mean, what a pulse holds, standstill of an inertia. */
float demand_end(const struct demand *demand);

/* What the set leads to, N and m/s: an inertia that nothing brakes keeps its speed. [MAIN] */
float demand_load_end_n(const struct params *params);
float demand_speed_end_m_per_s(const struct params *params);

/* Largest magnitude that it reaches, with the dither. */
float demand_peak(const struct demand *demand);

/* Largest magnitude of base and offset before the limits, of what moves on from there. */
float demand_reach(const struct demand *demand);

/* Mass of all pads, seen from the disc's inertia: pads m R^2/J. */
float demand_inertia_ratio(const struct params *params);

/* Seconds in which an inertia stands at the latest, if friction is never below half of mu_s and the force stays; 0
 * where there is none, and where nothing brakes it, so that it is not waited for. */
float demand_stop_s(const struct params *params);

/* A set in which force or speed is held, come what may. */
void demand_hold_load(struct params *params, float force_n);
void demand_hold_speed(struct params *params, float speed_m_per_s);

/* Parameters of the two demands that only make sense together. [MAIN] */
struct params_problem demand_check(const struct params *params);

#endif
