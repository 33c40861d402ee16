/* One step of the tangential equation: the usual step at once, others in pieces between switches of regime. */
#include "model/step_f32.h"

#include "base/compiler.h"
#include "base/fmath.h"
#include "model/event_f32.h"
#include "model/naive_f32.h"
#include "model/output_f32.h"
#include "model/slip_f32.h"

static uint32_t to_share(float part, float whole)
{
    const float share = part / whole;

    return share >= 1.0f ? PLANT_SHARE_ONE : share > 0.0f ? (uint32_t)(share * (float)PLANT_SHARE_ONE) : 0u;
}

void step_f32_report(const struct step_f32 *s, const struct step_f32_coeffs *c, struct plant_output *output)
{
    *output = (struct plant_output){0};
    report_state(s, c, output);
}

static void report_progress(const struct step_f32_coeffs *c, const struct event_f32_progress *progress,
                            struct plant_output *output)
{
    output->stick = progress->stick > 0.0f ? to_share(progress->stick, c->normal.step) : 0u;
    output->slip_minus = progress->slip_minus > 0.0f ? to_share(progress->slip_minus, c->normal.step) : 0u;
    output->events = (uint8_t)progress->events;
    output->is_capped = progress->is_capped;
    output->is_lifted = progress->is_lifted;
}

void step_f32_configure(struct step_f32_coeffs *coeffs, const struct params *params, const struct scale *scale)
{
    coeffs->damping = scale->damping;
    coeffs->stiffness = scale->stiffness;
    coeffs->friction = scale->friction;
    coeffs->slope = scale->friction_slope;
    coeffs->floor = scale->friction_floor;
    coeffs->has_floor = scale->has_floor;
    coeffs->is_naive = (int)params->tangential_method == METHOD_NAIVE;
    coeffs->may_be_plain = !coeffs->is_naive && (int)params->contact != CONTACT_LIFT;
    coeffs->output_length = 1.0f / (float)(1u << scale->length_shift);
    normal_f32_configure(&coeffs->normal, params, scale);
}

void step_f32_reset(struct step_f32 *state, const struct step_f32_coeffs *coeffs, const struct params *params,
                    const struct scale *scale, struct step_f32_input first)
{
    state->x = params->x_initial_m / scale->length_m;
    state->x_rest = 0.0f;
    state->v = params->xd_initial_m_per_s / scale->speed_m_per_s;
    normal_f32_reset(&state->normal, &coeffs->normal, params->y_initial_m / scale->normal_m,
                     params->yd_initial_m_per_s / (scale->normal_m * scale->omega_rad_per_s), first.load);
    state->disc = state->v;
    state->mode = PLANT_SLIP_PLUS;
    event_f32_set_speed(state, coeffs, first.speed);
}

/* The usual step: no switch of regime, no change of contact. False, and nothing done, where there is more to it. */
BASE_INLINE bool plain_step(struct step_f32 *s, const struct step_f32_coeffs *c, struct plant_output *output)
{
    const float h = c->normal.step;
    struct normal_f32_piece piece;
    struct slip_end end;

    normal_f32_look(&s->normal, &c->normal, h, true, &piece);
    if (s->mode == PLANT_STICK) {
        int8_t side;

        end = (struct slip_end){s->disc * h, s->v};
        if (stick_spare(s, c, s->x + end.dx, normal_f32_force(&s->normal, piece.y), &side) < 0.0f) {
            return false;
        }
    } else {
        const float a1 = acceleration(c, s->disc, s->mode, s->x, s->v, piece.p1);

        slip(s, c, &piece, h, a1, &end);
        if (!stays_clear(signed_by(s->mode, s->disc - s->v), -signed_by(s->mode, a1) * h,
                         signed_by(s->mode, s->disc - end.v))) {
            return false;
        }
    }
    move_x(s, end.dx);
    s->v = end.v;
    normal_f32_move(&s->normal, &piece);
    (void)normal_f32_close_step(&s->normal, &c->normal); /* no gap to hold: this pad does not lift */
    report_state(s, c, output);
    output->stick = s->mode == PLANT_STICK ? PLANT_SHARE_ONE : 0u;
    output->slip_minus = s->mode == PLANT_SLIP_MINUS ? PLANT_SHARE_ONE : 0u;
    output->events = 0u;
    output->is_capped = false;
    output->is_lifted = s->normal.y < 0.0f;
    output->is_gap_held = false;
    return true;
}

/* Any other step, piece by piece. */
static BASE_NOINLINE void full_step(struct step_f32 *s, const struct step_f32_coeffs *c, struct plant_output *output)
{
    struct event_f32_progress progress = {c->normal.step, true, 0.0f, 0.0f, 0u, 0u, false, false};
    bool is_gap_held;

    if (c->is_naive) {
        naive_f32_step(s, c);
        progress.slip_minus = s->mode == PLANT_SLIP_MINUS ? c->normal.step : 0.0f;
        progress.is_lifted = s->normal.y < 0.0f;
    } else {
        event_f32_step(s, c, &progress);
    }
    is_gap_held = normal_f32_close_step(&s->normal, &c->normal);
    report_state(s, c, output);
    report_progress(c, &progress, output);
    output->is_gap_held = is_gap_held;
}

void step_f32_advance(struct step_f32 *state, const struct step_f32_coeffs *coeffs, struct step_f32_input input,
                      struct plant_output *output)
{
    if (input.load != state->normal.n) {
        normal_f32_set_load(&state->normal, &coeffs->normal, input.load);
    }
    if (input.speed != state->disc) {
        event_f32_set_speed(state, coeffs, input.speed);
    }
    if (!coeffs->may_be_plain || !plain_step(state, coeffs, output)) {
        full_step(state, coeffs, output);
    }
}

float step_f32_friction(const struct step_f32 *state, const struct step_f32_coeffs *coeffs)
{
    const float p = normal_f32_force(&state->normal, state->normal.y);

    if (state->mode == PLANT_STICK) {
        return coeffs->damping * state->v + coeffs->stiffness * state->x;
    }
    return acceleration(coeffs, state->disc, state->mode, state->x, state->v, p) + coeffs->damping * state->v +
           coeffs->stiffness * state->x;
}

bool step_f32_is_outside(const struct step_f32 *state)
{
    /* Asked as "is it inside?", so that NaN is outside. */
    return !(fmath_abs(state->v) <= SCALE_FAULT_SPEED && fmath_abs(state->x) <= SCALE_DISPLACEMENT_MAX &&
             fmath_abs(state->normal.y) <= SCALE_NORMAL_MAX && fmath_abs(state->normal.w) <= SCALE_NORMAL_MAX);
}
