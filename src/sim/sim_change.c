/* What comes between two steps: another set, a controller's demand, or its silence. */
#include "base/fixed.h"
#include "sim/sim_parts.h"

/* A lag or an inertia that a set brings goes on from what acts now, without the dither, which the set puts on top
 * again. */
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

static void adopt(struct sim *sim, const struct sim_plan *plan)
{
    sim->plan = plan;
    sim->is_usual = false;
    if (plan->arithmetic == ARITH_Q27) {
        step_q27_adopt(&sim->q27, &plan->q27);
    } else {
        step_f32_adopt(&sim->f32, &plan->f32);
    }
}

void sim_apply(struct sim *sim, const struct sim_plan *plan)
{
    struct detector_config config;

    hand_over(sim, plan);
    adopt(sim, plan);
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
    sim->is_usual = false;
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
        input->load_q27 = sim_load_q27(sim);
        input->load = (float)input->load_q27 / (float)(1 << PLANT_FRACTION_BITS);
    } else if (!input->holds_load) {
        input->load = sim_load_f32(sim);
        input->load_q27 = fixed_from_float(input->load, PLANT_FRACTION_BITS);
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
    sim->is_usual = sim->is_usual && !watch_is_silent(sim->watch.state);
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

void sim_resume(struct sim *sim, const struct sim_plan *plan)
{
    adopt(sim, plan);
    sim->detector.config = detector_config_now(sim);
}
