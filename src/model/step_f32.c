/* One step of the tangential equation: the usual step at once, others in pieces between switches of regime. */
#include "model/step_f32.h"

#include "base/compiler.h"
#include "base/fmath.h"
#include "model/event_f32.h"
#include "model/naive_f32.h"
#include "model/output_f32.h"
#include "model/slip_f32.h"

static uint32_t to_share(float share)
{
    return share >= 1.0f ? PLANT_SHARE_ONE : share > 0.0f ? (uint32_t)(share * (float)PLANT_SHARE_ONE) : 0u;
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
    coeffs->output_length = 1.0f / (float)(1u << scale->length_shift);
    normal_f32_configure(&coeffs->normal, params, scale);
    coeffs->may_be_whole = !coeffs->is_naive && (int)params->contact != CONTACT_LIFT;
    coeffs->is_plain = coeffs->may_be_whole && coeffs->normal.has_phase && !scale->has_floor;
    coeffs->whole = (struct slip_f32_factors){
        .travel = scale->step,
        .spring = scale->step * scale->stiffness,
        .half_stretch = 0.5f * scale->step * scale->step * scale->stiffness,
        .stretch = scale->step * scale->step * scale->stiffness,
        .friction = scale->step * scale->friction,
        .fade = scale->step * scale->friction_slope,
        .drag = scale->step * scale->damping,
        .floor = scale->step * scale->friction_floor,
    };
}

/* Of an unusual step. */
static void report(struct step_f32 *s, const struct step_f32_coeffs *c, const struct plant_notes *notes)
{
    bool is_saturated;

    report_state(s, c);
    is_saturated = s->output.has_notes;
    s->output.has_notes = true;
    s->output.noted = *notes;
    s->output.noted.is_saturated = is_saturated;
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
    report(state, coeffs, &(struct plant_notes){.events = 0u});
}

/* Any other step, piece by piece. */
static BASE_NOINLINE void advance_in_pieces(struct step_f32 *s, const struct step_f32_coeffs *c,
                                            const struct event_f32_attempt *attempt)
{
    struct event_f32_progress progress = {0.0f, 0.0f, 0u, 0u, false, false};
    struct plant_notes notes = {.events = 0u};

    if (c->is_naive) {
        naive_f32_step(s, c);
        progress.slip_minus = s->mode == PLANT_SLIP_MINUS ? 1.0f : 0.0f;
        progress.is_lifted = s->normal.y < 0.0f;
    } else {
        event_f32_step(s, c, &progress, attempt);
    }
    if (attempt == NULL) {
        notes.is_gap_held = normal_f32_close_step(&s->normal, &c->normal);
    } else if (c->normal.has_phase) {
        s->normal.y = attempt->y;
        s->normal.w = attempt->w;
    }
    notes.stick = to_share(progress.stick);
    notes.slip_minus = to_share(progress.slip_minus);
    notes.events = (uint8_t)progress.events;
    notes.is_capped = progress.is_capped;
    notes.is_lifted = progress.is_lifted;
    report(s, c, &notes);
}

/* --- The usual step: whole, without an event ---------------------------------------------------------------------- */

/* The step was tried as a whole, and for a slip up to end, and may hold an event. */
static BASE_NOINLINE void find_event(struct step_f32 *s, const struct step_f32_coeffs *c, float y, float w, float dy,
                                     float dw, const struct slip_f32_end *end)
{
    const struct event_f32_attempt attempt = {y, w, dy, dw, end};

    advance_in_pieces(s, c, &attempt);
}

BASE_INLINE void find_event_in(struct step_f32 *s, const struct step_f32_coeffs *c,
                               const struct normal_f32_piece *piece, bool has_phase, const struct slip_f32_end *end)
{
    if (has_phase) {
        find_event(s, c, piece->y, piece->w, piece->y - s->normal.y, piece->w - s->normal.w, end);
    } else {
        find_event(s, c, piece->y, piece->w, piece->dy, piece->dw, end);
    }
}

/* Moves on to the end of the step and reports it. */
BASE_INLINE void finish(struct step_f32 *s, const struct step_f32_coeffs *c, const struct normal_f32_piece *piece,
                        bool has_phase, bool is_pressed)
{
    if (has_phase) {
        s->normal.y = piece->y;
        s->normal.w = piece->w;
    } else {
        normal_f32_move(&s->normal, piece);
    }
    report_state(s, c);
    if (!is_pressed && s->normal.y < 0.0f) {
        s->output.noted = plant_notes(&s->output);
        s->output.noted.is_lifted = true;
        s->output.has_notes = true;
    }
}

/* May the slip end inside the step? Asked of the signs alone: one way or the other vr is beyond 0 at the end, or on the
 * first tangent. What is not excluded here is for event_f32.c to say. */
BASE_INLINE bool may_cross(float disc, float v, const struct slip_f32_end *end, int32_t mode)
{
    const uint32_t at_end = fmath_bits(disc - end->v);
    const uint32_t on_tangent = fmath_bits(disc - v - end->first);
    const uint32_t turned = (uint32_t)mode; /* all ones where the pad overtakes, and then the signs turn */

    return (int32_t)((at_end ^ turned) | (on_tangent ^ turned)) < 0;
}

BASE_INLINE void slip_whole(struct step_f32 *s, const struct step_f32_coeffs *c, const struct normal_f32_piece *piece,
                            bool has_phase, bool has_floor, bool is_pressed)
{
    const int8_t mode = s->mode;
    struct slip_f32_end end;

    slip_f32_go(&c->whole, s->disc, mode, s->x, s->v, piece, &end, has_floor);
    if (BASE_UNLIKELY(may_cross(s->disc, s->v, &end, mode))) {
        const struct slip_f32_end reached = end;

        find_event_in(s, c, piece, has_phase, &reached);
        return;
    }
    move_x(s, end.dx);
    s->v = end.v;
    finish(s, c, piece, has_phase, is_pressed);
}

/* The step is whole if friction still holds the pad at its end. */
BASE_INLINE void stick_whole(struct step_f32 *s, const struct step_f32_coeffs *c, const struct normal_f32_piece *piece,
                             bool has_phase, bool is_pressed)
{
    const float dx = c->whole.travel * s->disc;
    const float need = stick_need(c, s->x + dx, s->disc);
    const float p = is_pressed ? piece->y : normal_f32_force(&s->normal, piece->y);

    if (BASE_UNLIKELY(!(fmath_abs(need) <= c->whole.friction * p))) {
        find_event_in(s, c, piece, has_phase, NULL);
        return;
    }
    move_x(s, dx);
    finish(s, c, piece, has_phase, is_pressed);
}

/* The contact may pull, or not press: y < 0 now or then. */
BASE_INLINE void advance_whole(struct step_f32 *s, const struct step_f32_coeffs *c, bool has_phase, bool has_floor)
{
    struct normal_f32_piece piece;

    if (has_phase) {
        normal_f32_at(&s->normal, s->normal.phase, &piece.y, &piece.w);
    } else if (c->normal.is_exact) {
        normal_f32_look_end(&s->normal, &c->normal.full, &piece);
    } else {
        normal_f32_look_rk4(&s->normal, &c->normal, c->normal.step, 1.0f, &piece);
    }
    if (s->mode == PLANT_STICK) {
        stick_whole(s, c, &piece, has_phase, false);
        return;
    }
    if (has_phase || c->normal.is_exact) {
        normal_f32_look_middle(&s->normal, &c->normal, &piece);
    }
    normal_f32_press(&s->normal, &piece);
    slip_whole(s, c, &piece, has_phase, has_floor, false);
}

static BASE_NOINLINE void advance_phase_floor(struct step_f32 *s, const struct step_f32_coeffs *c)
{
    advance_whole(s, c, true, true);
}

static BASE_NOINLINE void advance_map(struct step_f32 *s, const struct step_f32_coeffs *c)
{
    advance_whole(s, c, false, false);
}

static BASE_NOINLINE void advance_map_floor(struct step_f32 *s, const struct step_f32_coeffs *c)
{
    advance_whole(s, c, false, true);
}

static BASE_NOINLINE void advance_unpressed(struct step_f32 *s, const struct step_f32_coeffs *c)
{
    advance_whole(s, c, true, false);
}

/* The same for the paper's set and a pad that is pressed on the disc throughout, as signs alone can tell. */
BASE_INLINE void advance_plain(struct step_f32 *s, const struct step_f32_coeffs *c, uint32_t phase)
{
    struct normal_f32_piece piece;

    normal_f32_at(&s->normal, phase, &piece.y, &piece.w);
    if (s->mode == PLANT_STICK) {
        if (BASE_LIKELY((int32_t)fmath_bits(piece.y) >= 0)) {
            stick_whole(s, c, &piece, true, true);
            return;
        }
    } else {
        normal_f32_look_middle(&s->normal, &c->normal, &piece);
        if (BASE_LIKELY((int32_t)(fmath_bits(piece.p1) | fmath_bits(piece.p2) | fmath_bits(piece.p4)) >= 0)) {
            slip_whole(s, c, &piece, true, false, true);
            return;
        }
    }
    advance_unpressed(s, c);
}

/* ------------------------------------------------------------------------------------------------------------------ */

/* Nothing is kept across what is called here, so that no register needs to be saved before it is known what. */
void step_f32_advance(struct step_f32 *state, const struct step_f32_coeffs *coeffs)
{
    const uint32_t phase = normal_f32_open_step(&state->normal, &coeffs->normal);

    if (BASE_LIKELY(coeffs->is_plain)) {
        advance_plain(state, coeffs, phase);
    } else if (!coeffs->may_be_whole) {
        advance_in_pieces(state, coeffs, NULL);
    } else if (coeffs->normal.has_phase) {
        advance_phase_floor(state, coeffs);
    } else if (coeffs->has_floor) {
        advance_map_floor(state, coeffs);
    } else {
        advance_map(state, coeffs);
    }
}

void step_f32_set_input(struct step_f32 *state, const struct step_f32_coeffs *coeffs, struct step_f32_input input)
{
    if (input.load != state->normal.n) {
        normal_f32_set_load(&state->normal, &coeffs->normal, input.load);
    }
    if (input.speed != state->disc) {
        event_f32_set_speed(state, coeffs, input.speed);
    }
}

float step_f32_friction(const struct step_f32 *state, const struct step_f32_coeffs *coeffs)
{
    const float p = normal_f32_force(&state->normal, state->normal.y);

    const float signed_mu = signed_by(state->mode, coeffs->friction) + coeffs->slope * (state->disc - state->v);

    if (state->mode == PLANT_STICK) {
        return coeffs->damping * state->v + coeffs->stiffness * state->x;
    }
    return coeffs->has_floor && signed_by(state->mode, signed_mu) < coeffs->floor
               ? signed_by(state->mode, coeffs->floor) * p
               : signed_mu * p;
}

bool step_f32_is_outside(const struct step_f32 *state)
{
    /* Asked as "is it inside?", so that NaN is outside. */
    return !(fmath_abs(state->v) <= SCALE_FAULT_SPEED && fmath_abs(state->x) <= SCALE_DISPLACEMENT_MAX &&
             fmath_abs(state->normal.y) <= SCALE_NORMAL_MAX && fmath_abs(state->normal.w) <= SCALE_NORMAL_MAX);
}
