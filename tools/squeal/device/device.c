/* The connection: bytes between port and master, waiting, asking again, HELLO. */
#include "squeal/device/device_parts.h"

#include "squeal/support/clock.h"

#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#define RETRY_S 1.0
#define START_S 30.0

enum { READ_SIZE = 16384, TEXT_SIZE = 160 };

static const struct {
    uint8_t type;
    size_t size;
} replies[] = {
#define MESSAGE(type, field, name, request, reply, help) {type, reply},
#include "protocol/messages.def"
#undef MESSAGE
};

static size_t reply_size(uint8_t type)
{
    size_t i = 0;

    while (replies[i].type != type) {
        i++;
    }
    return replies[i].size;
}

void device_fail(struct device *device, const char *format, ...)
{
    va_list arguments;
    const int length = snprintf(device->problem, sizeof device->problem, "%s: ", device->port.name);

    va_start(arguments, format);
    (void)vsnprintf(device->problem + length, sizeof device->problem - (size_t)length, format, arguments);
    va_end(arguments);
}

static enum device_result lose_port(struct device *device)
{
    (void)snprintf(device->problem, sizeof device->problem, "%s", device->port.problem);
    device->is_lost = true;
    return DEVICE_LOST;
}

/* Sends what the port takes. False: it is gone. */
static bool send_out(struct device *device)
{
    size_t size;
    const uint8_t *bytes = text_peek(&device->out, &size);

    while (size > 0) {
        const ssize_t count = port_write(&device->port, bytes, size);
        if (count <= 0) {
            return count == 0;
        }
        text_drop(&device->out, (size_t)count);
        bytes = text_peek(&device->out, &size);
    }
    return true;
}

/* Keeps the reply's payload, which the next byte would overwrite: whoever asked reads it when all that came is
 * taken. */
static enum master_event bytes_take(struct device *device, const uint8_t *bytes, size_t size, struct frame *answer)
{
    enum master_event outcome = MASTER_NOTHING;
    struct frame frame;

    for (size_t i = 0; i < size; i++) {
        const enum master_event event = master_take(&device->master, bytes[i], &frame);
        if (event == MASTER_NOTHING) {
            continue;
        }
        device->heard_s = clock_now_s();
        if (event == MASTER_UNASKED && frame.type == LINK_SAMPLE) {
            device_take_sample(device, &frame);
        } else if (event == MASTER_UNASKED) {
            device_take_result(device, &frame);
        } else if (event == MASTER_ANSWERED || event == MASTER_REFUSED) {
            outcome = event;
            *answer = frame;
            memcpy(device->reply, frame.payload, frame.size);
            answer->payload = device->reply;
        }
    }
    return outcome;
}

/* Moves what can be moved. False: the port is gone. */
static bool turn(struct device *device, enum master_event *event, struct frame *answer)
{
    uint8_t bytes[READ_SIZE];
    const ssize_t count = send_out(device) ? port_read(&device->port, bytes, sizeof bytes) : -1;

    *event = MASTER_NOTHING;
    if (count < 0) {
        return false;
    }
    device->heard += (size_t)count;
    *event = bytes_take(device, bytes, (size_t)count, answer);
    return true;
}

static bool has_more(const struct device *device)
{
    size_t size;

    (void)text_peek(&device->out, &size);
    return size > 0;
}

static enum device_result fail_silent(struct device *device)
{
    device_fail(device, "no answer for %g s; a longer --limit waits longer", device->limit_s);
    device->is_lost = true;
    return DEVICE_LOST;
}

/* Waits for the answer to the request that is on its way. Samples are signs of life: the limit counts from the last
 * one. */
static enum device_result await(struct device *device, struct frame *answer)
{
    double asked_s = clock_now_s();

    device->heard_s = asked_s;
    for (;;) {
        enum master_event event;
        if (!turn(device, &event, answer)) {
            return lose_port(device);
        }
        if (event != MASTER_NOTHING) {
            return event == MASTER_ANSWERED ? DEVICE_OK : DEVICE_REFUSED;
        }
        const double now_s = clock_now_s();
        if (now_s - device->heard_s > device->limit_s) {
            return fail_silent(device);
        }
        if (now_s - asked_s > RETRY_S && now_s - device->heard_s > RETRY_S) {
            (void)master_ask_again(&device->master, &device->out); /* without room the line does not move anyway */
            asked_s = now_s;
        }
        (void)port_wait(&device->port, has_more(device), 0.1);
    }
}

static enum device_result settle(struct device *device, struct bytes_reader *reply)
{
    const uint8_t type = device->master.request.type;
    struct frame answer = {0};
    const enum device_result result = await(device, &answer);

    if (result == DEVICE_REFUSED) {
        master_read_refusal(&answer, &device->refusal);
        device_tell_refusal(device);
    }
    if (result != DEVICE_OK) {
        return result;
    }
    if (answer.size != reply_size(type)) {
        device_fail(device, "answers request 0x%02x with %zu bytes instead of %zu", type, answer.size,
                    reply_size(type));
        device->is_lost = true;
        return DEVICE_LOST;
    }
    *reply = (struct bytes_reader){.bytes = answer.payload, .size = answer.size};
    return DEVICE_OK;
}

enum device_result device_ask(struct device *device, enum link_message type, const struct bytes_writer *request,
                              struct bytes_reader *reply)
{
    struct bytes_reader unread;

    if (!master_ask(&device->master, &device->out, type, request != NULL ? request->bytes : NULL,
                    request != NULL ? request->size : 0u)) {
        return fail_silent(device);
    }
    return settle(device, reply != NULL ? reply : &unread);
}

enum device_result device_ask_step(struct device *device, uint32_t count, const struct input_demand *demand,
                                   struct master_state *state)
{
    struct bytes_reader reply;

    if (!master_step(&device->master, &device->out, count, demand)) {
        return fail_silent(device);
    }
    const enum device_result result = settle(device, &reply);
    if (result == DEVICE_OK) {
        master_read_state(&(struct frame){.payload = reply.bytes, .size = reply.size}, state);
        device->step = state->step;
    }
    return result;
}

enum device_result device_listen(struct device *device, double seconds)
{
    const double end_s = clock_now_s() + seconds;
    struct frame ignored;
    enum master_event event;

    do {
        if (!turn(device, &event, &ignored)) {
            return lose_port(device);
        }
    } while (port_wait(&device->port, has_more(device), end_s - clock_now_s()) && clock_now_s() < end_s);
    return DEVICE_OK;
}

void device_get_text(struct bytes_reader *reader, char *out, size_t width)
{
    char text[TEXT_SIZE];

    bytes_get_text(reader, text, width);
    (void)printable_copy(out, DEVICE_TEXT(width), text);
}

static void read_identity(struct device *device, struct bytes_reader *reply)
{
    struct device_identity *identity = &device->identity;

    identity->major = bytes_get_u8(reply);
    identity->minor = bytes_get_u8(reply);
    identity->params_version = bytes_get_u16(reply);
    identity->signals_version = bytes_get_u16(reply);
    identity->commands_version = bytes_get_u16(reply);
    for (int i = 0; i <= LINK_PRESETS; i++) {
        device->counts[i] = bytes_get_u8(reply);
    }
    const uint8_t flags = bytes_get_u8(reply);
    identity->is_emulated = (flags & LINK_IS_EMULATED) != 0;
    identity->has_fpu = (flags & LINK_HAS_FPU) != 0;
    (void)bytes_get_u16(reply); /* the largest payload, which a major version fixes */
    device_get_text(reply, identity->version, LINK_VERSION_WIDTH);
    device_get_text(reply, identity->build, LINK_BUILD_WIDTH);
    device_get_text(reply, identity->board, LINK_BOARD_WIDTH);
    device_get_text(reply, identity->core, LINK_CORE_WIDTH);
}

/* Nobody answered HELLO: say what the silence looks like. */
static void tell_stranger(struct device *device)
{
    if (device->heard > 0) {
        device_fail(
            device,
            "no squeal answers there: %zu bytes came, none of them a reply; is it the link's line, and the rate right?",
            device->heard);
    } else {
        device_fail(device, "no squeal answers there: not a byte came in %g s; is it running, and is this its link?",
                    device->limit_s);
    }
}

static bool greet(struct device *device, double limit_s)
{
    uint8_t bytes[2];
    struct bytes_writer request = {.bytes = bytes, .capacity = sizeof bytes};
    struct bytes_reader reply;

    bytes_put_u8(&request, LINK_MAJOR);
    bytes_put_u8(&request, LINK_MINOR);
    /* What was started a moment ago, an emulator on a busy machine at that, may take its time. */
    device->limit_s = device->port.pid != 0 && limit_s < START_S ? START_S : limit_s;
    const enum device_result result = device_ask(device, LINK_HELLO, &request, &reply);
    device->limit_s = limit_s;
    if (result == DEVICE_OK) {
        read_identity(device, &reply);
        return true;
    }
    if (result == DEVICE_REFUSED && device->refusal.error == ERROR_WRONG_VERSION) {
        device_fail(device, "speaks version %u of the link, this tool %d: use the tool of its firmware",
                    device->refusal.expected, LINK_MAJOR);
    } else if (result == DEVICE_LOST && device->port.problem[0] == '\0') {
        tell_stranger(device);
    }
    return false;
}

struct device *device_open(const char *port, double limit_s, char problem[DEVICE_PROBLEM_MAX])
{
    struct device *device = calloc(1, sizeof *device);

    if (device == NULL) {
        (void)snprintf(problem, DEVICE_PROBLEM_MAX, "out of memory");
        return NULL;
    }
    text_init(&device->out, device->out_bytes, sizeof device->out_bytes);
    master_init(&device->master);
    const bool is_open = port_open(&device->port, port);
    if (is_open && greet(device, limit_s)) {
        return device;
    }
    (void)snprintf(problem, DEVICE_PROBLEM_MAX, "%s", is_open ? device->problem : device->port.problem);
    device_close(device);
    return NULL;
}

void device_close(struct device *device)
{
    if (device == NULL) {
        return;
    }
    port_close(&device->port);
    for (int i = 0; i < LINK_TABLE_COUNT; i++) {
        free(device->tables[i]);
    }
    free(device);
}

const char *device_problem(const struct device *device) { return device->problem; }
const struct master_refusal *device_refusal(const struct device *device) { return &device->refusal; }
bool device_is_lost(const struct device *device) { return device->is_lost; }
const struct port *device_port(const struct device *device) { return &device->port; }
const struct device_identity *device_identity(const struct device *device) { return &device->identity; }
