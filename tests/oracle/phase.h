/* The Taylor series of one smooth phase: between two switchings the plant is linear with analytic coefficients. */
#ifndef ORACLE_PHASE_H
#define ORACLE_PHASE_H

#include "plant.h"
#include "polynomial.h"

struct phase {
    enum plant_mode mode;
    bool is_touching;
    struct polynomial x, v, y, w, force; /* force: P that friction sees */
    struct polynomial dx, dv;
};

/* The series around a state, exact to rounding for fastest * t below 1 or so. */
struct phase phase_expand(const struct plant *plant, const struct plant_state *state);

/* The first instant after t at which N or its slope jumps; infinite if none. */
double phase_next_break_s(const struct plant *plant, double t_s);

/* The state at the time t of the phase, with the mode and the flags unchanged. */
void phase_evaluate(const struct phase *phase, double t, struct plant_state *state);

#endif
