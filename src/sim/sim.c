/* One plant, one step at a time. */
#include "sim/sim.h"

#include "base/fixed.h"
#include "base/fmath.h"
#include "base/hash.h"
#include "sim/extremum.h"

enum { V10_RATIO = 10 };

/* Q4.27 of a value above -16, at most 15. */
static int32_t to_q27(float value) { return (int32_t)(fmath_min(value, 15.0f) * (float)(1 << PLANT_FRACTION_BITS)); }

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
    step_f32_configure(&plan->f32, params, &plan->scale);
    profile_load(&plan->load, params, &plan->scale);
    profile_speed(&plan->speed, params, &plan->scale);
    plan->detector = detector_config(params, &plan->scale);
    plan->prediction = predictor_predict(params, &plan->scale);
    return problem;
}

static struct step_f32_input input_of(const struct sim_plan *plan, uint64_t step)
{
    return (struct step_f32_input){profile_value(&plan->load, step), profile_value(&plan->speed, step)};
}

void sim_reset(struct sim *sim, const struct sim_plan *plan)
{
    sim->plan = plan;
    sim->step = 0u;
    sim->hash = HASH_INIT;
    sim->fault = SIM_FAULT_NONE;
    sim->has_v10 = false;
    sim->counters = (struct sim_counters){0};
    sim->measure = (struct measure){0};
    step_f32_reset(&sim->f32, &plan->f32, &plan->params, &plan->scale, input_of(plan, 0u));
    step_f32_report(&sim->f32, &plan->f32, &sim->output);
    detector_reset(&sim->detector, &plan->detector, &sim->output);
}

void sim_apply(struct sim *sim, const struct sim_plan *plan)
{
    sim->plan = plan;
    detector_restart(&sim->detector, &plan->detector);
}

/* The place inside the step is by a straight line: a diverging plant needs many steps to pass the mark. */
static void watch_v10(struct sim *sim, int32_t v_before)
{
    const int64_t limit = (int64_t)fixed_abs(sim->output.disc) * V10_RATIO;
    const uint32_t before = fixed_abs(v_before);
    const uint32_t now = fixed_abs(sim->output.v);

    if (sim->has_v10 || limit == 0 || now <= limit) {
        return;
    }
    sim->has_v10 = true;
    sim->v10_step = sim->step;
    sim->v10_fraction_q15 = before < limit ? extremum_ratio_q15((uint32_t)limit - before, now - before) : 0u;
}

static void count(struct sim *sim)
{
    const struct plant_output *output = &sim->output;

    sim->counters.events += output->events;
    sim->counters.caps += output->is_capped;
    sim->counters.saturations += output->is_saturated;
    sim->counters.lifted += output->is_lifted;
    sim->counters.gap_held += output->is_gap_held;
}

static uint32_t hash_state(uint32_t hash, const struct step_f32 *state)
{
    hash = hash_word(hash, fmath_bits(state->x));
    hash = hash_word(hash, fmath_bits(state->v));
    hash = hash_word(hash, fmath_bits(state->normal.y));
    hash = hash_word(hash, fmath_bits(state->normal.w));
    return hash_word(hash, (uint32_t)(int32_t)state->mode);
}

/* Whatever leaves the domain leaves the output's range first, but for the speed, which has a limit inside it. */
static bool may_be_outside(const struct plant_output *output)
{
    return output->is_saturated ||
           fixed_abs(output->v) > (uint32_t)(SCALE_FAULT_SPEED * (float)(1 << PLANT_FRACTION_BITS)) - 1u;
}

bool sim_step(struct sim *sim)
{
    const int32_t v_before = sim->output.v;
    bool has_verdict;

    if (sim->fault != SIM_FAULT_NONE) {
        return false;
    }
    step_f32_advance(&sim->f32, &sim->plan->f32, input_of(sim->plan, sim->step), &sim->output);
    watch_v10(sim, v_before);
    count(sim);
    if (may_be_outside(&sim->output) && step_f32_is_outside(&sim->f32)) {
        sim->fault = SIM_FAULT_DOMAIN;
        detector_set_diverged(&sim->detector);
        return true;
    }
    sim->step++;
    has_verdict = detector_push(&sim->detector, &sim->output);
    measure_push(&sim->measure, &sim->output);
    sim->hash = hash_state(sim->hash, &sim->f32);
    return has_verdict;
}

void sim_measure(struct sim *sim, uint64_t steps)
{
    measure_start(&sim->measure, &sim->output, steps, sim->plan->detector.step_q27);
}

void sim_sample(const struct sim *sim, struct sample *sample)
{
    sample->step = sim->step;
    sample->x = sim->f32.x;
    sample->v = sim->f32.v;
    sample->y = sim->f32.normal.y;
    sample->w = sim->f32.normal.w;
    sample->load = sim->f32.normal.n;
    sample->disc = sim->f32.disc;
    sample->friction = step_f32_friction(&sim->f32, &sim->plan->f32);
    sample->mode = sim->f32.mode;
    sample->propensity = sim->detector.verdict.propensity;
    sample->is_fault = sim->fault != SIM_FAULT_NONE;
    sample->hash = sim->hash;
}
