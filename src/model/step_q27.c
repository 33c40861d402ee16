/* One step of the tangential equation in integers: the usual step at once, others in pieces between switches of
 * regime. */
#include "model/step_q27.h"

#include "model/event_q27.h"
#include "model/naive_q27.h"
#include "model/switch_q27.h"

#define TAME_LIMIT (1u << 28) /* 2 in Q27 */

/* Of an unusual step, but for the notes; a usual one writes its own. */
BASE_INLINE void report(struct step_q27 *s)
{
    struct plant_output *output = &s->output;

    output->x = s->x;
    output->v = s->v;
    output->y = s->normal.y;
    output->w = s->normal.w;
    output->disc = s->disc;
    output->mode = s->mode;
    output->has_notes = true;
}

void step_q27_reset(struct step_q27 *state, const struct step_q27_coeffs *coeffs, const struct params *params,
                    const struct scale *scale, struct step_q27_input first)
{
    const int bits = PLANT_FRACTION_BITS;
    const float normal_speed = scale->normal_m * scale->omega_rad_per_s;
    const int32_t y = fixed_from_float(params->y_initial_m / scale->normal_m, bits);
    const int32_t w = fixed_from_float(params->yd_initial_m_per_s / normal_speed, bits);

    state->x = fixed_from_float(params->x_initial_m / scale->length_m, bits - (int)scale->length_shift);
    state->v = fixed_from_float(params->xd_initial_m_per_s / scale->speed_m_per_s, bits);
    state->is_saturated = fixed_abs(state->x) == INT32_MAX || fixed_abs(state->v) == INT32_MAX ||
                          fixed_abs(y) == INT32_MAX || fixed_abs(w) == INT32_MAX;
    normal_q27_reset(&state->normal, &coeffs->normal, y, w, first.load, &state->is_saturated);
    state->disc = state->v;
    event_q27_enter(state, PLANT_SLIP_PLUS);
    event_q27_set_speed(state, coeffs, first.speed);
    step_q27_adopt(state, coeffs);
    report(state);
    state->output.noted = (struct plant_notes){.is_saturated = state->is_saturated};
}

/* In pieces, if the fine arithmetic does not serve the normal motion. */
BASE_INLINE uint8_t find_way(const struct step_q27 *s, const struct step_q27_coeffs *c)
{
    return s->normal.reach >= c->reach_max ? STEP_Q27_PIECES : c->ways[1 + s->mode];
}

/* The end of an unusual step. */
static BASE_NOINLINE void settle(struct step_q27 *s, const struct step_q27_coeffs *c)
{
    s->way = find_way(s, c);
    report(s);
}

static BASE_NOINLINE void advance_in_pieces(struct step_q27 *s, const struct step_q27_coeffs *c,
                                            const struct event_q27_attempt *attempt)
{
    struct event_q27_progress progress = {.contacts = 0u};

    if (c->is_naive) {
        naive_q27_step(s, c, &progress.notes);
    } else {
        event_q27_step(s, c, &progress, attempt);
    }
    if (attempt == NULL) {
        progress.notes.is_gap_held = normal_q27_close_step(&s->normal, &c->normal, &s->is_saturated);
    }
    settle(s, c);
    s->output.noted = progress.notes;
    s->output.noted.is_saturated = s->is_saturated;
}

/* --- The usual step: whole, without an event, everything within the bounds of the fine arithmetic ----------------- */

/* The step was tried as a whole, up to y, w and for a slip up to end, and may hold events. */
static BASE_NOINLINE void find_events(struct step_q27 *s, const struct step_q27_coeffs *c, int32_t y, int32_t w,
                                      const struct slip_q27_end *end)
{
    const struct event_q27_attempt attempt = {y, w, end};

    advance_in_pieces(s, c, &attempt);
}

/* A function of its own, for the sake of those many steps that find none. */
static BASE_NOINLINE void find_release(struct step_q27 *s, const struct step_q27_coeffs *c, int32_t y, int32_t w)
{
    if (BASE_LIKELY(switch_q27_release(s, c, y, w))) {
        settle(s, c);
    } else {
        find_events(s, c, y, w, NULL);
    }
}

/* The end of a whole step, x and v as given: forward or not, the same state as seen from here. */
BASE_INLINE void finish(struct step_q27 *s, int8_t mode, const struct normal_q27_piece *piece, bool is_usual)
{
    struct plant_output *output = &s->output;

    normal_q27_move(&s->normal, piece);
    output->x = s->x;
    output->v = s->v;
    output->y = piece->y;
    output->w = piece->w;
    output->mode = mode;
    output->has_notes = false;
    if (!is_usual && piece->y < 0) {
        output->noted = plant_notes(output);
        output->noted.is_lifted = true;
        output->has_notes = true;
    }
}

/* Is the pad pressed on the disc throughout, as signs alone can tell? */
BASE_INLINE bool is_pressing(const struct normal_q27_piece *piece)
{
    return (piece->p1 | piece->p2 | piece->p3 | piece->p4 | piece->y) >= 0;
}

/* An event may lie in the step, where this test does not exclude it, which is that of event_q27.c: a curve that stays
 * above its first tangent stays above 0 when the tangent does. */
BASE_INLINE void slip_whole(struct step_q27 *s, const struct step_q27_coeffs *c, const struct normal_q27_piece *piece,
                            bool is_exact, bool has_floor, bool is_turned, bool is_usual)
{
    struct slip_q27_view view = {s->x, s->v, s->disc, s->turning.drive};
    struct slip_q27_end end;

    if (is_turned) {
        view = (struct slip_q27_view){-s->x, -s->v, -s->disc, slip_q27_drive(&c->fine, -s->disc, NULL)};
    }
    slip_q27_go_fine(&c->fine, &view, &s->rest, piece, &end, is_exact, has_floor);
    if (BASE_UNLIKELY(end.v > view.disc || (view.disc - view.v <= end.first && view.v < view.disc))) {
        const struct slip_q27_end reached = end;

        if (!has_floor && (is_usual || is_pressing(piece)) && switch_q27_cross(s, c, piece->y, piece->w, &reached)) {
            settle(s, c);
        } else {
            find_events(s, c, piece->y, piece->w, &reached);
        }
        return;
    }
    s->x = is_turned ? -end.x : end.x;
    s->v = is_turned ? -end.v : end.v;
    s->rest = end.rest;
    finish(s, is_turned ? PLANT_SLIP_MINUS : PLANT_SLIP_PLUS, piece, is_usual);
}

/* The step is whole if friction still holds the pad at its end. */
BASE_INLINE void stick_whole(struct step_q27 *s, const struct step_q27_coeffs *c, const struct normal_q27_piece *piece,
                             bool is_usual)
{
    const int32_t x = s->x + s->turning.carry;
    const int32_t p = is_usual ? piece->y : normal_q27_force(&s->normal, piece->y);

    if (BASE_UNLIKELY(!event_q27_is_held_surely(s, c, x, p))) {
        if (is_usual) {
            find_release(s, c, piece->y, piece->w);
        } else {
            find_events(s, c, piece->y, piece->w, NULL);
        }
        return;
    }
    s->x = x;
    finish(s, PLANT_STICK, piece, is_usual);
}

/* The end of the step, or all of it, from the integer phase or by the one-step map. */
BASE_INLINE void look_end(const struct step_q27 *s, const struct step_q27_coeffs *c, bool has_phase,
                          struct normal_q27_piece *piece)
{
    if (has_phase) {
        normal_q27_at(&s->normal, s->normal.phase.index, &piece->y, &piece->w, NULL);
    } else {
        normal_q27_look_end(&s->normal, &c->normal.full, piece, NULL);
    }
}

/* The contact may pull, or not press: y < 0 now or then. */
BASE_INLINE void advance_tame_by(struct step_q27 *s, const struct step_q27_coeffs *c, bool has_phase, bool is_exact,
                                 bool has_floor)
{
    struct normal_q27_piece piece;

    look_end(s, c, has_phase, &piece);
    if (s->mode == PLANT_STICK) {
        stick_whole(s, c, &piece, false);
        return;
    }
    normal_q27_look_stages(&s->normal, &c->normal, is_exact, &piece, NULL);
    normal_q27_press(&s->normal, &piece);
    slip_whole(s, c, &piece, is_exact, has_floor, s->mode < 0, false);
}

static BASE_NOINLINE void advance_tame_phase(struct step_q27 *s, const struct step_q27_coeffs *c)
{
    advance_tame_by(s, c, true, true, c->has_floor);
}

static BASE_NOINLINE void advance_tame_map(struct step_q27 *s, const struct step_q27_coeffs *c)
{
    advance_tame_by(s, c, false, false, false);
}

static BASE_NOINLINE void advance_tame_floor(struct step_q27 *s, const struct step_q27_coeffs *c)
{
    advance_tame_by(s, c, false, false, true);
}

static BASE_NOINLINE void advance_tame(struct step_q27 *s, const struct step_q27_coeffs *c)
{
    if (c->normal.has_phase) {
        advance_tame_phase(s, c);
    } else if (c->has_floor) {
        advance_tame_floor(s, c);
    } else {
        advance_tame_map(s, c);
    }
}

/* --- The same for a pad that does not overtake the disc and is pressed on it, as signs alone can tell, no floor --- */

BASE_INLINE void stick_by(struct step_q27 *s, const struct step_q27_coeffs *c, bool has_phase)
{
    struct normal_q27_piece piece;

    look_end(s, c, has_phase, &piece);
    if (BASE_LIKELY(piece.y >= 0)) {
        stick_whole(s, c, &piece, true);
    } else {
        advance_tame(s, c);
    }
}

BASE_INLINE void slip_by(struct step_q27 *s, const struct step_q27_coeffs *c, bool has_phase)
{
    struct normal_q27_piece piece;

    look_end(s, c, has_phase, &piece);
    normal_q27_look_stages(&s->normal, &c->normal, has_phase, &piece, NULL);
    if (BASE_LIKELY(is_pressing(&piece))) {
        slip_whole(s, c, &piece, has_phase, false, false, true);
    } else {
        advance_tame(s, c);
    }
}

static BASE_NOINLINE void stick_phase(struct step_q27 *s, const struct step_q27_coeffs *c) { stick_by(s, c, true); }
static BASE_NOINLINE void stick_map(struct step_q27 *s, const struct step_q27_coeffs *c) { stick_by(s, c, false); }
static BASE_NOINLINE void slip_phase(struct step_q27 *s, const struct step_q27_coeffs *c) { slip_by(s, c, true); }
static BASE_NOINLINE void slip_map(struct step_q27 *s, const struct step_q27_coeffs *c) { slip_by(s, c, false); }

/* --- Which of them ------------------------------------------------------------------------------------------------ */

static BASE_NOINLINE void advance_other(struct step_q27 *s, const struct step_q27_coeffs *c)
{
    if (s->way == STEP_Q27_SLIP_MAP) {
        slip_map(s, c);
    } else if (s->way == STEP_Q27_STICK_MAP) {
        stick_map(s, c);
    } else if (s->way == STEP_Q27_TAME) {
        advance_tame(s, c);
    } else {
        advance_in_pieces(s, c, NULL);
    }
}

/* |x| and |v| below 2. */
BASE_INLINE bool is_tame(const struct step_q27 *s)
{
    return (((uint32_t)s->x + TAME_LIMIT) | ((uint32_t)s->v + TAME_LIMIT)) < 2u * TAME_LIMIT;
}

/* ------------------------------------------------------------------------------------------------------------------ */

/* Nothing is kept across what is called here, so that no register needs to be saved before it is known what. */
void step_q27_advance(struct step_q27 *state, const struct step_q27_coeffs *coeffs)
{
    normal_q27_open_step(&state->normal, &coeffs->normal);
    if (BASE_UNLIKELY(!is_tame(state))) {
        advance_in_pieces(state, coeffs, NULL);
    } else if (state->way == STEP_Q27_SLIP_PHASE) {
        slip_phase(state, coeffs);
    } else if (state->way == STEP_Q27_STICK_PHASE) {
        stick_phase(state, coeffs);
    } else {
        advance_other(state, coeffs);
    }
}

void step_q27_set_input(struct step_q27 *state, const struct step_q27_coeffs *coeffs, struct step_q27_input input)
{
    if (input.load != state->normal.n) {
        normal_q27_set_load(&state->normal, &coeffs->normal, input.load, &state->is_saturated);
        state->way = find_way(state, coeffs);
    }
    if (input.speed != state->disc) {
        event_q27_set_speed(state, coeffs, input.speed);
        state->output.disc = input.speed;
        step_q27_adopt(state, coeffs);
    }
}

void step_q27_adopt(struct step_q27 *state, const struct step_q27_coeffs *coeffs)
{
    struct step_q27_turning *turning = &state->turning;

    turning->carry = fixed_product(coeffs->wide.travel, state->disc, 32u);
    turning->drive = coeffs->reach_max > 0 ? slip_q27_drive(&coeffs->fine, state->disc, NULL) : 0;
    turning->resists = fixed_sum_of(coeffs->drag, state->disc);
    state->way = find_way(state, coeffs);
}

int32_t step_q27_friction(const struct step_q27 *state, const struct step_q27_coeffs *coeffs)
{
    const int32_t p = normal_q27_force(&state->normal, state->normal.y);
    const int32_t sign = state->mode;
    int32_t size;
    int64_t ratio;

    if (sign == PLANT_STICK) {
        return fixed_saturate(fixed_shift_right((int64_t)coeffs->damping_q24 * state->v, 24u) +
                              fixed_shift_right((int64_t)coeffs->stiffness * state->x, 27u));
    }
    ratio = coeffs->friction + fixed_shift_right(coeffs->slope * sign * ((int64_t)state->disc - state->v), 27u);
    if (coeffs->has_floor && ratio < coeffs->floor) {
        ratio = coeffs->floor;
    }
    size = fixed_saturate(fixed_shift_right((int64_t)fixed_saturate(ratio) * p, 27u));
    return sign < 0 ? -size : size;
}
