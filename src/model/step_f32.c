/* One step of the tangential equation: the usual step at once, others in pieces between switches of regime. */
#include "model/step_f32.h"

#include "base/compiler.h"
#include "base/fmath.h"
#include "model/event_f32.h"
#include "model/naive_f32.h"
#include "model/output_f32.h"
#include "model/slip_f32.h"
#include "model/switch_f32.h"

static uint32_t to_share(float share)
{
    return share >= 1.0f ? PLANT_SHARE_ONE : share > 0.0f ? (uint32_t)(share * (float)PLANT_SHARE_ONE) : 0u;
}

static uint8_t find_way(const struct step_f32 *s, const struct step_f32_coeffs *c)
{
    if (c->path != STEP_F32_PHASE || !s->normal.is_calm || s->mode == PLANT_SLIP_MINUS) {
        return c->path;
    }
    return s->mode == PLANT_STICK ? STEP_F32_STICK_CALM : STEP_F32_SLIP_CALM;
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
    s->way = find_way(s, c);
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
    step_f32_adopt(state, coeffs);
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

/* --- The whole step: tried first wherever it may be without an event ---------------------------------------------- */

/* y moves on to the end of the step, on its grid or by what it changes. */
BASE_INLINE void move_normal(struct step_f32 *s, const struct normal_f32_piece *piece, bool has_phase)
{
    if (has_phase) {
        s->normal.y = piece->y;
        s->normal.w = piece->w;
    } else {
        normal_f32_move(&s->normal, piece);
    }
}

/* The end of a step with a usual event. */
BASE_INLINE void finish_event(struct step_f32 *s, const struct step_f32_coeffs *c, const struct normal_f32_piece *piece)
{
    move_normal(s, piece, c->normal.has_phase);
    s->way = find_way(s, c);
    report_pressed(s, c, true, false, true);
}

/* The step was tried as a whole, up to y and w, and may hold an event: of a slip that was to come to dx and v, and
 * began with the half increment first. In numbers, since a shape would be put together in every step. */
static BASE_NOINLINE void slip_event(struct step_f32 *s, const struct step_f32_coeffs *c, bool may_be_usual, float y,
                                     float w, float dy, float dw, float dx, float v, float first)
{
    const struct normal_f32_piece piece = {.y = y, .w = w, .dy = dy, .dw = dw};
    const struct slip_f32_end end = {dx, v, first, 0.0f};

    if (!may_be_usual) {
        advance_in_pieces(s, c, &(struct event_f32_attempt){y, w, dy, dw, &end});
    } else if (switch_from_slip(s, c, &piece, &end)) {
        finish_event(s, c, &piece);
    } else {
        advance_in_pieces(s, c, NULL);
    }
}

/* The same of a stick. */
static BASE_NOINLINE void stick_event(struct step_f32 *s, const struct step_f32_coeffs *c, bool may_be_usual, float y,
                                      float w, float dy, float dw)
{
    const struct normal_f32_piece piece = {.y = y, .w = w, .dy = dy, .dw = dw};

    if (!may_be_usual) {
        advance_in_pieces(s, c, &(struct event_f32_attempt){y, w, dy, dw, NULL});
    } else if (switch_from_stick(s, c, &piece)) {
        finish_event(s, c, &piece);
    } else {
        advance_in_pieces(s, c, NULL);
    }
}

/* May the slip end inside the step? Asked of the signs alone: vr is beyond 0 at the end, or on the first tangent. What
 * is not excluded here is for event_f32.c to say. */
BASE_INLINE bool may_cross(int8_t side, float disc, const struct slip_f32_end *end)
{
    const float at_end = signed_by(side, disc - end->v);
    const float on_tangent = signed_by(side, disc - end->second - end->first);

    return (int32_t)(fmath_bits(at_end) | fmath_bits(on_tangent)) < 0;
}

/* Does friction hold the pad until the end of the step, where its force is p? */
BASE_INLINE bool is_held(const struct step_f32 *s, const struct step_f32_coeffs *c, float p)
{
    const float need = s->turning.resists + c->whole.spring * (s->x + s->turning.carry);

    return fmath_abs(need) <= c->whole.friction * p;
}

/* Reports a step without an event. */
BASE_INLINE void finish(struct step_f32 *s, const struct step_f32_coeffs *c, bool has_moved, bool is_pressed)
{
    if (BASE_LIKELY(is_pressed)) {
        report_pressed(s, c, has_moved, false, false);
    } else {
        report_unpressed(s, c);
    }
}

BASE_INLINE void slip_whole(struct step_f32 *s, const struct step_f32_coeffs *c, const struct normal_f32_piece *piece,
                            bool has_phase, bool has_floor, bool is_pressed)
{
    struct slip_f32_end end;

    slip_f32_go(&c->whole, slip_f32_drive(&c->whole, s->disc, s->mode), s->mode, s->x, s->v, piece, &end, has_floor);
    if (BASE_UNLIKELY(may_cross(s->mode, s->disc, &end))) {
        slip_event(s, c, is_pressed && !has_floor, piece->y, piece->w, piece->dy, piece->dw, end.dx, end.v, end.first);
        return;
    }
    move_x(s, end.dx);
    s->v = end.v;
    move_normal(s, piece, has_phase);
    finish(s, c, true, is_pressed);
}

BASE_INLINE void stick_whole(struct step_f32 *s, const struct step_f32_coeffs *c, const struct normal_f32_piece *piece,
                             bool has_phase, bool has_floor, bool is_pressed)
{
    if (BASE_UNLIKELY(!is_held(s, c, is_pressed ? piece->y : normal_f32_force(&s->normal, piece->y)))) {
        stick_event(s, c, is_pressed && !has_floor, piece->y, piece->w, piece->dy, piece->dw);
        return;
    }
    move_x(s, s->turning.carry);
    move_normal(s, piece, has_phase);
    finish(s, c, false, is_pressed);
}

BASE_INLINE void advance_whole(struct step_f32 *s, const struct step_f32_coeffs *c, bool has_phase, bool is_exact,
                               bool has_floor)
{
    struct normal_f32_piece piece;
    bool is_pressed;

    if (has_phase) {
        normal_f32_look_phase(&s->normal, &c->normal, s->normal.phase, &piece);
    } else if (is_exact) {
        normal_f32_look_map(&s->normal, &c->normal, &piece);
    } else {
        normal_f32_look_rk4(&s->normal, &c->normal, c->normal.step, c->normal.half_step, 1.0f, &piece);
    }
    is_pressed = (has_phase && s->normal.is_calm) || normal_f32_is_pressed(&piece);
    if (s->mode == PLANT_STICK) {
        stick_whole(s, c, &piece, has_phase, has_floor, is_pressed);
        return;
    }
    if (BASE_UNLIKELY(!is_pressed)) {
        normal_f32_press(&s->normal, &piece);
    }
    slip_whole(s, c, &piece, has_phase, has_floor, is_pressed);
}

static BASE_NOINLINE void advance_phase(struct step_f32 *s, const struct step_f32_coeffs *c)
{
    (void)normal_f32_open_step(&s->normal, &c->normal);
    advance_whole(s, c, true, true, false);
}

static BASE_NOINLINE void advance_rk4(struct step_f32 *s, const struct step_f32_coeffs *c)
{
    advance_whole(s, c, false, false, false);
}

static BASE_NOINLINE void advance_floor(struct step_f32 *s, const struct step_f32_coeffs *c)
{
    (void)normal_f32_open_step(&s->normal, &c->normal);
    advance_whole(s, c, c->normal.has_phase, c->normal.is_exact, true);
}

static BASE_NOINLINE void advance_map(struct step_f32 *s, const struct step_f32_coeffs *c)
{
    advance_whole(s, c, false, true, false);
}

/* --- The paper's set in the usual step: the pad is pressed on the disc throughout, and sticks or slips forward ---- */

static BASE_NOINLINE void slip_calm(struct step_f32 *s, const struct step_f32_coeffs *c)
{
    const uint32_t phase = normal_f32_open_step(&s->normal, &c->normal);
    struct normal_f32_piece piece;
    struct slip_f32_end end;

    normal_f32_look_phase(&s->normal, &c->normal, phase, &piece);
    BASE_BARRIER(); /* what the slip needs is loaded after this, or there are too few registers */
    slip_f32_go(&c->whole, s->turning.drive, PLANT_SLIP_PLUS, s->x, s->v, &piece, &end, false);
    if (BASE_UNLIKELY(may_cross(PLANT_SLIP_PLUS, s->disc, &end))) {
        slip_event(s, c, true, piece.y, piece.w, piece.y - s->normal.y, piece.w - s->normal.w, end.dx, end.v,
                   end.first);
        return;
    }
    move_x(s, end.dx);
    s->v = end.v;
    s->normal.y = piece.y;
    s->normal.w = piece.w;
    report_pressed(s, c, true, true, false);
}

static BASE_NOINLINE void stick_calm(struct step_f32 *s, const struct step_f32_coeffs *c)
{
    const uint32_t phase = normal_f32_open_step(&s->normal, &c->normal);
    struct normal_f32_piece piece;

    normal_f32_look_phase(&s->normal, &c->normal, phase, &piece);
    if (BASE_UNLIKELY(!is_held(s, c, piece.y))) {
        stick_event(s, c, true, piece.y, piece.w, piece.y - s->normal.y, piece.w - s->normal.w);
        return;
    }
    move_x(s, s->turning.carry);
    s->normal.y = piece.y;
    s->normal.w = piece.w;
    report_pressed(s, c, false, true, false);
}

/* ------------------------------------------------------------------------------------------------------------------ */

static BASE_NOINLINE void advance_other(struct step_f32 *s, const struct step_f32_coeffs *c)
{
    switch (s->way) {
    case STEP_F32_PHASE:
        advance_phase(s, c);
        return;
    case STEP_F32_MAP:
        advance_map(s, c);
        return;
    case STEP_F32_FLOOR:
        advance_floor(s, c);
        return;
    default:
        (void)normal_f32_open_step(&s->normal, &c->normal);
        advance_in_pieces(s, c, NULL);
    }
}

/* Nothing is kept across what is called here, so that no register needs to be saved before it is known what. */
void step_f32_advance(struct step_f32 *state, const struct step_f32_coeffs *coeffs)
{
    if (state->way == STEP_F32_SLIP_CALM) {
        slip_calm(state, coeffs);
    } else if (state->way == STEP_F32_STICK_CALM) {
        stick_calm(state, coeffs);
    } else if (state->way == STEP_F32_RK4) {
        advance_rk4(state, coeffs);
    } else {
        advance_other(state, coeffs);
    }
}

void step_f32_adopt(struct step_f32 *state, const struct step_f32_coeffs *coeffs)
{
    struct step_f32_turning *turning = &state->turning;

    turning->carry = coeffs->whole.travel * state->disc;
    turning->drive = slip_f32_drive(&coeffs->whole, state->disc, PLANT_SLIP_PLUS);
    turning->resists = coeffs->whole.drag * state->disc;
    normal_f32_find_calm(&state->normal);
    state->way = find_way(state, coeffs);
}

/* A usual step reports no more than what changes in it. The speed of a sticking pad is the disc's. */
void step_f32_set_input(struct step_f32 *state, const struct step_f32_coeffs *coeffs, struct step_f32_input input)
{
    if (input.load != state->normal.n) {
        normal_f32_set_load(&state->normal, &coeffs->normal, input.load);
        state->way = find_way(state, coeffs);
    }
    if (input.speed != state->disc) {
        event_f32_set_speed(state, coeffs, input.speed);
        state->output.disc = inside_q27(input.speed);
        if (state->mode == PLANT_STICK) {
            state->output.v = state->output.disc;
        }
        state->output.mode = state->mode;
        step_f32_adopt(state, coeffs);
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
