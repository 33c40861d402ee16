/* The manoeuvre: a driver presses, one wheel's share of a vehicle slows down by the brake's torque, and a score is
 * kept.
 *
 *     vehicle speed' = -faces F R / (R_tyre mass)     F: the friction force that the plant reports, held over the turn
 *
 * Nothing else slows it, the wheel does not slip, the road is level. */
#ifndef STOP_H
#define STOP_H

#include <stdbool.h>
#include <stdint.h>

#include "brake.h"
#include "protocol/master.h"

struct stop_settings {
    float speed_m_per_s; /* of the vehicle, at the beginning */
    float mass_kg;       /* of the vehicle, this wheel's share */
    float faces;         /* of the disc that are braked, each by a pad like the plant's */
    float demand_pa;     /* the driver's pressure, ramped up ... */
    float apply_s;       /* ... in this time */
    float limit_s;       /* the end, standstill or not */
};

struct stop {
    float speed_m_per_s;
    uint32_t turns, loud_turns; /* those with squeal among them */
    float friction_ratio;       /* seen last */
    float kept_n_s;             /* impulse of the friction force */
    float demanded_n_s;         /* that it would have had at the driver's pressure */
};

/* A quarter of a car's last metres: 400 kg, 13 bar in 0.1 s. */
struct stop_settings stop_usual(float speed_m_per_s);

struct stop stop_start(const struct stop_settings *settings, const struct brake *brake);

/* Time since its start, s. */
float stop_time_s(const struct stop *stop, const struct brake *brake);

/* The driver's pressure in the turn that comes, Pa. */
float stop_demand_pa(const struct stop_settings *settings, const struct stop *stop, const struct brake *brake);

/* A turn has been made under that demand, and ended in the state. */
struct stop stop_next(const struct stop_settings *settings, const struct stop *now, const struct brake *brake,
                      const struct master_state *state);

/* The vehicle stands, or time is up. */
bool stop_is_over(const struct stop_settings *settings, const struct stop *stop, const struct brake *brake);

/* 0 .. 1: share of the demanded brake torque that was kept; share of the time with squeal. */
float stop_kept_ratio(const struct stop *stop);
float stop_squeal_ratio(const struct stop *stop);

/* How far the pad swings about where friction holds it, m: from its place and speed at one instant, as if the swing
 * were a sine. Friction is taken for steady, which errs by some tenths of it during squeal and by next to nothing in
 * quiet. */
float stop_amplitude_m(const struct brake *brake, const struct master_state *state);

#endif
