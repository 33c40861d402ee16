/* The link's way in and out: bytes to requests, requests to their functions, replies to bytes. */
#include "protocol/link.h"

#include "base/assert.h"
#include "base/compiler.h"
#include "base/mem.h"
#include "protocol/link_parts.h"

static const struct message {
    uint8_t type, request, reply;
} messages[] = {
#define MESSAGE(type, field, name, request, reply, help) {type, request, reply},
#include "protocol/messages.def"
#undef MESSAGE
};

#define MESSAGE(type, field, name, request, reply, help)                                                     \
    BASE_STATIC_ASSERT((request) <= LINK_REQUEST_MAX && (reply) <= FRAME_PAYLOAD_MAX && (type) < LINK_REPLY, \
                       name##_fits);
#include "protocol/messages.def"
#undef MESSAGE

static const struct message *find_message(uint8_t type)
{
    for (size_t i = 0u; i < BASE_COUNT(messages); i++) {
        if (messages[i].type == type) {
            return &messages[i];
        }
    }
    return NULL;
}

void link_init(struct link *link, struct executive *executive, struct turn *turn, struct work *work, struct text *text,
               const struct identity *identity)
{
    BASE_ASSERT(text->capacity >= 2u * FRAME_WIRE_MAX);
    memset(link, 0, sizeof *link);
    link->executive = executive;
    link->turn = turn;
    link->work = work;
    link->text = text;
    link->identity = identity;
    frame_open(&link->receiver);
}

static bool has_room(const struct link *link) { return text_room(link->text) >= FRAME_WIRE_MAX; }

static void take_request(struct link *link, const struct frame *frame)
{
    struct link_request *request = &link->request;

    request->type = frame->type;
    request->sequence = frame->sequence;
    request->step = frame->step;
    request->size = frame->size;
    memcpy(request->payload, frame->payload, frame->size < LINK_REQUEST_MAX ? frame->size : LINK_REQUEST_MAX);
    link->has_request = true;
    link->phase = 0u;
}

size_t link_receive(struct link *link, const uint8_t *bytes, size_t size)
{
    struct frame frame;
    size_t taken = 0u;

    while (taken < size && !link->has_request && has_room(link)) {
        if (frame_take(&link->receiver, bytes[taken++], &frame)) {
            take_request(link, &frame);
        }
    }
    return taken;
}

void link_lost(struct link *link, uint32_t count)
{
    if (count > 0u) {
        frame_damage(&link->receiver);
    }
}

/* Room was looked for before the request was taken, and samples leave it free. */
static enum link_progress send(struct link *link, uint8_t type, uint32_t step)
{
    bool is_written;

    BASE_ASSERT(!link->reply.overflowed);
    is_written = frame_write(link->text, &(struct frame){.type = type,
                                                         .sequence = link->request.sequence,
                                                         .step = step,
                                                         .payload = link->reply_bytes,
                                                         .size = link->reply.size});
    BASE_ASSERT(is_written);
    return LINK_ANSWERED;
}

static uint32_t step_now(const struct link *link)
{
    struct executive_report report;

    executive_report(link->executive, &report);
    return (uint32_t)report.now.step;
}

enum link_progress link_answer_from(struct link *link, uint32_t step)
{
    BASE_ASSERT(link->reply.size == find_message(link->request.type)->reply);
    return send(link, link->request.type + LINK_REPLY, step);
}

enum link_progress link_answer(struct link *link) { return link_answer_from(link, step_now(link)); }

enum link_progress link_refuse(struct link *link, const struct link_refusal *refusal)
{
    link->refused++;
    link->reply.size = 0u;
    bytes_put_u8(&link->reply, link->request.type);
    bytes_put_u8(&link->reply, (uint8_t)refusal->error);
    bytes_put_u8(&link->reply, refusal->has_index ? refusal->index : LINK_NO_INDEX);
    bytes_put_u32(&link->reply, refusal->expected);
    bytes_put_f32(&link->reply, refusal->low);
    bytes_put_f32(&link->reply, refusal->high);
    BASE_ASSERT(link->reply.size == LINK_ERROR_SIZE);
    return send(link, LINK_ERROR, step_now(link));
}

enum link_progress link_refuse_plain(struct link *link, enum error error)
{
    return link_refuse(link, &(struct link_refusal){.error = error});
}

enum link_progress link_refuse_problem(struct link *link, const struct params_problem *problem)
{
    return link_refuse(
        link, &(struct link_refusal){.error = problem->error,
                                     .has_index = problem->info != NULL,
                                     .index = problem->info != NULL ? (uint8_t)(problem->info - params_table) : 0u,
                                     .low = problem->low,
                                     .high = problem->high});
}

enum link_progress link_refuse_field(struct link *link, uint8_t field, float low, float high)
{
    return link_refuse(link,
                       &(struct link_refusal){
                           .error = ERROR_OUT_OF_RANGE, .has_index = true, .index = field, .low = low, .high = high});
}

static enum link_progress obey(struct link *link)
{
    const struct message *message = find_message(link->request.type);

    if (message == NULL) {
        return link_refuse_plain(link, ERROR_UNKNOWN_TYPE);
    }
    if (link->request.size != message->request) {
        return link_refuse(link, &(struct link_refusal){.error = ERROR_BAD_LENGTH, .expected = message->request});
    }
    switch ((enum link_message)link->request.type) {
#define MESSAGE(type, field, name, request, reply, help) \
    case LINK_##field:                                   \
        return link_##name(link);
#include "protocol/messages.def"
#undef MESSAGE
    default:
        break;
    }
    return LINK_ANSWERED;
}

/* One look at the request under way. */
static enum link_progress go_on(struct link *link)
{
    enum link_progress progress;

    link->arguments = (struct bytes_reader){.bytes = link->request.payload, .size = LINK_REQUEST_MAX};
    link->reply = (struct bytes_writer){.bytes = link->reply_bytes, .capacity = sizeof link->reply_bytes};
    progress = obey(link);
    if (progress == LINK_ANSWERED) {
        link->has_request = false;
        turn_leave(link->turn, TURN_LINK);
    }
    return progress;
}

bool link_poll(struct link *link)
{
    bool is_busy = link_continue_study(link);

    is_busy = link_write_samples(link) || is_busy;
    if (link->has_request && !executive_has_order(link->executive)) {
        is_busy = go_on(link) != LINK_WAITS || is_busy;
    }
    return is_busy || executive_has_order(link->executive);
}
