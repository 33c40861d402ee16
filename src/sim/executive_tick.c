/* The interrupt's side of the executive: orders taken, demands taken, steps made, all of it reported. */
#include "sim/executive.h"

#include "base/compiler.h"

enum {
    TICKS_PER_REPORT = 32, /* of a free run without news */
    MAIN_SHARE = 16        /* a tick that leaves main less than this part of its period counts as overrun */
};

static BASE_NOINLINE void write_report(struct executive *executive)
{
    const struct sim *sim = &executive->sim;
    struct executive_report *report = handoff_open(&executive->handoff);

    sim_sample(sim, &report->now);
    report->now.epoch = executive->in_force.epoch;
    report->counters = sim->counters;
    report->verdict = sim->detector.verdict;
    report->measure = sim->measure;
    report->load = executive->load;
    report->has_v10 = sim->has_v10;
    report->v10_step = sim->v10_step;
    report->v10_fraction_q15 = sim->v10_fraction_q15;
    report->generation = publish_taken(&executive->publish);
    report->input = sim->input;
    report->stales = sim->watch.stales;
    report->safes = sim->watch.safes;
    handoff_close(&executive->handoff);
    executive->until_report = TICKS_PER_REPORT;
}

/* A full ring counts the drop itself, and so does the number of the next sample. */
static BASE_NOINLINE void push_sample(struct executive *executive)
{
    const uint32_t number = executive->samples.head + executive->samples.dropped;
    struct sample *sample = ring_reserve(&executive->samples);

    executive->until_sample = executive->in_force.sample_every;
    if (sample == NULL) {
        return;
    }
    sim_sample(&executive->sim, sample);
    sample->epoch = executive->in_force.epoch;
    sample->number = (uint16_t)number;
    ring_commit(&executive->samples);
}

/* Those whose step has come. The safe state voids all that wait: after it only what comes anew may act. */
static BASE_NOINLINE void take_due_inputs(struct executive *executive)
{
    struct input_queue *waiting = &executive->inputs_waiting;
    struct input input;

    if (executive->sim.watch.state == WATCH_SAFE) {
        executive->sim.counters.inputs_void += waiting->count;
        waiting->count = 0u;
    }
    while (input_queue_take(waiting, executive->sim.step, &input)) {
        sim_input(&executive->sim, &input);
    }
    word_write(&executive->inputs_queued, waiting->count);
}

/* New demands take hold or find their places, for which main keeps room. What belongs to the run before a reset is
 * void. */
static BASE_NOINLINE void collect_inputs(struct executive *executive)
{
    struct input input;

    take_due_inputs(executive);
    while (ring_pop(&executive->inputs, &input)) {
        if (input.epoch != executive->in_force.epoch) {
            continue;
        }
        if (input.step <= executive->sim.step || executive->sim.watch.state == WATCH_SAFE) {
            sim_input(&executive->sim, &input);
        } else {
            input_queue_put(&executive->inputs_waiting, &input);
        }
    }
    word_write(&executive->inputs_queued, executive->inputs_waiting.count);
}

BASE_INLINE bool has_inputs(const struct executive *executive)
{
    return word_read(&executive->inputs_queued) != 0u || ring_fill(&executive->inputs) != 0u;
}

static void take_reset(struct executive *executive, const struct executive_order *order)
{
    executive->load = (struct executive_load){.period = executive->load.period};
    executive->busy_usual = 0u;
    executive->inputs_waiting.count = 0u;
    if (order->is_restore) {
        snapshot_restore(executive->image, &executive->sim, &executive->inputs_waiting);
        sim_resume(&executive->sim, &executive->in_force.plan);
    } else {
        sim_reset(&executive->sim, &executive->in_force.plan);
    }
    word_write(&executive->inputs_queued, executive->inputs_waiting.count);
}

static BASE_NOINLINE void take_order(struct executive *executive)
{
    const struct executive_order *order = publish_take(&executive->publish);
    const uint32_t every_before = executive->in_force.sample_every;

    if (order->is_new_plan && !order->is_reset) {
        sim_apply(&executive->sim, &order->plan); /* which asks the plan before it, and that is in force until here */
    }
    executive->in_force = *order;
    if (order->is_reset) {
        take_reset(executive, order);
    } else {
        sim_resume(&executive->sim, &executive->in_force.plan);
    }
    if (order->measure_steps != 0u) {
        sim_measure(&executive->sim, order->measure_steps);
    }
    if (order->is_snapshot) {
        collect_inputs(executive); /* what is on its way belongs to the run */
        snapshot_take(executive->image, &executive->sim, &executive->inputs_waiting);
    }
    if (order->sample_every != every_before || order->is_reset) {
        executive->until_sample = order->sample_every;
    }
    write_report(executive);
}

/* In free run the controller is asked by the wall's time, and that passes without steps too. */
static void pass_time(struct executive *executive, uint32_t ticks)
{
    if (executive->sim.watch.state != WATCH_OFF && word_read(&executive->is_free) != 0u) {
        watch_pass(&executive->sim.watch, &executive->in_force.plan.watch.free, ticks * executive->in_force.substeps);
    }
}

/* What belongs before a step, where there is more to a tick than steps. */
BASE_INLINE void prepare_step(struct executive *executive, const struct watch_pace *pace)
{
    if (BASE_UNLIKELY(executive->inputs_waiting.count != 0u)) {
        take_due_inputs(executive);
    }
    if (BASE_UNLIKELY(executive->sim.watch.state != WATCH_OFF)) {
        sim_watch(&executive->sim, pace);
    }
}

/* Returns true when the detector has a new verdict. Without a pace there is nothing but steps. */
BASE_INLINE bool make_steps(struct executive *executive, uint32_t steps, const struct watch_pace *pace)
{
    bool has_news = false;

    for (; steps > 0u; steps--) {
        if (pace != NULL) {
            prepare_step(executive, pace);
        }
        has_news |= sim_step(&executive->sim);
        if (executive->until_sample != 0u && --executive->until_sample == 0u) {
            push_sample(executive);
        }
    }
    return has_news;
}

/* As many steps as are due, in free run or by credit, neither of which main can take back meanwhile. Returns true when
 * there is news: a verdict, or no credit left. */
static bool make_due_steps(struct executive *executive)
{
    const struct watch_config *watch = &executive->in_force.plan.watch;
    const bool is_free = word_read(&executive->is_free) != 0u;
    const uint32_t credit = is_free ? UINT32_MAX : executive_credit(executive);
    const uint32_t substeps = executive->in_force.substeps;
    const uint32_t steps = credit < substeps ? credit : substeps;
    const bool has_news = make_steps(executive, steps, is_free ? &watch->free : &watch->locked);

    if (!is_free) {
        word_write(&executive->used, word_read(&executive->used) + steps);
    }
    return has_news || steps == credit;
}

BASE_INLINE void end_tick(struct executive *executive, bool has_news)
{
    executive->load.ticks++;
    executive->until_report--;
    if (BASE_UNLIKELY(has_news || executive->until_report == 0u)) {
        write_report(executive);
    }
}

/* A tick of no period: main has called for it. */
static BASE_NOINLINE void answer_call(struct executive *executive, uint8_t watch_before)
{
    if (has_inputs(executive)) {
        collect_inputs(executive);
    }
    if (executive->sim.watch.state != watch_before) {
        write_report(executive);
    }
}

/* The usual tick is one of a free run and has nothing but steps to make. */
BASE_INLINE bool is_usual_tick(const struct executive *executive)
{
    return word_read(&executive->is_free) != 0u && !publish_has_new(&executive->publish) && executive->to_shed == 0u &&
           !has_inputs(executive) && executive->sim.watch.state == WATCH_OFF;
}

static BASE_NOINLINE bool make_unusual_tick(struct executive *executive, bool is_due)
{
    uint8_t watch_before;
    bool has_news;

    if (publish_has_new(&executive->publish)) {
        take_order(executive);
    }
    watch_before = executive->sim.watch.state;
    if (!is_due) {
        answer_call(executive, watch_before);
        return false;
    }
    if (executive->to_shed != 0u) {
        executive->to_shed--;
        executive->load.shed++;
        pass_time(executive, 1u);
        return false;
    }
    if (has_inputs(executive)) {
        collect_inputs(executive); /* none comes meanwhile */
    }
    has_news = make_due_steps(executive);
    end_tick(executive, has_news || executive->sim.watch.state != watch_before);
    return true;
}

bool executive_tick(struct executive *executive, bool is_due)
{
    if (BASE_UNLIKELY(!is_due || !is_usual_tick(executive))) {
        return make_unusual_tick(executive, is_due);
    }
    end_tick(executive, make_steps(executive, executive->in_force.substeps, NULL));
    return true;
}

void executive_begin_rate(struct executive *executive, uint32_t period)
{
    struct executive_load *load = &executive->load;

    if (load->period != period) {
        load->period = period;
        load->busy_max = 0u;
        load->busy_sum = 0u;
        load->elapsed = 0u;
        executive->busy_usual = 0u;
    }
}

static void book_overrun(struct executive *executive, uint32_t busy)
{
    const uint32_t periods = busy / executive->load.period;

    executive->load.overruns++;
    executive->to_shed = periods + 1u;
    pass_time(executive, periods > 1u ? periods - 1u : 0u); /* of the ticks meanwhile the timer kept one */
}

void executive_book_unusual(struct executive *executive, uint32_t busy, bool is_late)
{
    struct executive_load *load = &executive->load;
    const uint32_t most = load->period - load->period / MAIN_SHARE;

    load->busy_max = busy > load->busy_max ? busy : load->busy_max;
    executive->busy_usual = load->busy_max < most ? load->busy_max : most;
    if (is_late || busy > most) {
        book_overrun(executive, busy);
    }
}

void executive_book_end(struct executive *executive) { write_report(executive); }
