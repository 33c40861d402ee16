/* The linear normal oscillator in integers, by RK4 or in closed form. */
#include "model/normal_q27.h"

#include "model/plant.h"

#define TWO_PI_Q58 INT64_C(0x1921FB54442D1847)

enum {
    TERMS_MAX = 9,
    TERMS_SMALL = 7, /* enough for STEP_SMALL */
    RECIPROCAL_BITS = 30,
    GAP_MAX_Q27 = (int)PLANT_GAP_MAX << PLANT_FRACTION_BITS
};

#define STEP_SMALL 429496730 /* 0.1 in Q32 */

/* 1/k in Q30; [0] is not used. */
static const int32_t reciprocal[TERMS_MAX + 1] = {0,         1073741824, 536870912, 357913941, 268435456,
                                                  214748365, 178956971,  153391689, 134217728, 119304647};

/* Sums of products in 64 bits, for what is made once. */
static int64_t wide_times(int64_t value, int64_t factor, unsigned bits) { return fixed_round_up(value * factor, bits); }

/* One column of a map over t (Q32), less the identity, in Q32: what becomes of w, and of the acceleration first/t. */
static void make_column(int32_t damping_t, int32_t t, int64_t w, int64_t first, int32_t *y_end, int32_t *w_end)
{
    const int64_t t2 = wide_times(t, t, 32u);
    int64_t e[TERMS_MAX + 1] = {0, w, first};
    int64_t velocity, travel;

    for (unsigned k = 3u; k <= TERMS_MAX; k++) {
        e[k] = -fixed_round_up(damping_t * e[k - 1u] + t2 * e[k - 2u], 32u);
    }
    velocity = travel = e[TERMS_MAX];
    for (unsigned k = TERMS_MAX - 1u; k >= 2u; k--) {
        velocity = e[k] + wide_times(velocity, reciprocal[k], RECIPROCAL_BITS);
        travel = e[k] + wide_times(travel, reciprocal[k + 1u], RECIPROCAL_BITS);
    }
    *y_end = (int32_t)wide_times(w + fixed_round_up(travel, 1u), t, 32u);
    *w_end = (int32_t)velocity;
}

static struct normal_q27_map make_map(int32_t damping_t, int32_t t)
{
    struct normal_q27_map map;

    make_column(damping_t, t, 0, -(int64_t)t, &map.yy, &map.wy);
    make_column(damping_t, t, INT64_C(1) << 32, -(int64_t)damping_t, &map.yw, &map.ww);
    return map;
}

/* One column of what RK4 makes of (y - n, w) over a step, in Q32: y at its stages, and the end less the identity. */
struct rk4_column {
    int64_t stage[3], y_end, w_end;
};

static struct rk4_column make_rk4_column(int64_t damping, int64_t h, int64_t d, int64_t w)
{
    const int64_t a1 = -wide_times(h, d, 32u) - wide_times(damping, w, 32u);
    const int64_t w2 = w + fixed_floor(a1, 1u);
    const int64_t y2 = wide_times(h, w, 33u);
    const int64_t a2 = -wide_times(h, d + y2, 32u) - wide_times(damping, w2, 32u);
    const int64_t w3 = w + fixed_floor(a2, 1u);
    const int64_t y3 = wide_times(h, w2, 33u);
    const int64_t a3 = -wide_times(h, d + y3, 32u) - wide_times(damping, w3, 32u);
    const int64_t y4 = wide_times(h, w3, 32u);
    const int64_t a4 = -wide_times(h, d + y4, 32u) - wide_times(damping, w + a3, 32u);

    return (struct rk4_column){{y2, y3, y4},
                               wide_times(h, w + wide_times(a1 + a2 + a3, SUM_Q27_SIXTH, 32u), 32u),
                               wide_times(a1 + 2 * (a2 + a3) + a4, SUM_Q27_SIXTH, 32u)};
}

static void make_rk4(struct normal_q27_coeffs *coeffs)
{
    const struct rk4_column d = make_rk4_column(coeffs->damping, coeffs->step, INT64_C(1) << 32, 0);
    const struct rk4_column w = make_rk4_column(coeffs->damping, coeffs->step, 0, INT64_C(1) << 32);

    coeffs->second = (struct normal_q27_row){(int32_t)d.stage[0], (int32_t)w.stage[0]};
    coeffs->third = (struct normal_q27_row){(int32_t)d.stage[1], (int32_t)w.stage[1]};
    coeffs->fourth = (struct normal_q27_row){(int32_t)d.stage[2], (int32_t)w.stage[2]};
    coeffs->full = (struct normal_q27_map){(int32_t)d.y_end, (int32_t)w.y_end, (int32_t)d.w_end, (int32_t)w.w_end};
}

int64_t normal_q27_step(const struct scale *scale, unsigned bits)
{
    const unsigned log2_steps = fixed_bits(scale->steps_per_period) - 1u;

    return fixed_shift_right(TWO_PI_Q58, 58u - bits + log2_steps);
}

void normal_q27_configure(struct normal_q27_coeffs *coeffs, const struct params *params, const struct scale *scale)
{
    coeffs->sixth = SUM_Q27_SIXTH;
    coeffs->step = (int32_t)normal_q27_step(scale, 32u);
    coeffs->damping = fixed_saturate(fixed_times_float(normal_q27_step(scale, 38u), scale->normal_damping, 32 - 38));
    coeffs->phase_stride = SINE_GRID / scale->steps_per_period;
    coeffs->terms = coeffs->step <= STEP_SMALL && coeffs->damping <= STEP_SMALL ? TERMS_SMALL : TERMS_MAX;
    coeffs->contact = (uint8_t)params->contact;
    coeffs->is_exact = (int)params->normal_method == NORMAL_EXACT;
    coeffs->has_phase = coeffs->is_exact && scale->normal_damping == 0.0f && coeffs->contact != CONTACT_LIFT;
    if (coeffs->is_exact) {
        const struct normal_q27_map half = make_map(coeffs->damping / 2, coeffs->step / 2);

        coeffs->full = make_map(coeffs->damping, coeffs->step);
        coeffs->second = coeffs->third = (struct normal_q27_row){half.yy, half.yw};
        coeffs->fourth = (struct normal_q27_row){coeffs->full.yy, coeffs->full.yw};
    } else {
        make_rk4(coeffs);
    }
}

/* What only a change of load or contact can move. Free motion around n never exceeds the amplitude that it began
 * with. */
static void note_change(struct normal_q27 *normal, uint8_t contact)
{
    const int64_t reach = (int64_t)fixed_abs(normal->n) + (int64_t)fixed_abs(normal->w) +
                          (int64_t)fixed_abs(fixed_saturate((int64_t)normal->y - normal->n));
    const bool may_lift = contact == CONTACT_LIFT && !normal->is_steady_from_rest;

    normal->least_force = contact == CONTACT_BILATERAL && !normal->is_steady_from_rest ? -INT32_MAX : 0;
    normal->reach = may_lift ? INT32_MAX : fixed_saturate(reach);
}

static void set_phase(struct normal_q27_phase *phase, int64_t cosine, int64_t sine, bool *is_saturated)
{
    phase->cosine = fixed_saturate_and_tell(cosine, is_saturated);
    phase->sine = fixed_saturate_and_tell(sine, is_saturated);
    phase->minus_cosine = -phase->cosine;
}

void normal_q27_reset(struct normal_q27 *normal, const struct normal_q27_coeffs *coeffs, int32_t y, int32_t w,
                      int32_t n, bool *is_saturated)
{
    normal->y = y;
    normal->w = w;
    normal->n = n;
    normal->phase = (struct normal_q27_phase){0, 0, 0, 0u};
    if (coeffs->has_phase) {
        set_phase(&normal->phase, 2 * ((int64_t)y - n), 2 * (int64_t)w, is_saturated);
    }
    normal->is_lifted = coeffs->contact == CONTACT_LIFT && (y < 0 || (y == 0 && w < 0));
    normal->is_steady_from_rest = y == 0 && w == 0 && n >= 0;
    note_change(normal, coeffs->contact);
}

void normal_q27_set_load(struct normal_q27 *normal, const struct normal_q27_coeffs *coeffs, int32_t n,
                         bool *is_saturated)
{
    const int64_t change = (int64_t)n - normal->n;

    normal->n = n;
    normal->is_steady_from_rest = false;
    note_change(normal, coeffs->contact);
    if (coeffs->has_phase) {
        struct normal_q27_phase *phase = &normal->phase;
        const int64_t sine = sine_quarter_q31[phase->index];
        const int64_t cosine = sine_quarter_q31[SINE_GRID / 4u - phase->index];

        set_phase(phase, phase->cosine - fixed_round_up(change * cosine, 30u),
                  phase->sine - fixed_round_up(change * sine, 30u), is_saturated);
    }
}

/* Part of a step in closed form: a Taylor series over t (Q32), below 2^-29 where its terms end. With e_k = t^(k-1)
 * y^(k) each term is a velocity and undercuts those before it: |e_k| <= 0.40 |e_(k-1)| + 0.16 |e_(k-2)|. MODEL.md has
 * the bounds that follow: no e_k leaves 32 bits, nor does a sum but the last ones. */
static void look_series(const struct normal_q27 *normal, const struct normal_q27_coeffs *coeffs, int32_t t,
                        int32_t damping_t, struct normal_q27_piece *piece, bool *is_saturated)
{
    const int32_t t2 = normal->is_lifted ? 0 : (int32_t)fixed_round_up((int64_t)t * t, 32u);
    const int64_t pull = (int64_t)normal->n - (normal->is_lifted ? 0 : normal->y);
    const unsigned terms = coeffs->terms;
    int32_t e[TERMS_MAX + 1];
    int32_t velocity, travel;
    int64_t mean;

    e[1] = normal->w;
    e[2] = (int32_t)fixed_round_up(t * pull - (int64_t)damping_t * e[1], 32u);
    for (unsigned k = 3u; k <= terms; k++) {
        e[k] = -(int32_t)fixed_round_up((int64_t)damping_t * e[k - 1u] + (int64_t)t2 * e[k - 2u], 32u);
    }
    velocity = travel = e[terms];
    for (unsigned k = terms - 1u; k >= 3u; k--) {
        velocity = e[k] + fixed_part(velocity, reciprocal[k]);
        travel = e[k] + fixed_part(travel, reciprocal[k + 1u]);
    }
    mean = e[1] + fixed_round_up((int64_t)e[2] + fixed_part(travel, reciprocal[3]), 1u);
    piece->y = fixed_saturate_and_tell(normal->y + fixed_round_up(t * mean, 32u), is_saturated);
    piece->w = fixed_saturate_and_tell((int64_t)e[1] + e[2] + fixed_round_up(velocity, 1u), is_saturated);
}

/* t y''. A lifted pad has no spring. */
static int32_t increment(const struct normal_q27 *normal, int32_t step, int32_t damping, int32_t y, int32_t w,
                         bool *is_saturated)
{
    const int64_t pull = (int64_t)normal->n - y;

    return sum_q27(0, step * (normal->is_lifted ? normal->n : pull) - (int64_t)damping * w, 32u, is_saturated);
}

/* Part of a step, or one without the spring, by RK4. */
static void look_rk4(const struct normal_q27 *normal, int32_t sixth, int32_t step, int32_t damping,
                     struct normal_q27_piece *piece, bool *is_saturated)
{
    const int32_t half = step / 2;
    const int32_t y1 = normal->y;
    const int32_t w1 = normal->w;
    const int32_t a1 = increment(normal, step, damping, y1, w1, is_saturated);
    const int32_t y2 = sum_q27_step(y1, half, w1, is_saturated);
    const int32_t w2 = sum_q27_half(w1, a1, is_saturated);
    const int32_t a2 = increment(normal, step, damping, y2, w2, is_saturated);
    const int32_t y3 = sum_q27_step(y1, half, w2, is_saturated);
    const int32_t w3 = sum_q27_half(w1, a2, is_saturated);
    const int32_t a3 = increment(normal, step, damping, y3, w3, is_saturated);
    const int32_t y4 = sum_q27_step(y1, step, w3, is_saturated);
    const int32_t w4 = sum_q27_plain(w1, a3, is_saturated);
    const int32_t a4 = increment(normal, step, damping, y4, w4, is_saturated);
    uint32_t rest = SUM_Q27_NO_REST;
    int32_t mean;

    piece->w = sum_q27_rk4(w1, &rest, sixth, a1, a2, a3, a4, 0u, &mean, is_saturated);
    piece->y = sum_q27_step(y1, step, mean, is_saturated);
    piece->p1 = normal_q27_force(normal, y1);
    piece->p2 = normal_q27_force(normal, y2);
    piece->p3 = normal_q27_force(normal, y3);
    piece->p4 = normal_q27_force(normal, y4);
}

void normal_q27_look_part(const struct normal_q27 *normal, const struct normal_q27_coeffs *coeffs, int32_t fraction,
                          struct normal_q27_piece *piece, bool *is_saturated)
{
    const int32_t t = fixed_part(coeffs->step, fraction);
    const int32_t damping_t = fixed_part(coeffs->damping, fraction);

    if (coeffs->is_exact) {
        look_series(normal, coeffs, t, damping_t, piece, is_saturated);
    } else {
        look_rk4(normal, coeffs->sixth, t, damping_t, piece, is_saturated);
    }
}

void normal_q27_look(const struct normal_q27 *normal, const struct normal_q27_coeffs *coeffs,
                     struct normal_q27_piece *piece, bool *is_saturated)
{
    struct normal_q27_arc arc;

    if (!normal->is_lifted) {
        if (coeffs->has_phase) {
            normal_q27_at(normal, normal->phase.index, &piece->y, &piece->w, is_saturated);
        } else {
            normal_q27_look_end(normal, &coeffs->full, piece, is_saturated);
        }
        normal_q27_look_stages(normal, coeffs, coeffs->is_exact, piece, is_saturated);
        normal_q27_press(normal, piece);
    } else if (!coeffs->is_exact) {
        look_rk4(normal, coeffs->sixth, coeffs->step, coeffs->damping, piece, is_saturated);
    } else {
        look_series(normal, coeffs, coeffs->step, coeffs->damping, piece, is_saturated);
        normal_q27_arc_make(&arc, normal, coeffs, NORMAL_Q27_WHOLE, piece);
        piece->p1 = normal_q27_force(normal, normal->y);
        piece->p2 = normal_q27_force(normal, normal_q27_arc_y(&arc, NORMAL_Q27_WHOLE / 2));
        piece->p3 = piece->p2;
        piece->p4 = normal_q27_force(normal, piece->y);
    }
}

/* No motion bends by more than 3 within a step, unless its end has been saturated, and the plant with it. */
static int32_t within_bend(int64_t value)
{
    return (int32_t)(value > 3 << 27 ? 3 << 27 : value < -(3 << 27) ? -(3 << 27) : value);
}

void normal_q27_arc_make(struct normal_q27_arc *arc, const struct normal_q27 *normal,
                         const struct normal_q27_coeffs *coeffs, int32_t fraction, const struct normal_q27_piece *piece)
{
    const int32_t t = fixed_part_near(coeffs->step, fraction);
    const int32_t slope0 = fixed_sum_of(t, normal->w).high;
    const int32_t slope1 = fixed_sum_of(t, piece->w).high;
    const int64_t rise = (int64_t)piece->y - normal->y;

    arc->y = normal->y;
    arc->slope = slope0;
    arc->square = within_bend(3 * rise - 2 * (int64_t)slope0 - slope1);
    arc->cube = within_bend((int64_t)slope0 + slope1 - 2 * rise);
}

void normal_q27_change_contact(struct normal_q27 *normal)
{
    normal->y = 0;
    normal->is_lifted = normal->w < 0;
}

bool normal_q27_close_step(struct normal_q27 *normal, const struct normal_q27_coeffs *coeffs, bool *is_saturated)
{
    if (coeffs->has_phase) {
        normal_q27_at(normal, normal->phase.index, &normal->y, &normal->w, is_saturated);
    }
    if (normal->is_lifted && normal->y < -GAP_MAX_Q27) {
        normal->y = -GAP_MAX_Q27;
        normal->w = normal->w > 0 ? normal->w : 0;
        return true;
    }
    return false;
}
