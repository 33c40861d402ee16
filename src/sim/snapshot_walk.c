/* One list of fields, walked in either direction. */
#include "base/compiler.h"
#include "base/fmath.h"
#include "sim/snapshot_parts.h"

static BASE_NOINLINE void walk_u8(struct snapshot_walk *walk, uint8_t *value)
{
    if (walk->writer != NULL) {
        bytes_put_u8(walk->writer, *value);
    } else {
        *value = bytes_get_u8(walk->reader);
    }
}

static BASE_NOINLINE void walk_mode(struct snapshot_walk *walk, int8_t *value)
{
    uint8_t byte = (uint8_t)*value;

    walk_u8(walk, &byte);
    *value = byte < 0x80u ? (int8_t)byte : (int8_t)((int)byte - 0x100);
}

/* A truth value is looked at only where there is one: another byte in its place would be undefined. */
static BASE_NOINLINE void walk_flag(struct snapshot_walk *walk, bool *value)
{
    uint8_t byte = walk->writer != NULL && *value ? 1u : 0u;

    walk_u8(walk, &byte);
    *value = byte != 0u;
    walk->is_bad = walk->is_bad || byte > 1u;
}

static BASE_NOINLINE void walk_u32(struct snapshot_walk *walk, uint32_t *value)
{
    if (walk->writer != NULL) {
        bytes_put_u32(walk->writer, *value);
    } else {
        *value = bytes_get_u32(walk->reader);
    }
}

static BASE_NOINLINE void walk_i32(struct snapshot_walk *walk, int32_t *value)
{
    if (walk->writer != NULL) {
        bytes_put_i32(walk->writer, *value);
    } else {
        *value = bytes_get_i32(walk->reader);
    }
}

static BASE_NOINLINE void walk_u64(struct snapshot_walk *walk, uint64_t *value)
{
    if (walk->writer != NULL) {
        bytes_put_u64(walk->writer, *value);
    } else {
        *value = bytes_get_u64(walk->reader);
    }
}

static void walk_i64(struct snapshot_walk *walk, int64_t *value)
{
    uint64_t word = (uint64_t)*value;

    walk_u64(walk, &word);
    *value = (int64_t)word;
}

static BASE_NOINLINE void walk_f32(struct snapshot_walk *walk, float *value)
{
    if (walk->writer != NULL) {
        bytes_put_f32(walk->writer, *value);
    } else {
        *value = bytes_get_f32(walk->reader);
        walk->is_bad = walk->is_bad || !fmath_is_finite(*value);
    }
}

/* --- The fields --------------------------------------------------------------------------------------------------- */

static void walk_plant_f32(struct snapshot_walk *walk, struct step_f32 *f32)
{
    walk_f32(walk, &f32->x);
    walk_f32(walk, &f32->v);
    walk_f32(walk, &f32->x_rest);
    walk_f32(walk, &f32->disc);
    walk_mode(walk, &f32->mode);
    walk_f32(walk, &f32->normal.y);
    walk_f32(walk, &f32->normal.w);
    walk_f32(walk, &f32->normal.y_rest);
    walk_f32(walk, &f32->normal.w_rest);
    walk_f32(walk, &f32->normal.n);
    walk_f32(walk, &f32->normal.cosine);
    walk_f32(walk, &f32->normal.sine);
    walk_u32(walk, &f32->normal.phase);
    walk_f32(walk, &f32->normal.least_force);
    walk_flag(walk, &f32->normal.is_lifted);
    walk_flag(walk, &f32->normal.is_steady_from_rest);
}

static void walk_plant_q27(struct snapshot_walk *walk, struct step_q27 *q27)
{
    walk_i32(walk, &q27->x);
    walk_i32(walk, &q27->v);
    walk_i32(walk, &q27->disc);
    walk_mode(walk, &q27->mode);
    walk_flag(walk, &q27->is_saturated);
    walk_u32(walk, &q27->rest.x);
    walk_u32(walk, &q27->rest.v);
    walk_i32(walk, &q27->normal.y);
    walk_i32(walk, &q27->normal.w);
    walk_i32(walk, &q27->normal.n);
    walk_i32(walk, &q27->normal.least_force);
    walk_i32(walk, &q27->normal.reach);
    walk_i32(walk, &q27->normal.phase.cosine);
    walk_i32(walk, &q27->normal.phase.sine);
    walk_i32(walk, &q27->normal.phase.minus_cosine);
    walk_u32(walk, &q27->normal.phase.index);
    walk_flag(walk, &q27->normal.is_lifted);
    walk_flag(walk, &q27->normal.is_steady_from_rest);
}

/* What is left in the plant that is not in use belongs to another run: zeros stand for it. */
static void walk_plant(struct snapshot_walk *walk, struct sim *sim)
{
    struct step_f32 none_f32 = {0};
    struct step_q27 none_q27 = {0};

    walk_plant_f32(walk, walk->is_q27 ? &none_f32 : &sim->f32);
    walk_plant_q27(walk, walk->is_q27 ? &sim->q27 : &none_q27);
}

static void walk_output(struct snapshot_walk *walk, struct plant_output *output)
{
    struct plant_notes notes = {.events = 0u};

    if (walk->writer != NULL) {
        notes = plant_notes(output);
    }
    walk_i32(walk, &output->x);
    walk_i32(walk, &output->v);
    walk_i32(walk, &output->y);
    walk_i32(walk, &output->w);
    walk_i32(walk, &output->disc);
    walk_u32(walk, &notes.stick);
    walk_u32(walk, &notes.slip_minus);
    walk_mode(walk, &output->mode);
    walk_u8(walk, &notes.events);
    walk_flag(walk, &notes.is_capped);
    walk_flag(walk, &notes.is_saturated);
    walk_flag(walk, &notes.is_lifted);
    walk_flag(walk, &notes.is_gap_held);
    if (walk->writer == NULL) {
        output->has_notes = true;
        output->noted = notes;
    }
}

static void walk_sum(struct snapshot_walk *walk, struct acting_sum *sum)
{
    walk_f32(walk, &sum->value);
    walk_f32(walk, &sum->rest);
    walk_i64(walk, &sum->value_q56);
}

static void walk_acting(struct snapshot_walk *walk, struct acting_state *acting)
{
    walk_sum(walk, &acting->lag);
    walk_sum(walk, &acting->inertia);
}

static void walk_counters(struct snapshot_walk *walk, struct sim_counters *counters)
{
    walk_u32(walk, &counters->events);
    walk_u32(walk, &counters->caps);
    walk_u32(walk, &counters->saturations);
    walk_u32(walk, &counters->lifted);
    walk_u32(walk, &counters->gap_held);
    walk_u32(walk, &counters->lowered);
    walk_u32(walk, &counters->inputs);
    walk_u32(walk, &counters->inputs_late);
    walk_u32(walk, &counters->inputs_void);
}

static void walk_held(struct snapshot_walk *walk, struct sim *sim)
{
    walk_flag(walk, &sim->input.holds_load);
    walk_flag(walk, &sim->input.holds_speed);
    walk_f32(walk, &sim->input.load);
    walk_f32(walk, &sim->input.speed);
    walk_i32(walk, &sim->input.load_q27);
    walk_i32(walk, &sim->input.speed_q27);
    walk_u8(walk, &sim->watch.state);
    walk_u64(walk, &sim->watch.silence);
    walk_u64(walk, &sim->watch.ramp);
    walk_u32(walk, &sim->watch.stales);
    walk_u32(walk, &sim->watch.safes);
    walk_f32(walk, &sim->safe_load);
    walk_i32(walk, &sim->safe_load_q27);
}

static void walk_measure(struct snapshot_walk *walk, struct measure *measure)
{
    walk_u64(walk, &measure->planned);
    walk_u64(walk, &measure->done);
    walk_i32(walk, &measure->x_max);
    walk_i32(walk, &measure->x_min);
    walk_i32(walk, &measure->v_max);
    walk_i32(walk, &measure->v_min);
    walk_u64(walk, &measure->stick);
    walk_u64(walk, &measure->slip_minus);
    walk_u32(walk, &measure->crossings);
    walk_u64(walk, &measure->first_q15);
    walk_u64(walk, &measure->last_q15);
    walk_i32(walk, &measure->level);
    walk_i32(walk, &measure->step_q27);
    walk_i32(walk, &measure->x1);
    walk_i32(walk, &measure->v1);
    walk_i32(walk, &measure->v2);
    walk_u32(walk, &measure->smooth);
}

static void walk_frame(struct snapshot_walk *walk, struct detector_frame *frame)
{
    walk_i32(walk, &frame->x_max);
    walk_i32(walk, &frame->x_min);
    walk_i32(walk, &frame->v_max);
    walk_i32(walk, &frame->v_min);
    walk_i32(walk, &frame->w_max);
    walk_i32(walk, &frame->w_min);
    walk_i32(walk, &frame->acceleration);
    walk_i32(walk, &frame->y_max);
    walk_u64(walk, &frame->stick);
    walk_u64(walk, &frame->slip_minus);
    walk_u64(walk, &frame->first_q15);
    walk_u64(walk, &frame->last_q15);
    walk_u32(walk, &frame->crossings);
    walk_i32(walk, &frame->change_log2_q16);
}

static void walk_verdict(struct snapshot_walk *walk, struct detector_verdict *verdict)
{
    walk_u32(walk, &verdict->frame);
    walk_u8(walk, &verdict->propensity);
    walk_u8(walk, &verdict->motion);
    walk_u8(walk, &verdict->period);
    walk_flag(walk, &verdict->has_growth);
    walk_i32(walk, &verdict->growth_q16);
    walk_i32(walk, &verdict->growth_error_q16);
    walk_i32(walk, &verdict->free_log2_q16);
    walk_i32(walk, &verdict->x_max);
    walk_i32(walk, &verdict->x_min);
    walk_i32(walk, &verdict->v_max);
    walk_i32(walk, &verdict->v_min);
    walk_i32(walk, &verdict->acceleration);
    walk_u64(walk, &verdict->variance);
    walk_i32(walk, &verdict->disc);
    walk_u32(walk, &verdict->stick);
    walk_u32(walk, &verdict->slip_minus);
    walk_u32(walk, &verdict->cycles);
    walk_u64(walk, &verdict->cycle_steps_q15);
}

static void walk_marks(struct snapshot_walk *walk, struct detector *detector)
{
    for (unsigned i = 0u; i < DETECTOR_STROBES; i++) {
        walk_i32(walk, &detector->strobe_x[i]);
        walk_i32(walk, &detector->strobe_v[i]);
    }
    for (unsigned i = 0u; i < DETECTOR_PEAKS; i++) {
        walk_i32(walk, &detector->peak_x[i]);
        walk_u32(walk, &detector->peak_time_q8[i]);
    }
    walk_u32(walk, &detector->strobes);
    walk_u32(walk, &detector->peaks);
    walk_u8(walk, &detector->search.stage);
    walk_u8(walk, &detector->search.period);
    walk_u8(walk, &detector->search.index);
    walk_u32(walk, &detector->search.head);
}

/* Its configuration follows from the plan and from what is held, its bands from what is walked. Counts and sums stand
 * in the image whole, whatever part of them the present period has. */
static void walk_detector(struct snapshot_walk *walk, struct detector *detector)
{
    int64_t v_sum = detector->frame_v_sum + detector->v_sum;
    uint64_t step = detector_step(detector);

    walk_i32(walk, &detector->x1);
    walk_i32(walk, &detector->v1);
    walk_u32(walk, &detector->phase);
    walk_frame(walk, &detector->now);
    walk_u64(walk, &detector->change_sum);
    walk_i64(walk, &v_sum);
    walk_u64(walk, &detector->v_square_sum);
    walk_u32(walk, &detector->periods);
    for (unsigned i = 0u; i < DETECTOR_WINDOW_FRAMES; i++) {
        walk_frame(walk, &detector->frames[i]);
    }
    walk_u32(walk, &detector->frame);
    walk_u32(walk, &detector->evidence);
    walk_i32(walk, &detector->level);
    walk_i32(walk, &detector->hysteresis);
    walk_flag(walk, &detector->is_below);
    walk_u64(walk, &step);
    walk_marks(walk, detector);
    walk_verdict(walk, &detector->verdict);
    walk_flag(walk, &detector->has_diverged);
    if (walk->writer == NULL) {
        detector->frame_v_sum = v_sum;
        detector->v_sum = 0;
        detector->period_step = step - detector->phase;
        detector_empty_bands(detector);
    }
}

static void walk_input(struct snapshot_walk *walk, struct input *input)
{
    walk_u64(walk, &input->step);
    walk_flag(walk, &input->sets_load);
    walk_flag(walk, &input->sets_speed);
    walk_flag(walk, &input->holds_load);
    walk_flag(walk, &input->holds_speed);
    walk_f32(walk, &input->load);
    walk_f32(walk, &input->speed);
    walk_i32(walk, &input->load_q27);
    walk_i32(walk, &input->speed_q27);
}

/* Places that are not taken hold zeros. */
static void walk_waiting(struct snapshot_walk *walk, struct input_queue *waiting)
{
    walk_u32(walk, &waiting->count);
    for (uint32_t i = 0u; i < INPUT_QUEUE_MAX; i++) {
        struct input input = {0};

        if (walk->writer != NULL && i < waiting->count) {
            input = waiting->waiting[i];
        }
        walk_input(walk, &input);
        if (walk->writer == NULL) {
            waiting->waiting[i] = input;
        }
    }
}

void snapshot_walk_run(struct snapshot_walk *walk, struct sim *sim, struct input_queue *waiting)
{
    walk_u64(walk, &sim->step);
    walk_u32(walk, &sim->hash);
    walk_u8(walk, &sim->fault);
    walk_flag(walk, &sim->has_v10);
    walk_u64(walk, &sim->v10_step);
    walk_u32(walk, &sim->v10_fraction_q15);
    walk_plant(walk, sim);
    walk_output(walk, walk->is_q27 ? &sim->q27.output : &sim->f32.output);
    walk_u64(walk, &sim->angle.turns);
    walk_u32(walk, &sim->angle.rest);
    walk_i32(walk, &sim->texture);
    walk_acting(walk, &sim->load);
    walk_acting(walk, &sim->speed);
    walk_counters(walk, &sim->counters);
    walk_held(walk, sim);
    walk_measure(walk, &sim->measure);
    walk_detector(walk, &sim->detector);
    walk_waiting(walk, waiting);
}

/* Points beyond the count hold zeros. */
static void walk_table(struct snapshot_walk *walk, struct params_points *table)
{
    walk_u32(walk, &table->count);
    walk->is_bad = walk->is_bad || table->count > PARAMS_POINTS_MAX;
    for (uint32_t i = 0u; i < PARAMS_POINTS_MAX; i++) {
        walk_f32(walk, &table->points[i].time_s);
        walk_f32(walk, &table->points[i].value);
    }
}

void snapshot_walk_set(struct snapshot_walk *walk, struct params *params, struct scale *latched)
{
    for (size_t i = 0u; i < params_count; i++) {
        float value = params_value(params, &params_table[i]);

        walk_f32(walk, &value);
        params_set(params, &params_table[i], value);
    }
    walk_table(walk, &params->tables[PARAMS_TABLE_LOAD]);
    walk_table(walk, &params->tables[PARAMS_TABLE_SPEED]);
    walk_f32(walk, &latched->load_n);
    walk_f32(walk, &latched->speed_m_per_s);
    walk_u32(walk, &latched->length_shift);
    walk->is_q27 = params->arithmetic == (float)ARITH_Q27;
}
