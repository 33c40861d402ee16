/* Orders, credit and reports between main and the interrupt. */
#include "sim/executive.h"

#include "base/assert.h"
#include "base/mem.h"

enum {
    TICKS_PER_REPORT = 32, /* of a free run without news */
    MAIN_SHARE = 16        /* a tick that leaves main less than this part of its period counts as overrun */
};

static void write_report(struct executive *executive)
{
    const struct sim *sim = &executive->sim;
    struct executive_report report;

    sim_sample(sim, &report.now);
    report.now.epoch = executive->in_force.epoch;
    report.counters = sim->counters;
    report.verdict = sim->detector.verdict;
    report.measure = sim->measure;
    report.load = executive->load;
    report.has_v10 = sim->has_v10;
    report.v10_step = sim->v10_step;
    report.v10_fraction_q15 = sim->v10_fraction_q15;
    report.generation = publish_taken(&executive->publish);
    report.input = sim->input;
    report.inputs = executive->inputs_taken;
    report.inputs_late = executive->inputs_late;
    handoff_write(&executive->handoff, &report);
    executive->until_report = TICKS_PER_REPORT;
}

static void push_sample(struct executive *executive)
{
    struct sample sample;

    sim_sample(&executive->sim, &sample);
    sample.epoch = executive->in_force.epoch;
    sample.number = (uint16_t)(executive->samples.head + executive->samples.dropped);
    (void)ring_push(&executive->samples, &sample); /* a full ring counts the drop itself */
    executive->until_sample = executive->in_force.sample_every;
}

static void take_order(struct executive *executive)
{
    const struct executive_order *order = publish_take(&executive->publish);
    const uint32_t every_before = executive->in_force.sample_every;

    if (order == NULL) {
        return;
    }
    executive->in_force = *order;
    if (order->is_reset) {
        executive->load = (struct executive_load){0};
        executive->inputs_taken = 0u;
        executive->inputs_late = 0u;
        executive->inputs_waiting.count = 0u;
        sim_reset(&executive->sim, &executive->in_force.plan);
    } else if (order->is_new_plan) {
        sim_apply(&executive->sim, &executive->in_force.plan);
    }
    if (order->measure_steps != 0u) {
        sim_measure(&executive->sim, order->measure_steps);
    }
    if (order->sample_every != every_before || order->is_reset) {
        executive->until_sample = order->sample_every;
    }
    write_report(executive);
}

static void take_input(struct executive *executive, const struct input *input)
{
    executive->inputs_taken++;
    executive->inputs_late += input->step != INPUT_NOW && input->step < executive->sim.step ? 1u : 0u;
    sim_input(&executive->sim, input);
}

/* Those whose step has come. */
static void take_due_inputs(struct executive *executive)
{
    struct input input;

    while (input_queue_take(&executive->inputs_waiting, executive->sim.step, &input)) {
        take_input(executive, &input);
    }
    word_write(&executive->inputs_queued, executive->inputs_waiting.count);
}

/* New demands take hold or find their places, for which main keeps room. What belongs to the run before a reset is void. */
static void collect_inputs(struct executive *executive)
{
    struct input input;

    if (executive->inputs_waiting.count == 0u && ring_fill(&executive->inputs) == 0u) {
        return;
    }
    take_due_inputs(executive);
    while (ring_pop(&executive->inputs, &input)) {
        if (input.epoch != executive->in_force.epoch) {
            continue;
        }
        if (input.step <= executive->sim.step) {
            take_input(executive, &input);
        } else {
            input_queue_put(&executive->inputs_waiting, &input);
        }
    }
    word_write(&executive->inputs_queued, executive->inputs_waiting.count);
}

static uint32_t steps_due(const struct executive *executive)
{
    const uint32_t credit = word_read(&executive->is_free) != 0u ? UINT32_MAX : executive_credit(executive);

    return credit < executive->in_force.substeps ? credit : executive->in_force.substeps;
}

bool executive_tick(struct executive *executive, bool is_due)
{
    uint32_t steps;
    bool has_news = false;

    take_order(executive);
    if (!is_due) {
        collect_inputs(executive);
        return false;
    }
    if (executive->to_shed != 0u) {
        executive->to_shed--;
        executive->load.shed++;
        return false;
    }
    collect_inputs(executive); /* none comes meanwhile */
    steps = steps_due(executive);
    for (uint32_t i = 0u; i < steps; i++) {
        if (executive->inputs_waiting.count != 0u) {
            take_due_inputs(executive);
        }
        has_news = sim_step(&executive->sim) || has_news;
        if (executive->in_force.sample_every != 0u && --executive->until_sample == 0u) {
            push_sample(executive);
        }
    }
    if (word_read(&executive->is_free) == 0u) {
        word_write(&executive->used, word_read(&executive->used) + steps);
    }
    executive->load.ticks++;
    if (has_news || --executive->until_report == 0u || !executive_wants_tick(executive)) {
        write_report(executive);
    }
    return true;
}

void executive_book(struct executive *executive, const struct executive_tick_time *time, bool is_late)
{
    struct executive_load *load = &executive->load;

    if (load->period != time->period) {
        load->period = time->period;
        load->busy_max = 0u;
        load->busy_sum = 0u;
        load->elapsed = 0u;
    }
    load->busy_max = time->busy > load->busy_max ? time->busy : load->busy_max;
    load->busy_sum += time->busy;
    load->elapsed += time->elapsed;
    if (is_late || time->busy > time->period - time->period / MAIN_SHARE) {
        load->overruns++;
        executive->to_shed = time->busy / time->period + 1u;
    }
    if (!executive_wants_tick(executive)) {
        write_report(executive); /* the last tick's time is in it too */
    }
}

bool executive_is_behind(const struct executive *executive) { return executive->to_shed != 0u; }

bool executive_is_squealing(const struct executive *executive)
{
    return executive->sim.detector.verdict.propensity == PROPENSITY_SQUEAL;
}

bool executive_has_order(const struct executive *executive)
{
    return publish_taken(&executive->publish) != executive->publish.generation;
}

static void give_order(struct executive *executive)
{
    struct executive_order *order = publish_back(&executive->publish);

    BASE_ASSERT(order != NULL);
    *order = executive->draft;
    (void)publish_commit(&executive->publish);
    executive->draft.is_reset = false;
    executive->draft.is_new_plan = false;
    executive->draft.measure_steps = 0u;
}

static void order_restart(struct executive *executive)
{
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
    struct sim_plan plan;
    const struct params_problem problem = sim_plan_make(&plan, params, NULL);

    if (problem.error == ERROR_OK) {
        executive->draft.plan = plan;
        executive->draft.substeps = (uint32_t)params->steps_per_tick;
        order_restart(executive);
    }
    return problem;
}

struct params_problem executive_set(struct executive *executive, const struct params *params, bool may_reset,
                                    bool *was_reset)
{
    const struct params_info *moved = params_restart_change(&executive->draft.plan.params, params);
    struct params_problem problem = params_check(params);
    struct sim_plan plan;

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
    problem = sim_plan_make(&plan, params, &executive->draft.plan.scale);
    if (problem.error == ERROR_OK) {
        executive->draft.plan = plan;
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

bool executive_input(struct executive *executive, const struct input_demand *demand, bool *is_clamped)
{
    const struct sim_plan *plan = &executive->draft.plan;
    struct input input;
    const bool was_clamped = input_derive(&input, demand, &plan->params, &plan->scale);

    input.epoch = executive->draft.epoch;
    if (!has_place(executive, demand) || !ring_push(&executive->inputs, &input)) {
        executive->inputs_refused++;
        return false;
    }
    executive->inputs_clamped += was_clamped ? 1u : 0u;
    if (is_clamped != NULL) {
        *is_clamped = was_clamped;
    }
    return true;
}

void executive_grant(struct executive *executive, uint32_t steps)
{
    const uint32_t used = word_read(&executive->used);
    const uint32_t granted = word_read(&executive->granted);

    /* Less than nothing, after a stop that the interrupt cut in two: start from what was used. */
    word_write(&executive->granted, (granted - used > EXECUTIVE_GRANT_MAX ? used : granted) + steps);
}

void executive_free_run(struct executive *executive) { word_write(&executive->is_free, 1u); }

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

uint32_t executive_credit(const struct executive *executive)
{
    const uint32_t credit = word_read(&executive->granted) - word_read(&executive->used);

    /* Taken back while the interrupt used some of it: less than nothing is nothing. */
    return word_read(&executive->is_free) != 0u || credit > EXECUTIVE_GRANT_MAX ? 0u : credit;
}

bool executive_wants_tick(const struct executive *executive)
{
    return word_read(&executive->is_free) != 0u || executive_credit(executive) != 0u;
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
