/* What the integer plant steps with, made from a set and its scale. */
#include "model/step_q27.h"

#define FINE_LIMIT (INT64_C(1) << 31) /* 1/2 in Q32 */

/* h value 2^exponent, h exact to 38 bits. */
static int64_t times_step(const struct scale *scale, float value, int exponent)
{
    return fixed_times_float(normal_q27_step(scale, 38u), value, exponent - 38);
}

static void configure_factors(struct slip_q27_factors *f, const struct scale *scale, int bits)
{
    const int64_t friction = times_step(scale, scale->friction, bits);
    const int64_t floor = times_step(scale, scale->friction_floor, bits);

    f->sixth = SUM_Q27_SIXTH;
    f->travel = (int32_t)normal_q27_step(scale, 32u - scale->length_shift);
    f->spring = fixed_saturate(-times_step(scale, scale->stiffness, bits + (int)scale->length_shift));
    f->stretch = (int32_t)fixed_round_up((int64_t)f->spring * f->travel, 32u);
    f->half_stretch = (int32_t)fixed_round_up((int64_t)f->spring * f->travel, 33u);
    f->friction = fixed_saturate(friction);
    f->fade = fixed_saturate(-times_step(scale, scale->friction_slope, bits));
    f->floor = fixed_saturate(floor);
    f->drag = (1 << 26) - times_step(scale, scale->damping, bits + 27);
    f->damp = fixed_saturate(SLIP_Q27_UPPER_UNIT / 2 - times_step(scale, scale->damping, bits));
    f->knee = ((int64_t)f->floor - f->friction) * (1 << 27);
}

/* Does the fine arithmetic serve contact forces up to this many quarters? Where a step starts with |x| and |v| below 2,
 * no increment of it exceeds 4 if none does under |v| <= 10 and |x| <= 2 + 16 travel; MODEL.md has the argument. */
static bool is_fine(const struct scale *scale, int64_t quarters)
{
    const int64_t travel = normal_q27_step(scale, 32u - scale->length_shift);
    const int64_t spring = times_step(scale, scale->stiffness, SLIP_Q27_FINE + (int)scale->length_shift);
    const int64_t slope = times_step(scale, scale->friction_slope, SLIP_Q27_FINE);
    const int64_t fade = slope < 0 ? -slope : slope;
    const int64_t floor = times_step(scale, scale->friction_floor, SLIP_Q27_FINE);
    const int64_t slipping = times_step(scale, scale->friction, SLIP_Q27_FINE) + fade + fade / 16; /* |disc| < 17/16 */
    const int64_t drive = floor > slipping ? floor : slipping;
    const int64_t drag = times_step(scale, scale->damping, SLIP_Q27_FINE) + fade * quarters / 4;

    if (drive >= FINE_LIMIT || drag >= FINE_LIMIT || spring >= FINE_LIMIT || floor <= -FINE_LIMIT) {
        return false;
    }
    return drive * quarters / 4 + 10 * drag + 2 * spring + 16 * fixed_round_up(spring * travel, 32u) <= 8 * FINE_LIMIT;
}

/* How far the normal motion may reach for the fine arithmetic to serve, or 0. The stages of RK4 look ahead by up to
 * 3/5. */
static int32_t fine_reach(const struct scale *scale)
{
    for (int32_t quarters = 16; quarters > 0; quarters /= 2) {
        if (is_fine(scale, quarters)) {
            return quarters * (1 << 25) / 8 * 5;
        }
    }
    return 0;
}

static void configure_ways(struct step_q27_coeffs *coeffs)
{
    const bool has_phase = coeffs->normal.has_phase;

    coeffs->ways[1 + PLANT_SLIP_MINUS] = STEP_Q27_TAME;
    coeffs->ways[1 + PLANT_STICK] = coeffs->has_floor ? STEP_Q27_TAME
                                    : has_phase       ? STEP_Q27_STICK_PHASE
                                                      : STEP_Q27_STICK_MAP;
    coeffs->ways[1 + PLANT_SLIP_PLUS] = coeffs->has_floor ? STEP_Q27_TAME
                                        : has_phase       ? STEP_Q27_SLIP_PHASE
                                                          : STEP_Q27_SLIP_MAP;
}

void step_q27_configure(struct step_q27_coeffs *coeffs, const struct params *params, const struct scale *scale)
{
    normal_q27_configure(&coeffs->normal, params, scale);
    configure_factors(&coeffs->wide, scale, SLIP_Q27_WIDE);
    configure_factors(&coeffs->fine, scale, SLIP_Q27_FINE);
    coeffs->drag = fixed_saturate(-times_step(scale, scale->damping, SLIP_Q27_WIDE));
    coeffs->has_floor = scale->has_floor;
    coeffs->is_naive = (int)params->tangential_method == METHOD_NAIVE;
    coeffs->reach_max = coeffs->is_naive ? 0 : fine_reach(scale);
    configure_ways(coeffs);
    coeffs->stiffness = fixed_from_float(scale->stiffness, PLANT_FRACTION_BITS + (int)scale->length_shift);
    coeffs->friction = fixed_from_float(scale->friction, PLANT_FRACTION_BITS);
    coeffs->slope = fixed_from_float(scale->friction_slope, PLANT_FRACTION_BITS);
    coeffs->floor = fixed_from_float(scale->friction_floor, PLANT_FRACTION_BITS);
    coeffs->damping_q24 = fixed_from_float(scale->damping, 24);
}
