/* Every switching instant is the first negative value of some polynomial. */
#include "switching.h"

#include <math.h>

/* A shortage of grip below this part of the grip is rounding. A pad at rest on a disc at rest needs none, and P touches
 * zero once a period: without this it would slip there. */
static const double grip_noise = 1e-13;

static enum plant_mode sign_of(double value) { return value > 0.0 ? MODE_SLIP_PLUS : MODE_SLIP_MINUS; }

void switching_start(const struct plant *plant, struct plant_state *state)
{
    const double vr = plant->disc_m_per_s - state->v_m_per_s;
    const bool is_pressed = state->y_m > 0.0 || (state->y_m >= 0.0 && state->w_m_per_s >= 0.0);

    state->is_touching = plant->contact_kind == CONTACT_BILATERAL || is_pressed;
    state->vr_zeros = 0;
    if (vr > 0.0 || vr < 0.0) {
        state->mode = sign_of(vr);
    } else {
        const double need = plant_need_n(plant, state);

        state->mode = MODE_STICK;
        if (fabs(need) > plant->friction_static_ratio * plant_force_n(plant, state)) {
            state->mode = sign_of(need);
            state->vr_zeros = 1;
        }
    }
    state->is_on_floor =
        plant_has_floor(plant) && plant_friction_ratio(plant, state->v_m_per_s) < plant->friction_floor_ratio;
}

/* Keeps the earlier of two events. */
static enum switching_event earlier(const struct polynomial *condition, enum switching_event event,
                                    enum switching_event before, double *t)
{
    double when;

    if (!polynomial_first_negative(condition, *t, &when)) {
        return before;
    }
    if (before != EVENT_NONE && when >= *t) {
        return before;
    }
    *t = when;
    return event;
}

static enum switching_event find_meeting(const struct plant *plant, const struct plant_state *state,
                                         const struct phase *phase, double *t)
{
    const double sign = (double)state->mode;
    struct polynomial vr = polynomial_affine(&phase->v, -sign, sign * plant->disc_m_per_s);

    vr = polynomial_deflate(&vr, state->vr_zeros);
    return earlier(&vr, EVENT_MEET, EVENT_NONE, t);
}

static enum switching_event find_floor(const struct plant *plant, const struct plant_state *state,
                                       const struct phase *phase, enum switching_event event, double *t)
{
    const double side = state->is_on_floor ? -1.0 : 1.0;
    const double slope = side * plant->friction_slope_s_per_m * (double)state->mode;
    const double here = plant->friction_static_ratio - plant->friction_floor_ratio;
    struct polynomial above = polynomial_affine(&phase->v, -slope, side * here + slope * plant->disc_m_per_s);

    if (state->is_floor_just_met) {
        above = polynomial_deflate(&above, 1);
    }
    return earlier(&above, EVENT_FLOOR, event, t);
}

static enum switching_event find_break(const struct plant *plant, const struct plant_state *state,
                                       const struct phase *phase, double *t)
{
    const double most = plant->friction_static_ratio * plant_load_max_n(plant);
    const double noise = grip_noise * (most + fabs(plant_need_n(plant, state)));
    enum switching_event event = EVENT_NONE;

    for (int sign = 1; sign >= -1; sign -= 2) {
        struct polynomial spare = polynomial_affine(&phase->force, plant->friction_static_ratio, noise);

        for (int i = 0; i <= POLYNOMIAL_DEGREE; i++) {
            spare.term[i] -= (double)sign * plant_stiffness_n_per_m(plant) * phase->x.term[i];
        }
        spare.term[0] -= (double)sign * plant->damping_n_s_per_m * plant->disc_m_per_s;
        event = earlier(&spare, sign > 0 ? EVENT_LEAVE_PLUS : EVENT_LEAVE_MINUS, event, t);
    }
    return event;
}

enum switching_event switching_find(const struct plant *plant, const struct plant_state *state,
                                    const struct phase *phase, double *t)
{
    enum switching_event event;

    if (state->mode == MODE_STICK) {
        event = find_break(plant, state, phase, t);
    } else {
        event = find_meeting(plant, state, phase, t);
        if (plant_has_floor(plant)) {
            event = find_floor(plant, state, phase, event, t);
        }
    }
    if (plant->contact_kind != CONTACT_BILATERAL) {
        struct polynomial side = polynomial_affine(&phase->y, state->is_touching ? 1.0 : -1.0, 0.0);

        if (state->is_contact_just_met) {
            side = polynomial_deflate(&side, 1);
        }
        event = earlier(&side, EVENT_CONTACT, event, t);
    }
    return event;
}

/* The pad has met the disc's speed. The perturbation dies in sticking; in crossing it changes by the ratio of the
 * accelerations, because the perturbed motion crosses at another instant. */
static void meet(const struct plant *plant, const struct phase *phase, double t, struct plant_state *state)
{
    const struct polynomial acceleration = polynomial_slope(&phase->v);
    const double before = polynomial_value(&acceleration, t);
    const double grip = plant->friction_static_ratio * plant_force_n(plant, state);
    const double need = plant_need_n(plant, state);

    state->v_m_per_s = plant->disc_m_per_s;
    if (fabs(need) <= grip) {
        state->mode = MODE_STICK;
        state->dv = 0.0;
        return;
    }
    state->mode = sign_of(need);
    state->vr_zeros = 1;
    if (before > 0.0 || before < 0.0) {
        state->dv *= ((double)state->mode * grip - need) / plant->mass_kg / before;
    }
}

static void leave(const struct plant *plant, enum plant_mode mode, struct plant_state *state)
{
    state->v_m_per_s = plant->disc_m_per_s;
    state->mode = mode;
    state->vr_zeros = 2;
}

static void pass_zero(const struct plant *plant, struct plant_state *state)
{
    const double need = plant_need_n(plant, state);

    state->y_m = 0.0;
    state->is_touching = state->w_m_per_s > 0.0 || (state->w_m_per_s >= 0.0 && !state->is_touching);
    state->is_contact_just_met = true;
    if (state->mode == MODE_STICK && !state->is_touching && (need > 0.0 || need < 0.0)) {
        state->mode = sign_of(need);
        state->vr_zeros = 1;
    }
}

void switching_apply(const struct plant *plant, enum switching_event event, const struct phase *phase, double t,
                     struct plant_state *state)
{
    state->vr_zeros = 0;
    state->is_floor_just_met = false;
    state->is_contact_just_met = false;
    switch (event) {
    case EVENT_NONE:
        return;
    case EVENT_FLOOR:
        state->is_on_floor = !state->is_on_floor;
        state->is_floor_just_met = true;
        return;
    case EVENT_CONTACT:
        pass_zero(plant, state);
        return;
    case EVENT_MEET:
        meet(plant, phase, t, state);
        break;
    case EVENT_LEAVE_PLUS:
        leave(plant, MODE_SLIP_PLUS, state);
        break;
    case EVENT_LEAVE_MINUS:
        leave(plant, MODE_SLIP_MINUS, state);
        break;
    }
    state->is_on_floor = plant_has_floor(plant) && plant->friction_static_ratio < plant->friction_floor_ratio;
}
