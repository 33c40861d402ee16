#include "protocol/master.h"

#include "base/bytes.h"
#include "base/mem.h"

void master_init(struct master *master)
{
    memset(master, 0, sizeof *master);
    frame_open(&master->receiver);
}

static bool has_room(const struct text *out) { return text_room(out) >= FRAME_WIRE_MAX + 1u; }

static void send(struct master *master, struct text *out)
{
    if (!master->is_clear) {
        text_put(out, '\0');
    }
    (void)frame_write(out, &master->request); /* there is room */
    master->is_waiting = true;
    master->is_clear = false;
}

static bool ask(struct master *master, struct text *out, const struct frame *request)
{
    if (!has_room(out)) {
        return false;
    }
    master->request = *request;
    if (request->size > 0u) {
        memcpy(master->payload, request->payload, request->size);
    }
    master->request.payload = master->payload;
    master->repeats = 0u;
    send(master, out);
    return true;
}

bool master_ask(struct master *master, struct text *out, enum link_message type, const void *payload, size_t size)
{
    const struct frame request = {
        .type = (uint8_t)type, .sequence = (uint16_t)(master->sequence + 1u), .payload = payload, .size = size};

    if (!ask(master, out, &request)) {
        return false;
    }
    master->sequence = request.sequence;
    return true;
}

bool master_step(struct master *master, struct text *out, uint32_t count, const struct input_demand *demand)
{
    uint8_t bytes[14];
    struct bytes_writer fields = {.bytes = bytes, .capacity = sizeof bytes};

    bytes_put_u32(&fields, count);
    bytes_put_u8(&fields, (uint8_t)(demand->load | (demand->starts ? LINK_STARTS : 0)));
    bytes_put_u8(&fields, (uint8_t)demand->speed);
    bytes_put_f32(&fields, demand->load_value);
    bytes_put_f32(&fields, demand->speed_value);
    return ask(master, out,
               &(struct frame){.type = LINK_STEP,
                               .sequence = (uint16_t)(master->step_sequence + 1u),
                               .step = master->step,
                               .payload = bytes,
                               .size = fields.size});
}

bool master_ask_again(struct master *master, struct text *out)
{
    if (!master->is_waiting || !has_room(out)) {
        return false;
    }
    master->repeats++;
    send(master, out);
    return true;
}

/* A refused STEP does not count: the next one has its sequence again. */
static enum master_event close_request(struct master *master, const struct frame *frame, enum master_event event)
{
    master->is_waiting = false;
    master->is_clear = true;
    master->step = frame->step;
    if (frame->type == LINK_STEP + LINK_REPLY) {
        master->step_sequence = frame->sequence;
    }
    return event;
}

/* A refused STEP and the next one have the same sequence, so a second refusal of the first could pass for one of the
 * next. Byte for byte the same, it is taken for such an echo; if that is wrong, the request is asked again and refused
 * again. */
static bool is_echo(struct master *master, const struct frame *frame)
{
    if (master->echoes == 0u || memcmp(frame->payload, master->refusal, LINK_ERROR_SIZE) != 0) {
        return false;
    }
    master->echoes--;
    return true;
}

static enum master_event refuse(struct master *master, const struct frame *frame)
{
    master->echoes = master->repeats;
    memcpy(master->refusal, frame->payload, LINK_ERROR_SIZE);
    return close_request(master, frame, MASTER_REFUSED);
}

static enum master_event sort(struct master *master, const struct frame *frame)
{
    const struct frame *request = &master->request;

    if (frame->type < LINK_REPLY) {
        return MASTER_UNASKED;
    }
    if (master->is_waiting && frame->sequence == request->sequence) {
        if (frame->type == request->type + LINK_REPLY) {
            return close_request(master, frame, MASTER_ANSWERED);
        }
        if (frame->type == LINK_ERROR && frame->size == LINK_ERROR_SIZE && frame->payload[0] == request->type &&
            !is_echo(master, frame)) {
            return refuse(master, frame);
        }
    }
    master->strays++;
    return MASTER_STRAY;
}

enum master_event master_take(struct master *master, uint8_t byte, struct frame *frame)
{
    return frame_take(&master->receiver, byte, frame) ? sort(master, frame) : MASTER_NOTHING;
}

void master_read_refusal(const struct frame *frame, struct master_refusal *refusal)
{
    struct bytes_reader fields = {.bytes = frame->payload, .size = frame->size};

    refusal->type = bytes_get_u8(&fields);
    refusal->error = bytes_get_u8(&fields);
    refusal->index = bytes_get_u8(&fields);
    refusal->expected = bytes_get_u32(&fields);
    refusal->low = bytes_get_f32(&fields);
    refusal->high = bytes_get_f32(&fields);
}

void master_read_state(const struct frame *frame, struct master_state *state)
{
    struct bytes_reader fields = {.bytes = frame->payload, .size = frame->size};

    state->step = bytes_get_u64(&fields);
    state->hash = bytes_get_u32(&fields);
    state->x_m = bytes_get_f32(&fields);
    state->xd_m_per_s = bytes_get_f32(&fields);
    state->y_m = bytes_get_f32(&fields);
    state->yd_m_per_s = bytes_get_f32(&fields);
    state->load_n = bytes_get_f32(&fields);
    state->friction_n = bytes_get_f32(&fields);
    state->disc_m_per_s = bytes_get_f32(&fields);
    state->mode = (int8_t)bytes_get_u8(&fields);
    state->propensity = bytes_get_u8(&fields);
    state->motion = bytes_get_u8(&fields);
    state->period = bytes_get_u8(&fields);
    state->flags = bytes_get_u8(&fields);
}
