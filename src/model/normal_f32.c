/* The linear normal oscillator, by RK4 or in closed form. */
#include "model/normal_f32.h"

#include "model/plant.h"
#include "model/sine.h"

/* Taylor series of order 9: below 1e-9 for the largest step of 0.4. It serves parts of a step and both states of
 * contact (spring 1 or 0), with or without damping. Gives the changes of y and w. */
static void taylor(float damping, float spring, float n, float duration, float y, float w, float *dy, float *dw)
{
    const float d1 = w;
    const float d2 = n - damping * d1 - spring * y;
    const float d3 = -damping * d2 - spring * d1;
    const float d4 = -damping * d3 - spring * d2;
    const float d5 = -damping * d4 - spring * d3;
    const float d6 = -damping * d5 - spring * d4;
    const float d7 = -damping * d6 - spring * d5;
    const float d8 = -damping * d7 - spring * d6;
    const float d9 = -damping * d8 - spring * d7;
    const float t = duration;
    const float t2 = t * (1.0f / 2.0f);
    const float t3 = t * (1.0f / 3.0f);
    const float t4 = t * (1.0f / 4.0f);
    const float t5 = t * (1.0f / 5.0f);
    const float t6 = t * (1.0f / 6.0f);
    const float t7 = t * (1.0f / 7.0f);
    const float t8 = t * (1.0f / 8.0f);

    *dw = t * (d2 + t2 * (d3 + t3 * (d4 + t4 * (d5 + t5 * (d6 + t6 * (d7 + t7 * (d8 + t8 * d9)))))));
    *dy = t * (d1 + t2 * (d2 + t3 * (d3 + t4 * (d4 + t5 * (d5 + t6 * (d6 + t7 * (d7 + t8 * d8)))))));
}

/* With U the answer to a unit force from rest and S = U' that to a unit velocity, the map of (y, w) is
 * [1 - U, S; -S, 1 - U - Cn S]. The identity is taken off so that a coefficient's rounding costs only part of a
 * step. */
static struct normal_f32_map make_map(float damping, float duration)
{
    float u;
    float s;

    taylor(damping, 1.0f, 1.0f, duration, 0.0f, 0.0f, &u, &s);
    return (struct normal_f32_map){-u, s, -s, -u - damping * s};
}

void normal_f32_configure(struct normal_f32_coeffs *coeffs, const struct params *params, const struct scale *scale)
{
    coeffs->damping = scale->normal_damping;
    coeffs->step = scale->step;
    coeffs->half_step = NORMAL_F32_HALF * scale->step;
    coeffs->phase_stride = SINE_GRID / scale->steps_per_period;
    coeffs->contact = (uint8_t)params->contact;
    coeffs->is_exact = (int)params->normal_method == NORMAL_EXACT;
    coeffs->has_phase = coeffs->is_exact && scale->normal_damping == 0.0f && coeffs->contact != CONTACT_LIFT;
    coeffs->full = make_map(scale->normal_damping, scale->step);
    coeffs->half = make_map(scale->normal_damping, 0.5f * scale->step);
    coeffs->between = 0.5f / (1.0f + coeffs->half.yy);
}

/* Printed, the contact pulls where y < 0; the other modes know no pull, and neither does the rounding of a touch at
 * 0. */
static float least_force(const struct normal_f32 *normal, const struct normal_f32_coeffs *coeffs)
{
    return coeffs->contact == CONTACT_BILATERAL && !normal->is_steady_from_rest ? -1e30f : 0.0f;
}

/* The sum is the amplitude where the motion comes from rest, and then y touches 0. Otherwise the root of squares leaves
 * room for rounding. */
void normal_f32_find_calm(struct normal_f32 *normal)
{
    const float n = normal->n;
    const float cosine = fmath_abs(normal->cosine);
    const float sine = fmath_abs(normal->sine);

    normal->is_calm = cosine + sine <= n || (n >= 0.0f && cosine * cosine + sine * sine < 0.999f * n * n);
}

void normal_f32_reset(struct normal_f32 *normal, const struct normal_f32_coeffs *coeffs, float y, float w, float n)
{
    normal->y = y;
    normal->w = w;
    normal->y_rest = 0.0f;
    normal->w_rest = 0.0f;
    normal->n = n;
    normal->cosine = y - n;
    normal->sine = w;
    normal->phase = 0u;
    normal->is_lifted = coeffs->contact == CONTACT_LIFT && (y < 0.0f || (y == 0.0f && w < 0.0f));
    normal->is_steady_from_rest = y == 0.0f && w == 0.0f && n >= 0.0f;
    normal->least_force = least_force(normal, coeffs);
    normal_f32_find_calm(normal);
}

void normal_f32_set_load(struct normal_f32 *normal, const struct normal_f32_coeffs *coeffs, float n)
{
    const float change = n - normal->n;

    normal->n = n;
    normal->is_steady_from_rest = false;
    normal->least_force = least_force(normal, coeffs);
    if (coeffs->has_phase) {
        normal->cosine -= change * sine_quarter_f32[SINE_GRID / 4u - normal->phase];
        normal->sine -= change * sine_quarter_f32[normal->phase];
        normal_f32_find_calm(normal);
    }
}

/* Part of a step, or one without the spring, in closed form. */
static void look_series(const struct normal_f32 *normal, const struct normal_f32_coeffs *coeffs, float duration,
                        struct normal_f32_piece *piece)
{
    const float spring = normal->is_lifted ? 0.0f : 1.0f;
    float middle;
    float unused;

    taylor(coeffs->damping, spring, normal->n, 0.5f * duration, normal->y, normal->w, &middle, &unused);
    taylor(coeffs->damping, spring, normal->n, duration, normal->y, normal->w, &piece->dy, &piece->dw);
    piece->y = normal->y + piece->dy;
    piece->w = normal->w + piece->dw;
    piece->p1 = normal_f32_force(normal, normal->y);
    piece->p2 = normal_f32_force(normal, normal->y + middle);
    piece->p3 = piece->p2;
    piece->p4 = normal_f32_force(normal, piece->y);
}

void normal_f32_look(const struct normal_f32 *normal, const struct normal_f32_coeffs *coeffs, float duration,
                     bool is_whole, struct normal_f32_piece *piece)
{
    if (!coeffs->is_exact) {
        normal_f32_look_rk4(normal, coeffs, duration, NORMAL_F32_HALF * duration, normal->is_lifted ? 0.0f : 1.0f,
                            piece);
        normal_f32_press(normal, piece);
    } else if (is_whole && !normal->is_lifted) {
        normal_f32_look_map(normal, coeffs, piece);
        normal_f32_press(normal, piece);
    } else {
        look_series(normal, coeffs, duration, piece);
    }
}

bool normal_f32_close_step(struct normal_f32 *normal, const struct normal_f32_coeffs *coeffs)
{
    if (coeffs->has_phase) {
        normal_f32_at(normal, normal->phase, &normal->y, &normal->w);
        normal->y += normal->n;
    }
    if (normal->is_lifted && normal->y < -PLANT_GAP_MAX) {
        normal->y = -PLANT_GAP_MAX;
        normal->w = normal->w > 0.0f ? normal->w : 0.0f;
        return true;
    }
    return false;
}
