/* Demands into inputs. */
#include "sim/input.h"

#include "base/fixed.h"
#include "base/fmath.h"
#include "model/plant.h"

/* The value inside its limits; *is_clamped is set where it was not. */
static float clamp(float value, float low, float high, bool *is_clamped)
{
    const float inside = fmath_min(fmath_max(value, low), high);

    *is_clamped = *is_clamped || inside != value;
    return inside;
}

bool input_derive(struct input *input, const struct input_demand *demand, const struct params *params,
                  const struct scale *scale)
{
    const float area = demand->load == INPUT_LOAD_PRESSURE ? params->piston_area_m2 : 1.0f;
    const float ratio = demand->speed == INPUT_SPEED_VEHICLE ? params->radius_m / params->tyre_radius_m : 1.0f;
    bool is_clamped = false;

    *input = (struct input){.step = demand->step, .starts = demand->starts};
    input->sets_load = demand->load != INPUT_LOAD_KEEP;
    input->holds_load = demand->load == INPUT_LOAD_FORCE || demand->load == INPUT_LOAD_PRESSURE;
    input->sets_speed = demand->speed != INPUT_SPEED_KEEP;
    input->holds_speed = demand->speed == INPUT_SPEED_DISC || demand->speed == INPUT_SPEED_VEHICLE;
    if (input->holds_load) {
        input->load =
            clamp(demand->load_value * area / scale->load_n, 0.0f, 1.0f / scale_peak_factor(params), &is_clamped);
        input->load_q27 = fixed_from_float(input->load, PLANT_FRACTION_BITS);
    }
    if (input->holds_speed) {
        input->speed = clamp(demand->speed_value * ratio / scale->speed_m_per_s, -1.0f, 1.0f, &is_clamped);
        input->speed_q27 = fixed_from_float(input->speed, PLANT_FRACTION_BITS);
    }
    return is_clamped;
}

void input_take(struct input_state *state, const struct input *input)
{
    if (input->sets_load) {
        state->holds_load = input->holds_load;
        state->load = input->load;
        state->load_q27 = input->load_q27;
    }
    if (input->sets_speed) {
        state->holds_speed = input->holds_speed;
        state->speed = input->speed;
        state->speed_q27 = input->speed_q27;
    }
}

void input_queue_put(struct input_queue *queue, const struct input *input)
{
    uint32_t place = queue->count;

    for (; place > 0u && queue->waiting[place - 1u].step > input->step; place--) {
        queue->waiting[place] = queue->waiting[place - 1u];
    }
    queue->waiting[place] = *input;
    queue->count++;
}

bool input_queue_take(struct input_queue *queue, uint64_t step, struct input *input)
{
    if (queue->count == 0u || queue->waiting[0].step > step) {
        return false;
    }
    *input = queue->waiting[0];
    queue->count--;
    for (uint32_t i = 0u; i < queue->count; i++) {
        queue->waiting[i] = queue->waiting[i + 1u];
    }
    return true;
}
