#include "analysis/analysis.h"

#include "analysis/eigen.h"
#include "analysis/floquet.h"
#include "base/fmath.h"

enum { BISECTIONS = 24, PARTS = 256 };

#define INFINITE (fmath_from_bits(0x7f800000u))

static struct analysis_mode in_si(struct eigen eigen, const struct scale *scale)
{
    return (struct analysis_mode){eigen.real * scale->omega_rad_per_s,
                                  eigen.imaginary * scale->omega_rad_per_s / (2.0f * FMATH_PI), eigen.damping_ratio};
}

/* The slope eps n at which slip begins to grow: -C, or less of it in the tongue. It is never beyond -C: there the mean
 * damping is negative, whatever the oscillation. */
static float slope_border(const struct floquet_problem *problem)
{
    struct floquet_problem tried = *problem;
    float stable = 0.0f, grows = -problem->damping;

    for (int i = 0; i < BISECTIONS; i++) {
        tried.slope = 0.5f * (stable + grows);
        if (floquet_rate(&tried) > 0.0f) {
            grows = tried.slope;
        } else {
            stable = tried.slope;
        }
    }
    return grows;
}

static float amplitude_um(const struct perturbation *solution, const struct scale *scale)
{
    float high = -INFINITE, low = INFINITE;

    for (uint32_t i = 0u; i < PARTS; i++) {
        const float x = perturbation_forced(solution, i << 24).x;

        high = fmath_max(high, x);
        low = fmath_min(low, x);
    }
    return 0.5e6f * (high - low) * scale->length_m;
}

static void find_forced(struct analysis *analysis, const struct params *params, const struct scale *scale)
{
    struct perturbation solution;

    analysis->has_forced = perturbation_is_served(params, scale) && analysis->floquet_per_s < 0.0f;
    for (unsigned order = 0u; order <= PERTURBATION_ORDER_MAX && analysis->has_forced; order++) {
        perturbation_derive(&solution, params, scale, PERTURBATION_CORRECTED, order);
        analysis->forced_um[order] = amplitude_um(&solution, scale);
    }
    analysis->has_forced =
        analysis->has_forced && perturbation_speed(&solution) * scale->speed_m_per_s < fmath_abs(params->speed_m_per_s);
}

static void find_borders(struct analysis *analysis, const struct predictor_finish *finish, const struct scale *scale,
                         const struct floquet_problem *problem)
{
    const float border = slope_border(problem);

    analysis->load_n = finish->load * scale->load_n;
    analysis->load_border_n = finish->slope < 0.0f ? analysis->load_n * border / finish->slope : INFINITE;
    analysis->alpha_border_s_per_m =
        finish->load > 0.0f ? border / finish->load * scale->force_n / scale->speed_m_per_s / scale->load_n : -INFINITE;
    analysis->load_touch_n =
        analysis->prediction.touch_ratio > 0.0f ? analysis->load_n / analysis->prediction.touch_ratio : INFINITE;
}

void analysis_make(struct analysis *analysis, const struct params *params, const struct scale *scale)
{
    const struct predictor_finish finish = predictor_finish(params, scale);
    const struct floquet_problem problem = {scale->damping, finish.slope, scale->stiffness, finish.share};

    *analysis = (struct analysis){.prediction = predictor_predict(params, scale)};
    analysis->tangential = in_si(eigen_of(scale->damping + finish.slope, scale->stiffness), scale);
    analysis->normal = in_si(eigen_of(scale->normal_damping, 1.0f), scale);
    analysis->floquet_per_s = floquet_rate(&problem) * scale->omega_rad_per_s;
    analysis->closed_per_s = floquet_rate_closed(&problem) * scale->omega_rad_per_s;
    analysis->outer_m_per_s =
        scale->has_floor
            ? INFINITE
            : eigen_outer_speed(scale->friction * finish.load, finish.slope, scale->damping) * scale->speed_m_per_s;
    find_borders(analysis, &finish, scale, &problem);
    find_forced(analysis, params, scale);
}
