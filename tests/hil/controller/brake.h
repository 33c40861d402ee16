/* What the controller knows of the brake it steers: read over the link before the first turn. */
#ifndef BRAKE_H
#define BRAKE_H

#include <stdint.h>

struct brake {
    float step_s;          /* of the plant's model */
    uint32_t turn_steps;   /* model steps of a turn, the control period */
    float pad_kg;          /* mass of the pad */
    float contact_n_per_m; /* the two springs that hold the pad along the disc */
    float caliper_n_per_m;
    float friction_ratio; /* static friction coefficient */
    float piston_area_m2; /* what pressure acts on */
    float radius_m;       /* of the disc at the pad */
    float tyre_radius_m;
};

static inline float brake_turn_s(const struct brake *brake) { return (float)brake->turn_steps * brake->step_s; }

#endif
