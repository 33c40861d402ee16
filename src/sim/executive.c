/* Main's side of the executive: orders, credit, demands. The interrupt's is executive_tick.c. */
#include "sim/executive.h"

#include "base/assert.h"
#include "base/mem.h"

bool executive_has_order(const struct executive *executive) { return publish_has_new(&executive->publish); }

/* A plan to look at before it is ordered, in the place of the order that comes next: it is too large for the stack. */
static struct sim_plan *candidate(struct executive *executive)
{
    struct executive_order *order = publish_back(&executive->publish);

    BASE_ASSERT(order != NULL);
    return &order->plan;
}

static void give_order(struct executive *executive)
{
    struct executive_order *order = publish_back(&executive->publish);

    BASE_ASSERT(order != NULL);
    *order = executive->draft;
    (void)publish_commit(&executive->publish);
    executive->draft.is_reset = false;
    executive->draft.is_restore = false;
    executive->draft.is_snapshot = false;
    executive->draft.is_new_plan = false;
    executive->draft.measure_steps = 0u;
}

/* To the candidate. */
static void order_restart(struct executive *executive)
{
    executive->draft.plan = *candidate(executive);
    executive->draft.substeps = (uint32_t)executive->draft.plan.params.steps_per_tick;
    executive_stop(executive);
    executive->draft.is_reset = true;
    executive->draft.is_new_plan = true;
    executive->resets++;
    executive->draft.epoch = (uint8_t)executive->resets;
    executive->scales[executive->draft.epoch & 1u] = executive->draft.plan.scale;
    give_order(executive);
}

struct params_problem executive_reset(struct executive *executive, const struct params *params)
{
    const struct params_problem problem = sim_plan_make(candidate(executive), params, NULL);

    if (problem.error == ERROR_OK) {
        order_restart(executive);
    }
    return problem;
}

void executive_snapshot(struct executive *executive)
{
    executive->draft.is_snapshot = true;
    give_order(executive);
}

struct params_problem executive_restore(struct executive *executive)
{
    const struct params_problem problem = snapshot_check(executive->image, candidate(executive));

    if (problem.error == ERROR_OK) {
        executive->draft.is_restore = true;
        order_restart(executive);
    }
    return problem;
}

struct params_problem executive_set(struct executive *executive, const struct params *params, bool may_reset,
                                    bool *was_reset)
{
    const struct params_info *moved = params_restart_change(&executive->draft.plan.params, params);
    struct params_problem problem = params_check(params);

    if (was_reset != NULL) {
        *was_reset = false;
    }
    if (problem.error != ERROR_OK) {
        return problem;
    }
    if (moved != NULL) {
        if (!may_reset) {
            return (struct params_problem){ERROR_NEEDS_RESTART, moved, 0.0f, 0.0f};
        }
        problem = executive_reset(executive, params);
        if (was_reset != NULL) {
            *was_reset = problem.error == ERROR_OK;
        }
        return problem;
    }
    problem = sim_plan_make(candidate(executive), params, &executive->draft.plan.scale);
    if (problem.error == ERROR_OK) {
        executive->draft.plan = *candidate(executive);
        executive->draft.substeps = (uint32_t)params->steps_per_tick;
        executive->draft.is_new_plan = true;
        give_order(executive);
    }
    return problem;
}

struct params_problem executive_change(struct executive *executive, const struct params *params, bool may_reset,
                                       bool *was_reset)
{
    const bool is_running = executive_wants_tick(executive);
    struct executive_report report;
    struct params_problem problem;

    executive_report(executive, &report);
    if (!is_running && report.now.step == 0u && report.now.is_fault == 0u) {
        problem = executive_reset(executive, params);
        *was_reset = problem.error == ERROR_OK;
        return problem;
    }
    return executive_set(executive, params, may_reset && !is_running, was_reset);
}

void executive_stream(struct executive *executive, uint32_t every)
{
    executive->draft.sample_every = every;
    give_order(executive);
}

void executive_measure(struct executive *executive, uint64_t steps)
{
    executive->draft.measure_steps = steps;
    give_order(executive);
}

/* The interrupt only makes room meanwhile. What is for now needs no place to wait in. */
static bool has_place(const struct executive *executive, const struct input_demand *demand)
{
    return demand->step == INPUT_NOW ||
           word_read(&executive->inputs_queued) + ring_fill(&executive->inputs) < INPUT_QUEUE_MAX;
}

static bool is_safe(const struct executive *executive)
{
    struct executive_report report;

    executive_report(executive, &report);
    return report.now.watch == WATCH_SAFE;
}

enum error executive_input(struct executive *executive, const struct input_demand *demand, bool *is_clamped)
{
    const struct sim_plan *plan = &executive->draft.plan;
    struct input input;
    const bool was_clamped = input_derive(&input, demand, &plan->params, &plan->scale);

    input.epoch = executive->draft.epoch;
    if (!demand->starts && is_safe(executive)) {
        executive->inputs_refused++;
        return ERROR_SAFE_STATE;
    }
    if (!has_place(executive, demand) || !ring_push(&executive->inputs, &input)) {
        executive->inputs_refused++;
        return ERROR_BUSY;
    }
    executive->inputs_clamped += was_clamped ? 1u : 0u;
    if (is_clamped != NULL) {
        *is_clamped = was_clamped;
    }
    return ERROR_OK;
}

void executive_grant(struct executive *executive, uint32_t steps)
{
    const uint32_t used = word_read(&executive->used);
    const uint32_t granted = word_read(&executive->granted);

    /* Less than nothing, after a stop that the interrupt cut in two: start from what was used. */
    word_write(&executive->granted, (granted - used > EXECUTIVE_GRANT_MAX ? used : granted) + steps);
}

enum error executive_free_run(struct executive *executive)
{
    const struct input_demand start = {.step = INPUT_NOW, .starts = true};

    if (is_safe(executive)) {
        const enum error error = executive_input(executive, &start, NULL);

        if (error != ERROR_OK) {
            return error;
        }
        give_order(executive); /* so that it is taken before anything else is asked */
    }
    word_write(&executive->is_free, 1u);
    return ERROR_OK;
}

void executive_stop(struct executive *executive)
{
    word_write(&executive->is_free, 0u);
    word_write(&executive->granted, word_read(&executive->used));
}

void executive_halt(struct executive *executive)
{
    executive_stop(executive);
    give_order(executive);
}

const struct params *executive_params(const struct executive *executive) { return &executive->draft.plan.params; }

const struct sim_plan *executive_plan(const struct executive *executive) { return &executive->draft.plan; }

void executive_report(const struct executive *executive, struct executive_report *report)
{
    const bool has_report = handoff_read(&executive->handoff, report);

    BASE_ASSERT(has_report);
}

const struct scale *executive_scale(const struct executive *executive, uint8_t epoch)
{
    const uint8_t age = (uint8_t)(executive->draft.epoch - epoch);

    return age <= 1u ? &executive->scales[epoch & 1u] : NULL;
}

void executive_init(struct executive *executive, int arithmetic)
{
    struct params params;

    memset(executive, 0, sizeof *executive);
    publish_init(&executive->publish, executive->orders, sizeof executive->orders[0]);
    handoff_init(&executive->handoff, &executive->report_store, sizeof executive->report_store);
    ring_init(&executive->samples, executive->sample_store, sizeof executive->sample_store[0], EXECUTIVE_SAMPLES);
    ring_init(&executive->inputs, executive->input_store, sizeof executive->input_store[0], EXECUTIVE_INPUTS);
    params_default(&params);
    executive->arithmetic = (float)arithmetic;
    params.arithmetic = executive->arithmetic;
    (void)executive_reset(executive, &params); /* the defaults pass their own check: tested */
    (void)executive_tick(executive, false);
}
