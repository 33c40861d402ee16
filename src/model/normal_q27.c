/* The linear normal oscillator in integers, by RK4 or in closed form. */
#include "model/normal_q27.h"

#include "model/plant.h"

#define TWO_PI_Q58 INT64_C(0x1921FB54442D1847)

enum { TERMS = 9, RECIPROCAL_BITS = 30, GAP_MAX_Q27 = (int)PLANT_GAP_MAX << PLANT_FRACTION_BITS };

/* 1/k in Q30; [0] is not used. */
static const int32_t reciprocal[TERMS + 1] = {0,         1073741824, 536870912, 357913941, 268435456,
                                              214748365, 178956971,  153391689, 134217728, 119304647};

/* Where a Taylor series stands: in any one unit of at most 2^32, wider than the states so that it also makes the maps. */
struct motion {
    int64_t y, w;
};

static int64_t times_q32(int32_t factor, int64_t value) { return fixed_round_up(factor * value, 32u); }
static int64_t times_reciprocal(unsigned k, int64_t value) { return fixed_round_up(value * reciprocal[k], RECIPROCAL_BITS); }

/* Series of order 9 over t (Q32): below 2^-29 for the largest step of 0.4. With e_k = t^(k-1) y^(k) each term is a
 * velocity that the next one undercuts, whatever the damping (t Cn <= 0.4). Returns the motion at t, and y at t/2. */
static struct motion taylor(int32_t damping_t, int64_t spring, int64_t n, int32_t t, struct motion start,
                            int64_t *middle)
{
    const int32_t t2 = (int32_t)times_q32(t, t);
    int64_t e[TERMS + 1];
    int64_t w, travel, half_travel;

    e[1] = start.w;
    e[2] = times_q32(t, n - spring * start.y) - times_q32(damping_t, e[1]);
    for (unsigned k = 3u; k <= TERMS; k++) {
        e[k] = -times_q32(damping_t, e[k - 1u]) - spring * times_q32(t2, e[k - 2u]);
    }
    w = travel = half_travel = e[TERMS];
    for (unsigned k = TERMS - 1u; k >= 1u; k--) {
        w = e[k] + times_reciprocal(k, w);
        travel = e[k] + times_reciprocal(k + 1u, travel);
        half_travel = e[k] + times_reciprocal(k + 1u, fixed_round_up(half_travel, 1u));
    }
    *middle = start.y + fixed_round_up(times_q32(t, half_travel), 1u);
    return (struct motion){start.y + times_q32(t, travel), w};
}

/* Column by column: the answers to a unit force from rest, where y - n = -1, and to a unit velocity; less the identity. */
static struct normal_q27_map make_map(int32_t damping_t, int32_t t)
{
    const int64_t one = INT64_C(1) << 32;
    int64_t middle;
    const struct motion pressed = taylor(damping_t, 1, one, t, (struct motion){0, 0}, &middle);
    const struct motion pushed = taylor(damping_t, 1, 0, t, (struct motion){0, one}, &middle);

    return (struct normal_q27_map){(int32_t)-pressed.y, (int32_t)pushed.y, (int32_t)-pressed.w,
                                   (int32_t)(pushed.w - one)};
}

int64_t normal_q27_step(const struct scale *scale, unsigned bits)
{
    const unsigned log2_steps = fixed_bits(scale->steps_per_period) - 1u;

    return fixed_shift_right(TWO_PI_Q58, 58u - bits + log2_steps);
}

void normal_q27_configure(struct normal_q27_coeffs *coeffs, const struct params *params, const struct scale *scale)
{
    coeffs->step = (int32_t)normal_q27_step(scale, 32u);
    coeffs->damping = fixed_saturate(fixed_times_float(normal_q27_step(scale, 38u), scale->normal_damping, 32 - 38));
    coeffs->phase_stride = SINE_GRID / scale->steps_per_period;
    coeffs->contact = (uint8_t)params->contact;
    coeffs->is_exact = (int)params->normal_method == NORMAL_EXACT;
    coeffs->has_phase = coeffs->is_exact && scale->normal_damping == 0.0f && coeffs->contact != CONTACT_LIFT;
    coeffs->full = make_map(coeffs->damping, coeffs->step);
    coeffs->half = make_map(coeffs->damping / 2, coeffs->step / 2);
}

/* What only a change of load or contact can move. Free motion around n never exceeds the amplitude that it began with. */
static void note_change(struct normal_q27 *normal, uint8_t contact)
{
    const int64_t reach = (int64_t)fixed_abs(normal->n) + (int64_t)fixed_abs(normal->w) +
                          (int64_t)fixed_abs(fixed_saturate((int64_t)normal->y - normal->n));
    const bool may_lift = contact == CONTACT_LIFT && !normal->is_steady_from_rest;

    normal->least_force = contact == CONTACT_BILATERAL && !normal->is_steady_from_rest ? -INT32_MAX : 0;
    normal->reach = may_lift ? INT32_MAX : fixed_saturate(reach);
}

void normal_q27_reset(struct normal_q27 *normal, const struct normal_q27_coeffs *coeffs, int32_t y, int32_t w, int32_t n)
{
    normal->y = y;
    normal->w = w;
    normal->n = n;
    normal->phase = (struct normal_q27_phase){fixed_saturate((int64_t)y - n), w, 0u};
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
        const int64_t sine = sine_quarter_q30[phase->index];
        const int64_t cosine = sine_quarter_q30[SINE_GRID / 4u - phase->index];

        phase->cosine = sum_q27(phase->cosine, -change * cosine, 30u, is_saturated);
        phase->sine = sum_q27(phase->sine, -change * sine, 30u, is_saturated);
    }
}

static void look_part(const struct normal_q27 *normal, int32_t t, int32_t damping_t, struct normal_q27_piece *piece,
                      bool *is_saturated)
{
    const struct motion start = {normal->y, normal->w};
    int64_t middle;
    const struct motion end = taylor(damping_t, normal->is_lifted ? 0 : 1, normal->n, t, start, &middle);

    piece->y = fixed_saturate_and_tell(end.y, is_saturated);
    piece->w = fixed_saturate_and_tell(end.w, is_saturated);
    piece->p1 = normal_q27_force(normal, normal->y);
    piece->p2 = normal_q27_force(normal, fixed_saturate_and_tell(middle, is_saturated));
    piece->p3 = piece->p2;
    piece->p4 = normal_q27_force(normal, piece->y);
}

void normal_q27_look(const struct normal_q27 *normal, const struct normal_q27_coeffs *coeffs, int32_t fraction,
                     bool is_whole, struct normal_q27_piece *piece, bool *is_saturated)
{
    const int32_t t = is_whole ? coeffs->step : fixed_product(coeffs->step, fraction, 30u);
    const int32_t damping_t = is_whole ? coeffs->damping : fixed_product(coeffs->damping, fraction, 30u);

    if (!coeffs->is_exact) {
        normal_q27_look_rk4(normal, t, damping_t, piece, is_saturated);
    } else if (is_whole && !normal->is_lifted) {
        const struct normal_q27_phase next = normal_q27_next(normal->phase, coeffs->phase_stride);

        normal_q27_look_map(normal, coeffs, &next, piece, is_saturated);
    } else {
        look_part(normal, t, damping_t, piece, is_saturated);
    }
}

void normal_q27_change_contact(struct normal_q27 *normal)
{
    normal->y = 0;
    normal->is_lifted = normal->w < 0;
}

bool normal_q27_close_step(struct normal_q27 *normal, const struct normal_q27_coeffs *coeffs, bool *is_saturated)
{
    if (coeffs->has_phase) {
        normal->phase = normal_q27_next(normal->phase, coeffs->phase_stride);
        normal_q27_at(normal->n, &normal->phase, &normal->y, &normal->w, is_saturated);
    }
    if (normal->is_lifted && normal->y < -GAP_MAX_Q27) {
        normal->y = -GAP_MAX_Q27;
        normal->w = normal->w > 0 ? normal->w : 0;
        return true;
    }
    return false;
}
