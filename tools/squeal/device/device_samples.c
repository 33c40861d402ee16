/* Samples: which are wanted, and what comes. */
#include "squeal/device/device_parts.h"

uint64_t device_step_of(const struct device *device, uint32_t low)
{
    return device->step + (uint64_t)(int64_t)(int32_t)(low - (uint32_t)device->step);
}

void device_take_sample(struct device *device, const struct frame *frame)
{
    struct bytes_reader words = {.bytes = frame->payload, .size = frame->size};
    struct device_sample sample = {.step = device_step_of(device, frame->step),
                                   .missing = (uint16_t)(frame->sequence - device->sample_sequence),
                                   .count = device->signal_count,
                                   .signal = device->signals};

    /* One of another stream than was asked for last tells nothing. */
    if (device->signal_count == 0 || frame->size != 4u * device->signal_count) {
        return;
    }
    device->sample_sequence = (uint16_t)(frame->sequence + 1u);
    device->step = sample.step;
    for (size_t i = 0; i < sample.count; i++) {
        sample.value[i] = device_number(device, device->signals[i], bytes_get_u32(&words));
    }
    if (device->listener != NULL) {
        device->listener(device->context, &sample);
    }
}

void device_on_sample(struct device *device, device_listener listener, void *context)
{
    device->listener = listener;
    device->context = context;
}

static enum device_result ask_stream(struct device *device, uint32_t bitmap, uint32_t every,
                                     struct device_stream *stream)
{
    uint8_t bytes[8];
    struct bytes_writer request = {.bytes = bytes, .capacity = sizeof bytes};
    struct bytes_reader reply;

    bytes_put_u32(&request, bitmap);
    bytes_put_u32(&request, every);
    const enum device_result result = device_ask(device, LINK_STREAM, &request, &reply);
    if (result == DEVICE_OK) {
        stream->every = bytes_get_u32(&reply);
        stream->smallest = bytes_get_u32(&reply);
        stream->bytes = bytes_get_u16(&reply);
    }
    return result;
}

enum device_result device_stream(struct device *device, const int *signals, size_t count, uint32_t every,
                                 struct device_stream *stream)
{
    struct device_stream unread;
    uint32_t bitmap = 0;
    enum device_result result = device_read_table(device, DEVICE_SIGNALS); /* which are bits, which are floats */

    stream = stream != NULL ? stream : &unread;
    for (size_t i = 0; i < count; i++) {
        bitmap |= UINT32_C(1) << signals[i];
    }
    /* What streams, even for somebody before us, ends first: all its samples come before the reply, and none that comes
     * later can be taken for one of the new. */
    result = result == DEVICE_OK ? ask_stream(device, 0, 0, stream) : result;
    if (result != DEVICE_OK || every == 0) {
        device->signal_count = result == DEVICE_OK ? 0 : device->signal_count;
        return result;
    }
    device->signal_count = 0;
    for (int i = 0; i < DEVICE_SIGNALS_MAX; i++) {
        if ((bitmap >> i & 1u) != 0) {
            device->signals[device->signal_count++] = i;
        }
    }
    device->sample_sequence = 0;
    result = ask_stream(device, bitmap, every, stream);
    device->signal_count = result == DEVICE_OK ? device->signal_count : 0;
    return result;
}
