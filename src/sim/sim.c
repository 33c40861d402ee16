/* One plant, one step at a time. */
#include "sim/sim.h"

#include "base/compiler.h"
#include "base/fixed.h"
#include "base/fmath.h"
#include "base/hash.h"
#include "sim/extremum.h"

enum { V10_RATIO = 10 };

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

/* --- The two arithmetics ------------------------------------------------------------------------------------------ */

static void renew_texture(struct sim *sim, int32_t disc)
{
    if (texture_begins(&sim->plan->texture, sim->step)) {
        sim->texture = texture_value(&sim->plan->texture, &sim->angle, sim->step, disc);
    }
}

/* A controller's, or the set's. */
BASE_INLINE float load_f32(const struct sim *sim)
{
    return sim->input.holds_load ? sim->input.load : acting_value_f32(&sim->plan->load, &sim->load, sim->step);
}

BASE_INLINE float speed_f32(const struct sim *sim)
{
    return sim->input.holds_speed ? sim->input.speed : acting_value_f32(&sim->plan->speed, &sim->speed, sim->step);
}

BASE_INLINE int32_t load_q27(const struct sim *sim)
{
    return sim->input.holds_load ? sim->input.load_q27 : acting_value_q27(&sim->plan->load, &sim->load, sim->step);
}

BASE_INLINE int32_t speed_q27(const struct sim *sim)
{
    return sim->input.holds_speed ? sim->input.speed_q27 : acting_value_q27(&sim->plan->speed, &sim->speed, sim->step);
}

/* Load and speed held over the step to come. */
static struct step_f32_input input_f32(struct sim *sim)
{
    const struct sim_plan *plan = sim->plan;
    struct step_f32_input input = {.load = load_f32(sim), .speed = speed_f32(sim)};

    if (plan->texture.is_active) {
        renew_texture(sim, (int32_t)(input.speed * (float)(1 << PLANT_FRACTION_BITS))); /* the speed is within 1 */
        input.load = texture_load_f32(input.load, sim->texture);
    }
    return input;
}

static struct step_q27_input input_q27(struct sim *sim)
{
    const struct sim_plan *plan = sim->plan;
    struct step_q27_input input = {.load = load_q27(sim), .speed = speed_q27(sim)};

    if (plan->texture.is_active) {
        renew_texture(sim, input.speed);
        input.load = texture_load_q27(input.load, sim->texture);
    }
    return input;
}

/* What a controller holds is where lag and inertia go on from. */
static BASE_NOINLINE void follow_f32(struct sim *sim)
{
    const struct sim_plan *plan = sim->plan;

    if (sim->input.holds_load) {
        acting_take_f32(&sim->load, sim->input.load);
    } else {
        acting_advance_f32(&plan->load, &sim->load, sim->step, 0.0f);
    }
    if (sim->input.holds_speed) {
        acting_take_f32(&sim->speed, sim->input.speed);
    } else {
        acting_advance_f32(&plan->speed, &sim->speed, sim->step, step_f32_friction(&sim->f32, &plan->f32));
    }
}

static void follow_q27(struct sim *sim)
{
    const struct sim_plan *plan = sim->plan;

    if (sim->input.holds_load) {
        acting_take_q27(&sim->load, sim->input.load_q27);
    } else {
        acting_advance_q27(&plan->load, &sim->load, sim->step, 0);
    }
    if (sim->input.holds_speed) {
        acting_take_q27(&sim->speed, sim->input.speed_q27);
    } else {
        acting_advance_q27(&plan->speed, &sim->speed, sim->step, step_q27_friction(&sim->q27, &plan->q27));
    }
}

/* The step is made: what has a state of its own goes on. */
static BASE_NOINLINE void follow(struct sim *sim)
{
    if (sim->plan->arithmetic == ARITH_Q27) {
        follow_q27(sim);
    } else {
        follow_f32(sim);
    }
}

/* A lag or an inertia that a set brings goes on from what acts now, without the dither, which the set puts on top again. */
static bool begins_to_follow(const struct acting *before, const struct acting *after)
{
    return (after->has_lag && !before->has_lag) || (after->kind == DEMAND_INERTIA && before->kind != DEMAND_INERTIA);
}

static void hand_over_f32(struct sim *sim, bool follows_load, bool follows_speed)
{
    const struct sim_plan *plan = sim->plan;

    if (follows_load) {
        acting_take_f32(&sim->load,
                        sim->input.holds_load ? sim->input.load : acting_base_f32(&plan->load, &sim->load, sim->step));
    }
    if (follows_speed) {
        acting_take_f32(&sim->speed, sim->input.holds_speed ? sim->input.speed
                                                            : acting_base_f32(&plan->speed, &sim->speed, sim->step));
    }
}

static void hand_over_q27(struct sim *sim, bool follows_load, bool follows_speed)
{
    const struct sim_plan *plan = sim->plan;

    if (follows_load) {
        acting_take_q27(&sim->load, sim->input.holds_load ? sim->input.load_q27
                                                          : acting_base_q27(&plan->load, &sim->load, sim->step));
    }
    if (follows_speed) {
        acting_take_q27(&sim->speed, sim->input.holds_speed ? sim->input.speed_q27
                                                            : acting_base_q27(&plan->speed, &sim->speed, sim->step));
    }
}

static void hand_over(struct sim *sim, const struct sim_plan *plan)
{
    const bool follows_load = begins_to_follow(&sim->plan->load, &plan->load);
    const bool follows_speed = begins_to_follow(&sim->plan->speed, &plan->speed);

    if (plan->arithmetic == ARITH_Q27) {
        hand_over_q27(sim, follows_load, follows_speed);
    } else {
        hand_over_f32(sim, follows_load, follows_speed);
    }
}

static void reset_plant(struct sim *sim)
{
    const struct sim_plan *plan = sim->plan;

    if (plan->arithmetic == ARITH_Q27) {
        step_q27_reset(&sim->q27, &plan->q27, &plan->params, &plan->scale, input_q27(sim));
        step_q27_report(&sim->q27, &sim->output);
    } else {
        step_f32_reset(&sim->f32, &plan->f32, &plan->params, &plan->scale, input_f32(sim));
        step_f32_report(&sim->f32, &plan->f32, &sim->output);
    }
}

/* Whatever leaves the domain leaves the output's range first, but for the speed, which has a limit inside it. */
static bool may_be_outside(const struct plant_output *output)
{
    return output->is_saturated ||
           fixed_abs(output->v) > (uint32_t)(SCALE_FAULT_SPEED * (float)(1 << PLANT_FRACTION_BITS)) - 1u;
}

/* Returns false when the plant has left its domain. */
static bool advance_plant(struct sim *sim)
{
    const struct sim_plan *plan = sim->plan;

    if (plan->arithmetic == ARITH_Q27) {
        step_q27_advance(&sim->q27, &plan->q27, input_q27(sim), &sim->output);
        return !step_q27_is_outside(&sim->q27);
    }
    step_f32_advance(&sim->f32, &plan->f32, input_f32(sim), &sim->output);
    return !may_be_outside(&sim->output) || !step_f32_is_outside(&sim->f32);
}

/* The states as words, in the order in which they are hashed. */
static void state_words(const struct sim *sim, uint32_t words[4])
{
    if (sim->plan->arithmetic == ARITH_Q27) {
        words[0] = (uint32_t)sim->q27.x;
        words[1] = (uint32_t)sim->q27.v;
        words[2] = (uint32_t)sim->q27.normal.y;
        words[3] = (uint32_t)sim->q27.normal.w;
    } else {
        words[0] = fmath_bits(sim->f32.x);
        words[1] = fmath_bits(sim->f32.v);
        words[2] = fmath_bits(sim->f32.normal.y);
        words[3] = fmath_bits(sim->f32.normal.w);
    }
}

static void sample_forces(const struct sim *sim, struct sample *sample)
{
    if (sim->plan->arithmetic == ARITH_Q27) {
        sample->load = (uint32_t)sim->q27.normal.n;
        sample->disc = (uint32_t)sim->q27.disc;
        sample->friction = (uint32_t)step_q27_friction(&sim->q27, &sim->plan->q27);
    } else {
        sample->load = fmath_bits(sim->f32.normal.n);
        sample->disc = fmath_bits(sim->f32.disc);
        sample->friction = fmath_bits(step_f32_friction(&sim->f32, &sim->plan->f32));
    }
}

/* --- The same for both -------------------------------------------------------------------------------------------- */

void sim_reset(struct sim *sim, const struct sim_plan *plan)
{
    sim->plan = plan;
    sim->step = 0u;
    sim->hash = HASH_INIT;
    sim->fault = SIM_FAULT_NONE;
    sim->has_v10 = false;
    sim->counters = (struct sim_counters){0};
    sim->measure = (struct measure){0};
    sim->angle = (struct texture_angle){0};
    sim->texture = 0;
    sim->input = (struct input_state){0};
    sim->watch = (struct watch){0};
    sim->safe_load = 0.0f;
    sim->safe_load_q27 = 0;
    acting_reset(&sim->load, &plan->load);
    acting_reset(&sim->speed, &plan->speed);
    reset_plant(sim);
    detector_reset(&sim->detector, &plan->detector, &sim->output);
}

/* A sine of the load explains nothing while a controller holds the load. */
static struct detector_config detector_config_now(const struct sim *sim)
{
    struct detector_config config = sim->plan->detector;

    if (sim->input.holds_load) {
        config.load_speed = 0;
        config.load_response = 0;
    }
    return config;
}

static void lower(float *load, int32_t *load_q27, const struct sim_plan *plan)
{
    *load = plan->load_limit;
    *load_q27 = plan->load_limit_q27;
}

static bool is_held(const struct sim *sim) { return sim->input.holds_load || sim->input.holds_speed; }

void sim_apply(struct sim *sim, const struct sim_plan *plan)
{
    struct detector_config config;

    hand_over(sim, plan);
    sim->plan = plan;
    config = detector_config_now(sim);
    if (sim->input.holds_load && sim->input.load > plan->load_limit) {
        lower(&sim->input.load, &sim->input.load_q27, plan);
        sim->counters.lowered++;
    }
    if (sim->safe_load > plan->load_limit) {
        lower(&sim->safe_load, &sim->safe_load_q27, plan);
    }
    watch_follow(&sim->watch, &plan->watch, is_held(sim));
    detector_restart(&sim->detector, &config);
}

void sim_input(struct sim *sim, const struct input *input)
{
    const bool is_demand = input->sets_load || input->sets_speed;
    const bool is_safe = sim->watch.state == WATCH_SAFE;

    if (is_safe && !input->starts) {
        sim->counters.inputs_void++;
        return;
    }
    sim->counters.inputs += is_demand ? 1u : 0u;
    sim->counters.inputs_late += is_demand && input->step != INPUT_NOW && input->step < sim->step ? 1u : 0u;
    input_take(&sim->input, input);
    if (is_safe || is_demand) {
        watch_hear(&sim->watch, &sim->plan->watch, is_held(sim));
    }
    sim->detector.config = detector_config_now(sim);
}

/* From here on the force that acts, the controller's or the profile's, is on its way to 0. */
static void begin_safe_state(struct sim *sim)
{
    struct input_state *input = &sim->input;

    if (!input->holds_load && sim->plan->arithmetic == ARITH_Q27) {
        input->load_q27 = load_q27(sim);
        input->load = (float)input->load_q27 / (float)(1 << PLANT_FRACTION_BITS);
    } else if (!input->holds_load) {
        input->load = load_f32(sim);
        input->load_q27 = to_q27(input->load);
    }
    input->holds_load = true;
    sim->safe_load = input->load;
    sim->safe_load_q27 = input->load_q27;
}

static void lower_safe_load(struct sim *sim)
{
    const int32_t share = watch_share_q30(&sim->watch);

    sim->input.load = sim->safe_load * ((float)share * (1.0f / 1073741824.0f));
    sim->input.load_q27 = fixed_product(sim->safe_load_q27, share, 30u);
}

void sim_watch(struct sim *sim, const struct watch_pace *pace)
{
    const uint8_t before = sim->watch.state;

    if (sim->fault != SIM_FAULT_NONE) {
        return;
    }
    watch_advance(&sim->watch, &sim->plan->watch, pace);
    if (sim->watch.state == WATCH_SAFE) {
        if (before != WATCH_SAFE) {
            begin_safe_state(sim);
        }
        lower_safe_load(sim);
    }
    if (sim->watch.state != before) {
        const struct detector_config config = detector_config_now(sim);

        detector_restart(&sim->detector, &config);
    }
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

static uint32_t hash_state(const struct sim *sim)
{
    uint32_t words[4];
    uint32_t hash = sim->hash;

    state_words(sim, words);
    for (unsigned i = 0u; i < 4u; i++) {
        hash = hash_word(hash, words[i]);
    }
    return hash_word(hash, (uint32_t)(int32_t)sim->output.mode);
}

bool sim_step_unhashed(struct sim *sim)
{
    const int32_t v_before = sim->output.v;
    bool has_verdict;
    bool is_inside;

    if (sim->fault != SIM_FAULT_NONE) {
        return false;
    }
    is_inside = advance_plant(sim);
    watch_v10(sim, v_before);
    count(sim);
    if (!is_inside) {
        sim->fault = SIM_FAULT_DOMAIN;
        detector_set_diverged(&sim->detector);
        return true;
    }
    if (sim->plan->has_state) {
        follow(sim);
    }
    sim->step++;
    if (sim->plan->texture.runout != 0) {
        texture_turn(&sim->plan->texture, &sim->angle, sim->output.disc);
    }
    has_verdict = !watch_is_silent(sim->watch.state) ? detector_push(&sim->detector, &sim->output)
                                                     : detector_skip(&sim->detector, &sim->output);
    measure_push(&sim->measure, &sim->output);
    return has_verdict;
}

bool sim_step(struct sim *sim)
{
    const bool has_verdict = sim_step_unhashed(sim);

    if (sim->fault == SIM_FAULT_NONE) {
        sim->hash = hash_state(sim);
    }
    return has_verdict;
}

void sim_resume(struct sim *sim, const struct sim_plan *plan)
{
    sim->plan = plan;
    sim->detector.config = detector_config_now(sim);
}

void sim_measure(struct sim *sim, uint64_t steps)
{
    measure_start(&sim->measure, &sim->output, steps, sim->plan->detector.step_q27);
}

void sim_sample(const struct sim *sim, struct sample *sample)
{
    uint32_t words[4];

    state_words(sim, words);
    sample->step = sim->step;
    sample->x = words[0];
    sample->v = words[1];
    sample->y = words[2];
    sample->w = words[3];
    sample_forces(sim, sample);
    sample->mode = sim->output.mode;
    sample->arithmetic = sim->plan->arithmetic;
    sample->propensity = sim->detector.verdict.propensity;
    sample->is_fault = sim->fault != SIM_FAULT_NONE;
    sample->watch = sim->watch.state;
    sample->hash = sim->hash;
}
