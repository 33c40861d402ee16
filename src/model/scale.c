/* The border between SI and the dimensionless model. */
#include "model/scale.h"

#include "base/fmath.h"
#include "model/demand.h"

static const struct params_problem no_problem = {ERROR_OK, NULL, 0.0f, 0.0f};

uint32_t scale_steps_per_period(const struct params *params) { return 16u << (uint32_t)params->steps_per_period; }

float scale_peak_factor(const struct params *params)
{
    return 1.0f + (SCALE_ROUGHNESS_PEAK * params->roughness_ratio + params->runout_ratio);
}

float scale_load_peak_n(const struct params *params)
{
    const struct demand load = demand_of_load(params);

    return demand_peak(&load) * scale_peak_factor(params);
}

float scale_speed_peak_m_per_s(const struct params *params)
{
    const struct demand speed = demand_of_speed(params);

    return demand_peak(&speed);
}

/* Parameters that only make sense together. */
static struct params_problem check_together(const struct params *params)
{
    if (params->safe_s > 0.0f && params->safe_s < params->stale_s) {
        return params_blame(ERROR_OUT_OF_RANGE, "safe", params->stale_s, 1e4f);
    }
    if ((int)params->tangential_method == METHOD_NAIVE && (int)params->normal_method != NORMAL_RK4) {
        return params_blame(ERROR_NOT_SERVED, "method", 0.0f, 0.0f);
    }
    return demand_check(params);
}

static void choose_units(const struct params *params, float impedance, struct scale *scale)
{
    const float load = params->load_max_n > 0.0f ? params->load_max_n : SCALE_RESERVE * scale_load_peak_n(params);
    const float speed =
        params->speed_max_m_per_s > 0.0f ? params->speed_max_m_per_s : SCALE_RESERVE * scale_speed_peak_m_per_s(params);

    /* Without any load the contact still needs a unit: any will do, since n = 0 in all of them. */
    scale->load_n = load > 0.0f ? load : 1.0f;
    scale->speed_m_per_s = fmath_max(speed, params->friction_static_ratio * load / impedance);
}

static void derive_units(const struct params *params, float impedance, struct scale *scale)
{
    scale->omega_rad_per_s = fmath_sqrt(params->stiffness_normal_n_per_m / params->mass_kg);
    scale->length_m = scale->speed_m_per_s / scale->omega_rad_per_s;
    scale->normal_m = scale->load_n / params->stiffness_normal_n_per_m;
    scale->force_n = impedance * scale->speed_m_per_s;
    scale->steps_per_period = scale_steps_per_period(params);
    scale->step = 2.0f * FMATH_PI / (float)scale->steps_per_period;
    scale->step_s = scale->step / scale->omega_rad_per_s;
}

/* Everything is divided by the units, so none may be too small for that. */
static bool has_units(const struct scale *scale)
{
    return scale->speed_m_per_s >= SCALE_UNIT_MIN && scale->length_m >= SCALE_UNIT_MIN &&
           scale->normal_m >= SCALE_UNIT_MIN && scale->normal_m * scale->omega_rad_per_s >= SCALE_UNIT_MIN &&
           scale->force_n >= SCALE_UNIT_MIN;
}

/* A line that the limits cut is known by its ends, which must be numbers of the model, Q4.27. */
static struct params_problem check_lines(const struct params *params, const struct scale *scale)
{
    const struct demand load = demand_of_load(params);
    const struct demand speed = demand_of_speed(params);
    const float load_n = demand_reach(&load) / SCALE_REACH_MAX;
    const float speed_m_per_s = demand_reach(&speed) / SCALE_REACH_MAX;

    if (load_n > scale->load_n) {
        return params_blame(ERROR_OUT_OF_SCALE, "N_max", load_n, 1e10f);
    }
    if (speed_m_per_s > scale->speed_m_per_s) {
        return params_blame(ERROR_OUT_OF_SCALE, "v_max", speed_m_per_s, 1e4f);
    }
    return no_problem;
}

/* Does what the set can reach lie inside the units? */
/* Does a profile with this choice end with its second value? The choices of force and speed have the same names. */
static bool has_end(float profile)
{
    return (int)profile == LOAD_STEP || (int)profile == LOAD_RAMP || (int)profile == LOAD_PULSES;
}

static struct params_problem check_load_reach(const struct params *params, const struct scale *scale)
{
    const float reach_n = scale_load_peak_n(params);
    const float limit_n = scale->load_n / scale_peak_factor(params);

    if (!(reach_n > scale->load_n)) {
        return no_problem;
    }
    if (params->load_n > limit_n) {
        return params_blame(ERROR_OUT_OF_SCALE, "N0", 0.0f, limit_n);
    }
    if (has_end(params->load_profile) && params->load_end_n > limit_n) {
        return params_blame(ERROR_OUT_OF_SCALE, "N1", 0.0f, limit_n);
    }
    /* It comes of several parameters: the reserve is named. */
    return params_blame(ERROR_OUT_OF_SCALE, "N_max", reach_n, 1e10f);
}

static struct params_problem check_speed_reach(const struct params *params, const struct scale *scale)
{
    const float reach_m_per_s = scale_speed_peak_m_per_s(params);
    const float limit_m_per_s = scale->speed_m_per_s;

    if (!(reach_m_per_s > limit_m_per_s)) {
        return no_problem;
    }
    if (fmath_abs(params->speed_m_per_s) > limit_m_per_s) {
        return params_blame(ERROR_OUT_OF_SCALE, "v0", -limit_m_per_s, limit_m_per_s);
    }
    if (has_end(params->speed_profile) && fmath_abs(params->speed_end_m_per_s) > limit_m_per_s) {
        return params_blame(ERROR_OUT_OF_SCALE, "v1", -limit_m_per_s, limit_m_per_s);
    }
    return params_blame(ERROR_OUT_OF_SCALE, "v_max", reach_m_per_s, 1e4f);
}

static struct params_problem check_fit(const struct params *params, const struct scale *scale)
{
    const float stiffness_max = SCALE_STIFFNESS_MAX / (float)(1u << scale->length_shift);

    struct params_problem problem = check_load_reach(params, scale);

    if (problem.error == ERROR_OK) {
        problem = check_speed_reach(params, scale);
    }
    if (problem.error != ERROR_OK) {
        return problem;
    }
    if (!(scale->stiffness <= stiffness_max)) {
        return params_blame(ERROR_OUT_OF_SCALE, "kt", 0.0f,
                            stiffness_max * params->stiffness_normal_n_per_m - params->stiffness_caliper_n_per_m);
    }
    if (!(scale->friction <= SCALE_FRICTION_MAX)) {
        return params_blame(ERROR_OUT_OF_SCALE, "mu_s", 0.0f,
                            SCALE_FRICTION_MAX / scale->friction * params->friction_static_ratio);
    }
    if (scale->has_floor && !(scale->friction_floor <= SCALE_FRICTION_MAX)) {
        return params_blame(ERROR_OUT_OF_SCALE, "mu_floor", -1e30f,
                            SCALE_FRICTION_MAX / scale->friction_floor * params->friction_floor_ratio);
    }
    if (!(fmath_abs(scale->friction_slope) <= SCALE_FRICTION_MAX)) {
        const float limit =
            SCALE_FRICTION_MAX / fmath_abs(scale->friction_slope) * fmath_abs(params->friction_slope_s_per_m);
        return params_blame(ERROR_OUT_OF_SCALE, "alpha", -limit, limit);
    }
    return no_problem;
}

static struct params_problem check_initial(const char *symbol, float value, float limit)
{
    return fmath_abs(value) <= limit ? no_problem : params_blame(ERROR_OUT_OF_SCALE, symbol, -limit, limit);
}

/* A plant that starts outside its domain could only fault. */
static struct params_problem check_start(const struct params *params, const struct scale *scale)
{
    const float y_max = SCALE_NORMAL_MAX * scale->normal_m;
    struct params_problem problem = check_initial("x0", params->x_initial_m, SCALE_DISPLACEMENT_MAX * scale->length_m);

    if (problem.error == ERROR_OK) {
        problem = check_initial("xd0", params->xd_initial_m_per_s, SCALE_DISPLACEMENT_MAX * scale->speed_m_per_s);
    }
    if (problem.error == ERROR_OK) {
        problem = check_initial("y0", params->y_initial_m, y_max);
    }
    if (problem.error == ERROR_OK) {
        problem = check_initial("yd0", params->yd_initial_m_per_s, y_max * scale->omega_rad_per_s);
    }
    return problem;
}

/* One step must resolve the fastest of the normal and tangential oscillation and of both dampings. */
static struct params_problem check_step(const struct scale *scale)
{
    const float fastest =
        fmath_max(fmath_max(1.0f, fmath_sqrt(scale->stiffness)), fmath_max(scale->damping, scale->normal_damping));

    if (!(scale->step * fastest <= SCALE_STEP_MAX)) {
        return params_blame(ERROR_STEP_TOO_LARGE, "spp", 0.0f, 0.0f);
    }
    return no_problem;
}

static uint32_t length_shift(float stiffness)
{
    uint32_t shift = 0u;

    while (shift < SCALE_LENGTH_SHIFT_MAX && stiffness * (float)(1u << shift) < 0.25f) {
        shift++;
    }
    return shift;
}

static void derive_groups(const struct params *params, float impedance, struct scale *scale)
{
    const float friction_unit = scale->load_n / (impedance * scale->speed_m_per_s);

    scale->damping = params->damping_n_s_per_m / impedance;
    scale->stiffness =
        (params->stiffness_contact_n_per_m + params->stiffness_caliper_n_per_m) / params->stiffness_normal_n_per_m;
    scale->friction = params->friction_static_ratio * friction_unit;
    scale->friction_slope = params->friction_slope_s_per_m * scale->load_n / impedance;
    scale->has_floor = params->friction_floor_ratio > -1e29f;
    scale->friction_floor = scale->has_floor ? params->friction_floor_ratio * friction_unit : 0.0f;
    scale->normal_damping = params->damping_normal_n_s_per_m / impedance;
    scale->contact = (uint8_t)params->contact;
}

struct params_problem scale_derive(const struct params *params, const struct scale *latched, struct scale *scale)
{
    struct params_problem problem = params_check(params);
    const float impedance = fmath_sqrt(params->mass_kg) * fmath_sqrt(params->stiffness_normal_n_per_m);

    if (problem.error == ERROR_OK) {
        problem = check_together(params);
    }
    if (problem.error != ERROR_OK) {
        return problem;
    }
    if (latched != NULL) {
        scale->load_n = latched->load_n;
        scale->speed_m_per_s = latched->speed_m_per_s;
    } else {
        choose_units(params, impedance, scale);
    }
    derive_units(params, impedance, scale);
    if (!has_units(scale)) {
        return (struct params_problem){ERROR_NO_SCALE, NULL, 0.0f, 0.0f};
    }
    derive_groups(params, impedance, scale);
    scale->length_shift = latched != NULL ? latched->length_shift : length_shift(scale->stiffness);

    problem = check_fit(params, scale);
    if (problem.error == ERROR_OK) {
        problem = check_lines(params, scale);
    }
    if (problem.error == ERROR_OK && latched == NULL) {
        problem = check_start(params, scale);
    }
    return problem.error != ERROR_OK ? problem : check_step(scale);
}

float scale_rk4_loss_per_period(const struct scale *scale)
{
    const float h2 = scale->step * scale->step;

    return 2.0f * FMATH_PI / 144.0f * h2 * h2 * scale->step;
}
