/* A set with everything derived from it. */
#include "base/fixed.h"
#include "base/fmath.h"
#include "sim/sim.h"

static int32_t to_q27(float value) { return fixed_from_float(fmath_min(value, 15.0f), PLANT_FRACTION_BITS); }

static struct detector_config detector_config(const struct params *params, const struct scale *scale)
{
    const struct predictor_response response = predictor_response(params, scale);
    const float length = (float)(1u << scale->length_shift);
    struct detector_config config;

    config.steps_per_period = scale->steps_per_period;
    config.step_q27 = to_q27(scale->step / length);
    config.stiffness_q16 = (uint32_t)(scale->stiffness * length * length * 65536.0f);
    config.gain_q16 = (uint32_t)(fmath_min(response.gain, 8192.0f) * 65536.0f);
    config.load_speed = to_q27(response.load_speed);
    config.load_response = to_q27(response.load_response);
    return config;
}

struct params_problem sim_plan_make(struct sim_plan *plan, const struct params *params, const struct scale *latched)
{
    const struct params_problem problem = scale_derive(params, latched, &plan->scale);

    if (problem.error != ERROR_OK) {
        return problem;
    }
    plan->params = *params;
    plan->arithmetic = (uint8_t)params->arithmetic;
    step_f32_configure(&plan->f32, params, &plan->scale);
    step_q27_configure(&plan->q27, params, &plan->scale);
    acting_of_load(&plan->load, params, &plan->scale);
    acting_of_speed(&plan->speed, params, &plan->scale);
    plan->has_state = plan->load.has_state || plan->speed.has_state;
    texture_derive(&plan->texture, params, &plan->scale);
    plan->load_limit = 1.0f / scale_peak_factor(params);
    plan->load_limit_q27 = to_q27(plan->load_limit);
    watch_configure(&plan->watch, params, &plan->scale);
    plan->detector = detector_config(params, &plan->scale);
    plan->prediction = predictor_predict(params, &plan->scale);
    return problem;
}
