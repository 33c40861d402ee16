/* One plant, one step at a time. */
#include "base/compiler.h"
#include "base/fixed.h"
#include "base/fmath.h"
#include "base/hash.h"
#include "sim/extremum.h"
#include "sim/sim_parts.h"

enum { V10_RATIO = 10 };

#define SPEED_LIMIT_Q27 ((uint32_t)(SCALE_FAULT_SPEED * (float)(1 << PLANT_FRACTION_BITS)) - 1u)

/* --- The two arithmetics ------------------------------------------------------------------------------------------ */

static BASE_NOINLINE void renew_texture(struct sim *sim, int32_t disc)
{
    if (texture_begins(&sim->plan->texture, sim->step)) {
        sim->texture = texture_value(&sim->plan->texture, &sim->angle, sim->step, disc);
    }
}

/* Load and speed held over the step to come. */
BASE_INLINE struct step_f32_input input_f32(struct sim *sim)
{
    const struct sim_plan *plan = sim->plan;
    struct step_f32_input input = {.load = sim_load_f32(sim), .speed = sim_speed_f32(sim)};

    if (plan->texture.is_active) {
        renew_texture(sim, (int32_t)(input.speed * (float)(1 << PLANT_FRACTION_BITS))); /* the speed is within 1 */
        input.load = texture_load_f32(input.load, sim->texture);
    }
    return input;
}

BASE_INLINE struct step_q27_input input_q27(struct sim *sim)
{
    const struct sim_plan *plan = sim->plan;
    struct step_q27_input input = {.load = sim_load_q27(sim), .speed = sim_speed_q27(sim)};

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

static void reset_plant(struct sim *sim)
{
    const struct sim_plan *plan = sim->plan;

    if (plan->arithmetic == ARITH_Q27) {
        step_q27_reset(&sim->q27, &plan->q27, &plan->params, &plan->scale, input_q27(sim));
    } else {
        step_f32_reset(&sim->f32, &plan->f32, &plan->params, &plan->scale, input_f32(sim));
    }
}

/* Whatever leaves the domain leaves the output's range first, but for the speed, which has a limit inside it. */
static bool may_be_outside(const struct plant_output *output)
{
    return output->has_notes || fixed_abs(output->v) > SPEED_LIMIT_Q27;
}

static BASE_NOINLINE void advance_f32(struct sim *sim)
{
    step_f32_set_input(&sim->f32, &sim->plan->f32, input_f32(sim));
    step_f32_advance(&sim->f32, &sim->plan->f32);
}

static BASE_NOINLINE void advance_q27(struct sim *sim)
{
    step_q27_set_input(&sim->q27, &sim->plan->q27, input_q27(sim));
    step_q27_advance(&sim->q27, &sim->plan->q27);
}

/* Under the load and the speed of the step before. */
BASE_INLINE const struct plant_output *advance_alike(struct sim *sim)
{
    if (sim->plan->arithmetic == ARITH_Q27) {
        step_q27_advance(&sim->q27, &sim->plan->q27);
        return &sim->q27.output;
    }
    step_f32_advance(&sim->f32, &sim->plan->f32);
    return &sim->f32.output;
}

static bool is_outside(const struct sim *sim)
{
    return sim->plan->arithmetic == ARITH_Q27 ? step_q27_is_outside(&sim->q27)
                                              : may_be_outside(&sim->f32.output) && step_f32_is_outside(&sim->f32);
}

/* The states as words, in the order in which they are hashed. */
BASE_INLINE void state_words(const struct sim *sim, uint32_t words[5])
{
    if (sim->plan->arithmetic == ARITH_Q27) {
        words[0] = (uint32_t)sim->q27.x;
        words[1] = (uint32_t)sim->q27.v;
        words[2] = (uint32_t)sim->q27.normal.y;
        words[3] = (uint32_t)sim->q27.normal.w;
        words[4] = (uint32_t)(int32_t)sim->q27.output.mode;
    } else {
        words[0] = fmath_bits(sim->f32.x);
        words[1] = fmath_bits(sim->f32.v);
        words[2] = fmath_bits(sim->f32.normal.y);
        words[3] = fmath_bits(sim->f32.normal.w);
        words[4] = (uint32_t)(int32_t)sim->f32.output.mode;
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
    sim->is_usual = false;
    sim->step = 0u;
    sim->hash = HASH_INIT;
    sim->fault = SIM_FAULT_NONE;
    sim->has_v10 = false;
    sim->v10_step = 0u;
    sim->v10_fraction_q15 = 0u;
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
    detector_reset(&sim->detector, &plan->detector, sim_output(sim));
}

/* The place inside the step is by a straight line: a diverging plant needs many steps to pass the mark. */
static BASE_NOINLINE void book_v10(struct sim *sim, uint32_t before, uint32_t now, uint32_t limit)
{
    if (sim->has_v10 || limit == 0u) {
        return;
    }
    sim->has_v10 = true;
    sim->v10_step = sim->step;
    sim->v10_fraction_q15 = before < limit ? extremum_ratio_q15(limit - before, now - before) : 0u;
}

/* The disc's speed is within 1 but for rounding, and ten times that fits. */
static uint32_t v10_limit(const struct sim *sim) { return fixed_abs(sim_output(sim)->disc) * V10_RATIO; }

static void watch_v10(struct sim *sim)
{
    const uint32_t limit = v10_limit(sim);
    const uint32_t now = fixed_abs(sim_output(sim)->v);

    if (now > limit) {
        book_v10(sim, fixed_abs(sim->detector.v1), now, limit);
    }
}

static void count_events(struct sim *sim)
{
    const struct plant_notes notes = plant_notes(sim_output(sim));

    sim->counters.events += notes.events;
    sim->counters.caps += notes.is_capped;
    sim->counters.saturations += notes.is_saturated;
    sim->counters.lifted += notes.is_lifted;
    sim->counters.gap_held += notes.is_gap_held;
}

/* Books what a step has brought. Returns false when the plant has left its domain with it: then it stands. */
static BASE_NOINLINE bool look_closer(struct sim *sim)
{
    watch_v10(sim);
    count_events(sim);
    if (!is_outside(sim)) {
        return true;
    }
    sim->fault = SIM_FAULT_DOMAIN;
    sim->is_usual = false;
    detector_set_diverged(&sim->detector);
    return false;
}

/* --- The usual step ----------------------------------------------------------------------------------------------- */

/* Load and speed stand, nothing has a state, nobody measures, a controller is not silent: there is no more to a step
 * than plant, detector and hash. Asked at the end of a step for all that follow; whatever may change one of these
 * clears is_usual, so that it is asked anew. */
static bool will_be_usual(const struct sim *sim)
{
    const struct sim_plan *plan = sim->plan;
    const bool has_load = sim->input.holds_load || sim->step > plan->load.end;
    const bool has_speed = sim->input.holds_speed || sim->step > plan->speed.end;

    return has_load && has_speed && !plan->has_state && !plan->texture.is_active && plan->texture.runout == 0 &&
           !watch_is_silent(sim->watch.state) && !measure_is_active(&sim->measure);
}

static uint32_t usual_speed(const struct sim *sim)
{
    const uint32_t limit = v10_limit(sim);

    return limit < SPEED_LIMIT_Q27 ? limit : SPEED_LIMIT_Q27;
}

BASE_INLINE bool step_usual(struct sim *sim)
{
    const struct plant_output *const output = advance_alike(sim);

    if (BASE_UNLIKELY(output->has_notes || fixed_abs(output->v) > sim->usual_speed) && !look_closer(sim)) {
        return true;
    }
    sim->step++;
    return detector_push(&sim->detector, output);
}

static BASE_NOINLINE bool step_any(struct sim *sim)
{
    bool has_verdict;

    if (sim->fault != SIM_FAULT_NONE) {
        return false;
    }
    if (sim->plan->arithmetic == ARITH_Q27) {
        advance_q27(sim);
    } else {
        advance_f32(sim);
    }
    if (!look_closer(sim)) {
        return true;
    }
    if (sim->plan->has_state) {
        follow(sim);
    }
    sim->step++;
    if (sim->plan->texture.runout != 0) {
        texture_turn(&sim->plan->texture, &sim->angle, sim_output(sim)->disc);
    }
    has_verdict = !watch_is_silent(sim->watch.state) ? detector_push(&sim->detector, sim_output(sim))
                                                     : detector_skip(&sim->detector, sim_output(sim));
    if (measure_is_active(&sim->measure)) {
        measure_push(&sim->measure, sim_output(sim));
    }
    sim->is_usual = will_be_usual(sim);
    sim->usual_speed = usual_speed(sim);
    return has_verdict;
}

BASE_INLINE uint32_t hash_state(const struct sim *sim)
{
    uint32_t words[5];
    uint32_t hash = sim->hash;

    state_words(sim, words);
    hash = hash_word(hash, words[0]);
    hash = hash_word(hash, words[1]);
    hash = hash_word(hash, words[2]);
    hash = hash_word(hash, words[3]);
    return hash_word(hash, words[4]);
}

BASE_INLINE bool step(struct sim *sim) { return BASE_LIKELY(sim->is_usual) ? step_usual(sim) : step_any(sim); }

bool sim_step_unhashed(struct sim *sim) { return step(sim); }

bool sim_step(struct sim *sim)
{
    const bool has_verdict = step(sim);

    if (BASE_LIKELY(sim->fault == SIM_FAULT_NONE)) {
        sim->hash = hash_state(sim);
    }
    return has_verdict;
}

void sim_measure(struct sim *sim, uint64_t steps)
{
    measure_start(&sim->measure, sim_output(sim), steps, sim->plan->detector.step_q27);
    sim->is_usual = false;
}

void sim_sample(const struct sim *sim, struct sample *sample)
{
    uint32_t words[5];

    state_words(sim, words);
    sample->step = sim->step;
    sample->x = words[0];
    sample->v = words[1];
    sample->y = words[2];
    sample->w = words[3];
    sample->hash = sim->hash;
    sample->mode = (int8_t)words[4];
    sample->arithmetic = sim->plan->arithmetic;
    sample->propensity = sim->detector.verdict.propensity;
    sample->is_fault = sim->fault != SIM_FAULT_NONE;
    sample->watch = sim->watch.state;
    sample_forces(sim, sample);
}
