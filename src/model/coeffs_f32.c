/* What the plant in single precision steps with, made from a set and its scale. */
#include "model/step_f32.h"

static uint8_t find_path(const struct step_f32_coeffs *coeffs, const struct params *params)
{
    if (coeffs->is_naive || (int)params->contact == CONTACT_LIFT) {
        return STEP_F32_PIECES;
    }
    if (coeffs->has_floor) {
        return STEP_F32_FLOOR;
    }
    return coeffs->normal.has_phase ? STEP_F32_PHASE : coeffs->normal.is_exact ? STEP_F32_MAP : STEP_F32_RK4;
}

void step_f32_configure(struct step_f32_coeffs *coeffs, const struct params *params, const struct scale *scale)
{
    const float half = NORMAL_F32_HALF * scale->step;

    coeffs->damping = scale->damping;
    coeffs->stiffness = scale->stiffness;
    coeffs->friction = scale->friction;
    coeffs->slope = scale->friction_slope;
    coeffs->floor = scale->friction_floor;
    coeffs->has_floor = scale->has_floor;
    coeffs->is_naive = (int)params->tangential_method == METHOD_NAIVE;
    coeffs->output_length = 1.0f / (float)(1u << scale->length_shift);
    normal_f32_configure(&coeffs->normal, params, scale);
    coeffs->path = find_path(coeffs, params);
    coeffs->whole = (struct slip_f32_factors){
        .travel = scale->step,
        .spring = half * scale->stiffness,
        .stretch = half * half * scale->stiffness,
        .friction = half * scale->friction,
        .fade = half * scale->friction_slope,
        .drag = half * scale->damping,
        .floor = half * scale->friction_floor,
    };
}
