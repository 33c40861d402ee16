/* What moves the plant, and what tells how it stands. */
#include "squeal/device/device_parts.h"

#include "squeal/support/clock.h"

enum { STEPS_FIRST = 256, STEPS_MAX = 1000000 };

/* A STEP takes about this long, so that an answer never lets wait for it, however slow the board. */
#define ASK_S 0.2

static enum device_result ask_where(struct device *device, enum link_message type, uint64_t *step)
{
    struct bytes_reader reply;
    const enum device_result result = device_ask(device, type, NULL, &reply);

    if (result == DEVICE_OK) {
        device->step = bytes_get_u64(&reply);
        if (step != NULL) {
            *step = device->step;
        }
    }
    return result;
}

enum device_result device_run(struct device *device, uint64_t *step) { return ask_where(device, LINK_RUN, step); }
enum device_result device_stop(struct device *device, uint64_t *step) { return ask_where(device, LINK_STOP, step); }
enum device_result device_reset(struct device *device, uint64_t *step) { return ask_where(device, LINK_RESET, step); }

/* Twice as much after a short while, half after a long one. */
static void adapt(struct device *device, double took_s)
{
    if (took_s < 0.5 * ASK_S && device->steps_a_ask < STEPS_MAX) {
        device->steps_a_ask *= 2;
    } else if (took_s > 2.0 * ASK_S && device->steps_a_ask > 1) {
        device->steps_a_ask /= 2;
    }
}

enum device_result device_step(struct device *device, uint64_t count, const struct input_demand *demand,
                               struct master_state *state)
{
    const struct input_demand keep = {.load = INPUT_LOAD_KEEP, .speed = INPUT_SPEED_KEEP};
    enum device_result result = DEVICE_OK;

    device->steps_a_ask = device->steps_a_ask == 0 ? STEPS_FIRST : device->steps_a_ask;
    while (count > 0 && result == DEVICE_OK) {
        uint64_t part = device->steps_a_ask < STEPS_MAX ? device->steps_a_ask : STEPS_MAX;
        const double begin_s = clock_now_s();
        part = count < part ? count : part;
        result = device_ask_step(device, (uint32_t)part, demand != NULL ? demand : &keep, state);
        if (result == DEVICE_OK && (state->flags & (LINK_IS_FAULT | LINK_WAS_CUT)) != 0) {
            break;
        }
        adapt(device, part == device->steps_a_ask ? clock_now_s() - begin_s : ASK_S);
        demand = NULL;
        count -= part;
    }
    return result;
}

enum device_result device_input(struct device *device, const struct input_demand *demand, bool *was_clamped)
{
    uint8_t bytes[18];
    struct bytes_writer request = {.bytes = bytes, .capacity = sizeof bytes};
    struct bytes_reader reply;

    bytes_put_u64(&request, demand->step);
    bytes_put_u8(&request, (uint8_t)demand->load);
    bytes_put_u8(&request, (uint8_t)demand->speed);
    bytes_put_f32(&request, demand->load_value);
    bytes_put_f32(&request, demand->speed_value);
    const enum device_result result = device_ask(device, LINK_INPUT, &request, &reply);
    if (result == DEVICE_OK && was_clamped != NULL) {
        *was_clamped = bytes_get_u8(&reply) != 0;
    }
    return result;
}

enum device_result device_status(struct device *device, struct device_status *status)
{
    struct bytes_reader reply;
    const enum device_result result = device_ask(device, LINK_STATUS, NULL, &reply);

    if (result != DEVICE_OK) {
        return result;
    }
    status->state = bytes_get_u8(&reply);
    status->step = bytes_get_u64(&reply);
    status->generation = bytes_get_u32(&reply);
    status->hash = bytes_get_u32(&reply);
    status->set_crc = bytes_get_u32(&reply);
    status->step_s = bytes_get_f32(&reply);
    status->sigma = bytes_get_f32(&reply);
    uint32_t *const counters[] = {
        &status->events,    &status->caps,        &status->saturations,    &status->lifted,
        &status->gap_held,  &status->ticks,       &status->overruns,       &status->shed,
        &status->inputs,    &status->inputs_late, &status->inputs_clamped, &status->inputs_refused,
        &status->offered,   &status->sent,        &status->dropped,        &status->waiting,
        &status->frames,    &status->damaged,     &status->too_long,       &status->bad_cobs,
        &status->too_short, &status->bad_crc,     &status->garbage_bytes,  &status->refused};
    for (size_t i = 0; i < sizeof counters / sizeof counters[0]; i++) {
        *counters[i] = bytes_get_u32(&reply);
    }
    status->input_state = bytes_get_u8(&reply);
    status->times_stale = bytes_get_u32(&reply);
    status->times_safe = bytes_get_u32(&reply);
    device->step = status->step;
    return DEVICE_OK;
}

enum device_result device_ping(struct device *device, uint64_t word, uint64_t *echo)
{
    uint8_t bytes[8];
    struct bytes_writer request = {.bytes = bytes, .capacity = sizeof bytes};
    struct bytes_reader reply;

    bytes_put_u64(&request, word);
    const enum device_result result = device_ask(device, LINK_PING, &request, &reply);
    if (result == DEVICE_OK) {
        *echo = bytes_get_u64(&reply);
    }
    return result;
}
