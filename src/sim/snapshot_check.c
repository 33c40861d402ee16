/* What a run can have become. Whoever makes an image may put any bits into it and a CRC that fits; the checks that
 * matter are those before an index, a divisor, a loop's end, or a sum that is proven to fit only under bounds. All
 * allow a little more than a run needs. */
#include "base/fixed.h"
#include "base/fmath.h"
#include "sim/snapshot_parts.h"

enum {
    LOAD_MAX_Q27 = 2 << PLANT_FRACTION_BITS,        /* with its texture */
    UNIT_MAX_Q27 = 17 << (PLANT_FRACTION_BITS - 4), /* of what the scale holds within 1: 17/16 */
    TEXTURE_MAX = 3 << 28,                          /* Q30 */
    REACH_ROUNDING = 1 << 16,                       /* by which a motion may have outgrown its reach */
    LOG2_MAX_Q16 = 64 << 16,
    GROWTH_MAX_Q16 = 1 << 24,
    EVIDENCE_MOST = 16,
    FRACTION_MAX_Q15 = 1 << 16,
    REST_MAX = (1u << 31) - 1u, /* of the disc's angle */
    PERIOD_MAX = DETECTOR_PERIOD_MAX + 1
};

#define STEPS_MAX (UINT64_C(1) << 48)    /* since reset: ages at any rate, and 2^-15 steps still count in 64 bits */
#define SPEED_SUM_MAX (INT64_C(1) << 34) /* of a frame: 2^13 steps of 2^20 */
#define UNIT_MAX 1.0625f
#define LOAD_MAX 2.0f
#define SUM_MAX 1.125f /* a lag may follow a load step at once */
#define SUM_MAX_Q56 (INT64_C(9) << 53)
#define AMPLITUDE_MAX 256.0f
#define REST_MAX_F32 1.0f

static bool is_word(int32_t value) { return value != INT32_MIN; }

static bool is_within(int32_t value, int32_t most) { return value >= -most && value <= most; }

static bool is_within_f32(float value, float most) { return fmath_abs(value) <= most; }

static bool is_mode(int8_t mode) { return mode >= PLANT_SLIP_MINUS && mode <= PLANT_SLIP_PLUS; }

static bool is_sound_f32(const struct step_f32 *plant)
{
    const struct normal_f32 *normal = &plant->normal;

    return !step_f32_is_outside(plant) && is_mode(plant->mode) && plant->output.mode == plant->mode &&
           is_within_f32(plant->x_rest, REST_MAX_F32) && is_within_f32(normal->y_rest, REST_MAX_F32) &&
           is_within_f32(normal->w_rest, REST_MAX_F32) && is_within_f32(plant->disc, UNIT_MAX) &&
           is_within_f32(normal->n, LOAD_MAX) && is_within_f32(normal->cosine, AMPLITUDE_MAX) &&
           is_within_f32(normal->sine, AMPLITUDE_MAX) && normal->phase < SINE_GRID / 4u && normal->least_force <= 0.0f;
}

/* Is a b no longer than this as a vector? */
static bool is_shorter(int64_t a, int64_t b, int64_t limit)
{
    const uint64_t x = (uint64_t)(a < 0 ? -a : a);
    const uint64_t y = (uint64_t)(b < 0 ? -b : b);
    const uint64_t most = limit > 0 ? (uint64_t)limit : 0u;

    return x <= most && y <= most && x * x + y * y <= most * most;
}

/* Only within its reach the fast arithmetic is known to fit. A free motion keeps its distance from n, or loses of
 * it. */
static bool is_within_reach(const struct normal_q27 *normal, const struct normal_q27_coeffs *coeffs)
{
    const int64_t room = (int64_t)normal->reach - (int64_t)fixed_abs(normal->n) + REACH_ROUNDING;

    if (coeffs->contact == CONTACT_LIFT && !normal->is_steady_from_rest) {
        return normal->reach == INT32_MAX;
    }
    if (normal->reach == INT32_MAX) {
        return true;
    }
    return is_shorter((int64_t)normal->y - normal->n, normal->w, room) &&
           (!coeffs->has_phase || is_shorter(normal->phase.cosine / 2, normal->phase.sine / 2, room));
}

static bool is_sound_phase(const struct normal_q27_phase *phase)
{
    return phase->index < SINE_GRID / 4u && is_word(phase->cosine) && is_word(phase->sine) &&
           phase->minus_cosine == -phase->cosine;
}

static bool is_sound_normal(const struct normal_q27 *normal, const struct normal_q27_coeffs *coeffs)
{
    const bool may_lift = coeffs->contact == CONTACT_LIFT && !normal->is_steady_from_rest;

    return is_word(normal->y) && is_word(normal->w) && is_within(normal->n, LOAD_MAX_Q27) &&
           is_word(normal->least_force) && normal->least_force <= 0 && normal->reach >= 0 &&
           is_sound_phase(&normal->phase) && (may_lift || !normal->is_lifted) && is_within_reach(normal, coeffs);
}

static bool is_sound_q27(const struct step_q27 *plant, const struct step_q27_coeffs *coeffs)
{
    return !step_q27_is_outside(plant) && is_word(plant->x) && is_word(plant->v) && is_mode(plant->mode) &&
           plant->output.mode == plant->mode && is_within(plant->disc, UNIT_MAX_Q27) &&
           is_sound_normal(&plant->normal, &coeffs->normal);
}

static bool is_sound_held(const struct sim *sim)
{
    const struct input_state *input = &sim->input;

    return is_within_f32(input->load, UNIT_MAX) && is_within_f32(input->speed, UNIT_MAX) &&
           is_within(input->load_q27, UNIT_MAX_Q27) && is_within(input->speed_q27, UNIT_MAX_Q27) &&
           is_within_f32(sim->safe_load, UNIT_MAX) && is_within(sim->safe_load_q27, UNIT_MAX_Q27) &&
           sim->watch.state <= WATCH_SAFE && sim->watch.silence <= WATCH_SILENCE_MAX && sim->watch.ramp <= WATCH_ALL;
}

/* A sum goes on from what it is by parts of what the scale holds. */
static bool is_sound_sum(const struct acting_sum *sum, int64_t most_q56)
{
    return is_within_f32(sum->value, SUM_MAX) && is_within_f32(sum->rest, UNIT_MAX) && sum->value_q56 <= most_q56 &&
           sum->value_q56 >= -most_q56;
}

static bool is_sound_acting(const struct acting_state *acting)
{
    return is_sound_sum(&acting->lag, SUM_MAX_Q56) && is_sound_sum(&acting->inertia, SUM_MAX_Q56);
}

static bool is_sound_waiting(const struct input_queue *waiting)
{
    if (waiting->count > INPUT_QUEUE_MAX) {
        return false;
    }
    for (uint32_t i = 0u; i < waiting->count; i++) {
        const struct input *input = &waiting->waiting[i];

        if (!is_within_f32(input->load, UNIT_MAX) || !is_within_f32(input->speed, UNIT_MAX) ||
            !is_within(input->load_q27, UNIT_MAX_Q27) || !is_within(input->speed_q27, UNIT_MAX_Q27) ||
            (i > 0u && input->step < input[-1].step)) {
            return false;
        }
    }
    return true;
}

static bool is_sound_frame(const struct detector_frame *frame)
{
    return frame->change_log2_q16 >= -1 && frame->change_log2_q16 <= LOG2_MAX_Q16 && frame->acceleration >= 0;
}

static bool is_sound_verdict(const struct detector_verdict *verdict)
{
    return verdict->propensity <= PROPENSITY_SQUEAL && verdict->motion <= CLASS_DIVERGING &&
           verdict->period <= PERIOD_MAX && is_within(verdict->growth_q16, GROWTH_MAX_Q16) &&
           is_within(verdict->growth_error_q16, GROWTH_MAX_Q16) && verdict->free_log2_q16 >= -1 &&
           verdict->free_log2_q16 <= LOG2_MAX_Q16 && verdict->acceleration >= 0;
}

/* A judgement divides by the frames seen. */
static bool is_sound_search(const struct detector *detector)
{
    const struct detector_search *search = &detector->search;

    return search->stage <= STAGE_PEAKS && search->period <= PERIOD_MAX && search->index < DETECTOR_STROBES &&
           (search->stage == STAGE_IDLE || detector->frame != 0u);
}

/* A frame that is full stands until the step after it. */
static bool is_sound_count(const struct detector *detector)
{
    return detector->periods < DETECTOR_FRAME_PERIODS ||
           (detector->periods == DETECTOR_FRAME_PERIODS && detector->search.stage == STAGE_MEASURE);
}

static bool is_sound_detector(const struct detector *detector, const struct detector_config *config)
{
    for (unsigned i = 0u; i < DETECTOR_WINDOW_FRAMES; i++) {
        if (!is_sound_frame(&detector->frames[i])) {
            return false;
        }
    }
    return is_sound_frame(&detector->now) && detector->phase < config->steps_per_period && is_sound_count(detector) &&
           detector->frame_v_sum >= -SPEED_SUM_MAX && detector->frame_v_sum <= SPEED_SUM_MAX &&
           detector->evidence <= EVIDENCE_MOST && detector->hysteresis >= 0 &&
           (int64_t)detector->level - detector->hysteresis >= -INT32_MAX && detector_step(detector) <= STEPS_MAX &&
           is_sound_search(detector) && is_sound_verdict(&detector->verdict) && !detector->has_diverged;
}

bool snapshot_is_sound(const struct sim *sim, const struct input_queue *waiting, const struct sim_plan *plan)
{
    const bool is_sound_plant =
        plan->arithmetic == ARITH_Q27 ? is_sound_q27(&sim->q27, &plan->q27) : is_sound_f32(&sim->f32);

    return is_sound_plant && sim->fault == SIM_FAULT_NONE && sim->step <= STEPS_MAX && sim->v10_step <= STEPS_MAX &&
           sim->v10_fraction_q15 <= FRACTION_MAX_Q15 && sim->angle.rest <= REST_MAX &&
           is_within(sim->texture, TEXTURE_MAX) && is_sound_held(sim) && is_sound_acting(&sim->load) &&
           is_sound_acting(&sim->speed) && is_sound_waiting(waiting) && sim->measure.done <= sim->measure.planned &&
           sim->measure.planned <= STEPS_MAX && is_sound_detector(&sim->detector, &plan->detector);
}
