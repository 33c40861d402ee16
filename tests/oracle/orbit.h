/* One orbit of the plant, phase by phase: each step covers a piece of time in which one Taylor series holds. */
#ifndef ORACLE_ORBIT_H
#define ORACLE_ORBIT_H

#include "switching.h"

struct orbit {
    const struct plant *plant;
    struct plant_state state;
    double period_s;
    double step_s;        /* longest piece */
    double stretch;       /* sum of the logarithms by which the perturbation was stretched */
    double limit_m_per_s; /* |v| above it is divergence */
    bool has_diverged;
    bool is_stuck;   /* events without end at one instant: the model has no solution the method can follow */
    int events_here; /* events since time last moved */
};

/* A piece of the orbit: the series hold over [0, duration] after start. */
struct orbit_piece {
    double start_s;
    double duration_s;
    bool enters_stick; /* at its end */
    struct phase phase;
};

void orbit_start(struct orbit *orbit, const struct plant *plant);

/* One piece further, at most until the given time. Returns false at the end of the road: diverged or stuck. */
bool orbit_advance(struct orbit *orbit, double until_s, struct orbit_piece *piece);

/* Books the perturbation's length and makes it one again. */
void orbit_renormalise(struct orbit *orbit);

#endif
