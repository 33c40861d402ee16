/* Closed-form prediction. Everything here is in the model's units: see model/scale.h. */
#include "analysis/predictor.h"

#include "analysis/floquet.h"
#include "base/fmath.h"
#include "model/demand.h"
#include "model/sine.h"

#define RATE_MARGIN 1e-4f    /* of the growth rate: 6e-4 a period is too close to call */
#define TOUCH_SURE 1.025f    /* its mean, and its second harmonic, may keep it off the disc up to here */
#define RESPONSE_MAX 1024.0f /* no finite response is trusted beyond it */
#define BOUNCE_GAIN 64.0f    /* of a bouncing pad, whose contact is no sine */

/* Free normal oscillation: deviation from the load's own solution. */
struct oscillation {
    float y, w;
};

static float hypotenuse(float a, float b) { return fmath_sqrt(a * a + b * b); }

static struct predictor_finish find_finish(const struct params *params, const struct scale *scale)
{
    struct predictor_finish finish;

    finish.load = demand_load_end_n(params) / scale->load_n;
    finish.speed = fmath_abs(demand_speed_end_m_per_s(params)) / scale->speed_m_per_s;
    finish.friction = scale->friction + scale->friction_slope * finish.speed;
    finish.is_on_floor = scale->has_floor && finish.friction <= scale->friction_floor;
    finish.friction = fmath_abs(finish.is_on_floor ? scale->friction_floor : finish.friction);
    finish.slope = finish.is_on_floor ? 0.0f : scale->friction_slope * finish.load;
    finish.share = 0.0f;
    return finish;
}

/* A free oscillation after some time without damping. */
static struct oscillation turned(struct oscillation start, float time_s, const struct scale *scale)
{
    const float turns = time_s / (scale->step_s * (float)scale->steps_per_period);
    const float fraction = turns < 1e6f ? turns - (float)(uint32_t)turns : 0.0f;
    const uint32_t phase = (uint32_t)(fraction * 4294967040.0f);
    const float sine = fmath_sine_turns(phase);
    const float cosine = fmath_sine_turns(phase + (1u << 30));

    return (struct oscillation){start.y * cosine + start.w * sine, start.w * cosine - start.y * sine};
}

/* The load goes from one value to another in a straight line, from the moment up to which free is known. */
static struct oscillation driven(struct oscillation free, float before, float after, float length_s,
                                 const struct scale *scale)
{
    const float rise = length_s > 0.0f ? (after - before) / (length_s * scale->omega_rad_per_s) : 0.0f;

    if (length_s <= 0.0f) {
        free.y += before - after;
        return free;
    }
    free.w -= rise;
    free = turned(free, length_s, scale);
    free.w += rise;
    return free;
}

/* What the changes of the load leave behind, from the moment of the first to that of the last; *length_s tells how long
 * that is. */
static struct oscillation left_by_changes(const struct demand *load, const struct scale *scale, float *length_s)
{
    struct oscillation free = {0.0f, 0.0f};

    *length_s = 0.0f;
    if (load->kind == DEMAND_STEP || load->kind == DEMAND_RAMP || load->kind == DEMAND_PULSES) {
        const float before = demand_begin(load) / scale->load_n;

        *length_s = load->kind == DEMAND_RAMP     ? load->end_s - load->start_s
                    : load->kind == DEMAND_PULSES ? load->rise_s
                                                  : 0.0f;
        return driven(free, before, demand_end(load) / scale->load_n, *length_s, scale);
    }
    for (uint32_t i = 1u; load->kind == DEMAND_TABLE && i < load->table->count; i++) {
        const struct params_point *point = &load->table->points[i];
        const float before = demand_limit(load, point[-1].value) / scale->load_n;
        const float after = demand_limit(load, point->value) / scale->load_n;

        free = driven(free, before, after, point->time_s - point[-1].time_s, scale);
        *length_s += point->time_s - point[-1].time_s;
    }
    return free;
}

/* A lag answers an oscillation at wn by 1/(1 + i wn lag). */
static struct oscillation lagged(struct oscillation free, float lag_s, const struct scale *scale)
{
    const float turn = lag_s * scale->omega_rad_per_s;
    const float size = 1.0f + turn * turn;

    return (struct oscillation){(free.y - turn * free.w) / size, (free.w + turn * free.y) / size};
}

/* Amplitude of the free normal oscillation that the onset of the load leaves behind, in n_max/ke, before damping. */
static float onset_amplitude(const struct params *params, const struct scale *scale)
{
    const struct demand load = demand_of_load(params);
    const float start_s = load.kind == DEMAND_TABLE ? load.table->points[0].time_s : load.start_s;
    float length_s;
    const struct oscillation changes = lagged(left_by_changes(&load, scale, &length_s), load.lag_s, scale);
    struct oscillation free = {params->y_initial_m / scale->normal_m - demand_begin(&load) / scale->load_n,
                               params->yd_initial_m_per_s / (scale->normal_m * scale->omega_rad_per_s)};

    if (load.kind != DEMAND_CONSTANT && load.kind != DEMAND_SINE) {
        free = turned(turned(free, start_s, scale), length_s, scale);
    }
    return hypotenuse(free.y + changes.y, free.w + changes.w);
}

/* Response of the pad to a normal oscillation of amplitude 1 at a multiple of wn, per unit of friction. */
static float transfer(const struct scale *scale, float damping, float frequency)
{
    const float size = hypotenuse(scale->stiffness - frequency * frequency, damping * frequency);

    return size > 1.0f / RESPONSE_MAX ? 1.0f / size : RESPONSE_MAX;
}

/* Speed of the tangential transient that starts with the load. */
static float transient_speed(const struct params *params, const struct scale *scale,
                             const struct predictor_finish *finish, float amplitude)
{
    const float z = fmath_sqrt(scale->stiffness);
    const float damping = scale->damping + finish->slope;
    const float forced = amplitude * transfer(scale, damping, 1.0f) * (scale->stiffness < 1.0f ? -1.0f : 1.0f);
    const struct demand load = demand_of_load(params);
    float mean = finish->load;
    float length_s = 0.0f;
    float offset;

    if (load.kind == DEMAND_RAMP || load.kind == DEMAND_PULSES) {
        (void)left_by_changes(&load, scale, &length_s);
    }

    if (z == 0.0f) {
        return 0.0f;
    }
    if (length_s > 0.0f) {
        /* A ramp kicks at its start and at its end, each time by its rate. */
        mean = 2.0f * finish->load / (length_s * scale->omega_rad_per_s * z);
        mean = fmath_min(mean, finish->load);
    }
    mean /= hypotenuse(1.0f, params->load_lag_s * scale->omega_rad_per_s * z);
    offset = finish->friction * (mean / scale->stiffness - forced) - params->x_initial_m / scale->length_m;
    return hypotenuse(z * offset, params->xd_initial_m_per_s / scale->speed_m_per_s);
}

/* Damping takes the free normal oscillation away; a pad that is let go without load does not come back. */
static bool normal_motion_ends(const struct params *params, const struct scale *scale,
                               const struct predictor_finish *finish)
{
    return scale->normal_damping > 0.0f || (finish->load == 0.0f && (int)params->contact == CONTACT_LIFT);
}

/* An undamped pad that lifts off bounces for ever: its contact force is no longer a sine, and no closed form serves. */
static bool bounces(const struct params *params, const struct predictor_finish *finish, float onset)
{
    return (int)params->contact == CONTACT_LIFT && finish->load > 0.0f && onset > finish->load;
}

/* Motion on the floor that reaches back across the knee, where friction falls and feeds it: that of the onset is
 * enough. */
static bool crosses_knee(const struct scale *scale, const struct prediction *prediction,
                         const struct predictor_finish *finish)
{
    const float slowest = finish->speed * (1.0f - fmath_max(prediction->touch_ratio, prediction->onset_touch_ratio));

    return prediction->is_bistable && scale->friction + scale->friction_slope * slowest > scale->friction_floor;
}

static enum predictor_verdict judge(const struct prediction *prediction, const struct predictor_finish *finish)
{
    if (finish->speed == 0.0f) {
        return PREDICTION_UNKNOWN;
    }
    if (prediction->rate > 0.0f || prediction->touch_ratio >= TOUCH_SURE) {
        return PREDICTION_SQUEAL;
    }
    return prediction->rate > -RATE_MARGIN || prediction->touch_ratio > PREDICTOR_TOUCH_MARGIN ? PREDICTION_WATCH
                                                                                               : PREDICTION_QUIET;
}

struct predictor_finish predictor_finish(const struct params *params, const struct scale *scale)
{
    struct predictor_finish finish = find_finish(params, scale);

    if (finish.load > 0.0f && !normal_motion_ends(params, scale, &finish)) {
        finish.share = onset_amplitude(params, scale) / finish.load;
    }
    return finish;
}

struct prediction predictor_predict(const struct params *params, const struct scale *scale)
{
    const struct predictor_finish finish = predictor_finish(params, scale);
    const struct predictor_response response = predictor_response(params, scale);
    const float onset = onset_amplitude(params, scale);
    const float lasting = normal_motion_ends(params, scale, &finish) ? 0.0f : onset;
    const float forced = finish.friction * transfer(scale, scale->damping + finish.slope, 1.0f);
    struct prediction prediction;

    prediction.rate =
        floquet_rate_closed(&(struct floquet_problem){scale->damping, finish.slope, scale->stiffness, finish.share});
    prediction.touch_ratio = 0.0f;
    prediction.onset_touch_ratio = 0.0f;
    if (finish.speed > 0.0f) {
        prediction.touch_ratio = (lasting * forced + response.load_response) / finish.speed;
        prediction.onset_touch_ratio =
            (onset * forced + response.load_response + transient_speed(params, scale, &finish, onset)) / finish.speed;
    }
    prediction.is_bistable = finish.is_on_floor && scale->damping + scale->friction_slope * finish.load < 0.0f;
    prediction.verdict = judge(&prediction, &finish);
    if (prediction.verdict != PREDICTION_UNKNOWN &&
        (bounces(params, &finish, onset) || crosses_knee(scale, &prediction, &finish))) {
        prediction.verdict = PREDICTION_WATCH;
    }
    return prediction;
}

/* A sine on the load adds what it moves. */
static void add_sine(struct predictor_response *response, const struct scale *scale, float friction, float damping,
                     float frequency_hz, float amplitude_n)
{
    const float turns = frequency_hz * scale->step_s * (float)scale->steps_per_period;
    const float size = hypotenuse(1.0f - turns * turns, scale->normal_damping * turns);
    const float swing = amplitude_n / scale->load_n / fmath_max(size, 1.0f / RESPONSE_MAX);

    response->load_speed += swing * turns;
    response->load_response += friction * swing * turns * transfer(scale, damping, turns);
}

struct predictor_response predictor_response(const struct params *params, const struct scale *scale)
{
    const struct demand load = demand_of_load(params);
    const struct predictor_finish finish = find_finish(params, scale);
    const float damping = scale->damping + finish.slope;
    const float friction = fmath_max(scale->friction, finish.friction);
    struct predictor_response response = {friction * transfer(scale, damping, 1.0f), 0.0f, 0.0f};

    if (bounces(params, &finish, onset_amplitude(params, scale))) {
        response.gain = BOUNCE_GAIN;
    }

    if (load.kind == DEMAND_SINE) {
        const float turn = load.lag_s * load.frequency_hz * (2.0f * FMATH_PI);

        add_sine(&response, scale, friction, damping, load.frequency_hz, load.to / hypotenuse(1.0f, turn));
    }
    if (load.dither > 0.0f) {
        add_sine(&response, scale, friction, damping, load.dither_hz, load.dither);
    }
    return response;
}

const char *predictor_verdict_name(enum predictor_verdict verdict)
{
    static const char *const names[] = {"unknown", "quiet", "watch", "squeal"};

    return names[verdict];
}
