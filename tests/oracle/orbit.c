/* The walk from piece to piece. */
#include "orbit.h"

#include <math.h>

enum { EVENTS_HERE_MAX = 1000 };

static const double reach = 0.7;      /* longest piece, in units of the fastest time constant */
static const double no_time = 1e-14;  /* of a piece: less than this is no progress */
static const double divergence = 1e6; /* times the disc's speed */
static const double divergence_least = 1e-3;

void orbit_start(struct orbit *orbit, const struct plant *plant)
{
    const double period_s = plant_period_s(plant);

    *orbit = (struct orbit){.plant = plant, .period_s = period_s};
    orbit->step_s = period_s / ceil(period_s * plant_fastest_per_s(plant) / reach);
    orbit->limit_m_per_s = divergence * (fabs(plant->disc_m_per_s) + divergence_least);
    orbit->state.x_m = plant->x_initial_m;
    orbit->state.v_m_per_s = plant->xd_initial_m_per_s;
    orbit->state.y_m = plant->y_initial_m;
    orbit->state.w_m_per_s = plant->yd_initial_m_per_s;
    orbit->state.dx = 1.0;
    switching_start(plant, &orbit->state);
}

static bool is_bounded(const struct orbit *orbit)
{
    return fabs(orbit->state.x_m) < 1e200 && fabs(orbit->state.v_m_per_s) <= orbit->limit_m_per_s;
}

bool orbit_advance(struct orbit *orbit, double until_s, struct orbit_piece *piece)
{
    struct plant_state *state = &orbit->state;
    const bool was_stick = state->mode == MODE_STICK;
    const double stop_s = fmin(until_s, phase_next_break_s(orbit->plant, state->t_s));
    const bool reaches_stop = stop_s - state->t_s <= orbit->step_s * (1.0 + 1e-9);
    const double length_s = reaches_stop ? stop_s - state->t_s : orbit->step_s;
    enum switching_event event;

    piece->start_s = state->t_s;
    piece->duration_s = length_s;
    piece->phase = phase_expand(orbit->plant, state);
    event = switching_find(orbit->plant, state, &piece->phase, &piece->duration_s);
    phase_evaluate(&piece->phase, piece->duration_s, state);
    state->t_s = event == EVENT_NONE && reaches_stop ? stop_s : state->t_s + piece->duration_s;
    switching_apply(orbit->plant, event, &piece->phase, piece->duration_s, state);
    piece->enters_stick = !was_stick && state->mode == MODE_STICK;

    orbit->events_here = piece->duration_s > no_time * orbit->step_s ? 0 : orbit->events_here + 1;
    orbit->is_stuck = orbit->events_here > EVENTS_HERE_MAX;
    orbit->has_diverged = !is_bounded(orbit);
    return !orbit->is_stuck && !orbit->has_diverged;
}

void orbit_renormalise(struct orbit *orbit)
{
    const double stiffness = plant_stiffness_n_per_m(orbit->plant) / orbit->plant->mass_kg;
    struct plant_state *state = &orbit->state;
    const double length = sqrt(state->dx * state->dx * stiffness + state->dv * state->dv);

    if (length > 0.0 && isfinite(length)) {
        orbit->stretch += log(length);
        state->dx /= length;
        state->dv /= length;
    }
}
