#include "protocol/frame.h"

#include "base/assert.h"
#include "base/bytes.h"
#include "base/compiler.h"
#include "base/crc32.h"

enum { DELIMITER = 0 };

BASE_STATIC_ASSERT(FRAME_SIZE_MAX <= 254, a_frame_is_stuffed_where_it_lies);
BASE_STATIC_ASSERT(FRAME_WIRE_MAX == 253, the_line_load_is_known);

bool frame_write(struct text *text, const struct frame *frame)
{
    uint8_t wire[FRAME_WIRE_MAX];
    struct bytes_writer writer = {.bytes = wire + 1, .capacity = FRAME_SIZE_MAX};
    size_t size;

    BASE_ASSERT(frame->size <= FRAME_PAYLOAD_MAX);
    bytes_put_u8(&writer, frame->type);
    bytes_put_u16(&writer, frame->sequence);
    bytes_put_u32(&writer, frame->step);
    bytes_put_block(&writer, frame->payload, frame->size);
    bytes_put_u32(&writer, crc32_add(0u, writer.bytes, writer.size));
    BASE_ASSERT(!writer.overflowed);
    size = cobs_encode(writer.bytes, writer.size, wire, FRAME_STUFFED_MAX);
    wire[size++] = DELIMITER;
    if (text_room(text) < size) {
        return false;
    }
    for (size_t i = 0u; i < size; i++) {
        text_put(text, (char)wire[i]);
    }
    return true;
}

static void start_anew(struct frame_receiver *receiver)
{
    receiver->size = 0u;
    receiver->is_damaged = false;
    receiver->is_too_long = false;
}

void frame_open(struct frame_receiver *receiver) { *receiver = (struct frame_receiver){.size = 0u}; }

void frame_damage(struct frame_receiver *receiver) { receiver->is_damaged = true; }

/* The counter of what becomes of the piece that has ended; size is that of the unstuffed frame. */
static uint32_t *judge(struct frame_receiver *receiver, size_t *size)
{
    struct bytes_reader crc;

    if (receiver->is_damaged) {
        return &receiver->damaged;
    }
    if (receiver->is_too_long) {
        return &receiver->too_long;
    }
    if (cobs_decode(receiver->bytes, receiver->size, size) != COBS_OK) {
        return &receiver->bad_cobs;
    }
    if (*size < FRAME_SIZE_MIN) {
        return &receiver->too_short;
    }
    crc = (struct bytes_reader){.bytes = receiver->bytes, .size = *size, .offset = *size - 4u};
    if (bytes_get_u32(&crc) != crc32_add(0u, receiver->bytes, *size - 4u)) {
        return &receiver->bad_crc;
    }
    return &receiver->accepted;
}

static void read_frame(const uint8_t *bytes, size_t size, struct frame *frame)
{
    struct bytes_reader reader = {.bytes = bytes, .size = size - 4u};

    frame->type = bytes_get_u8(&reader);
    frame->sequence = bytes_get_u16(&reader);
    frame->step = bytes_get_u32(&reader);
    frame->size = reader.size - reader.offset;
    frame->payload = bytes_get_block(&reader, frame->size);
}

static bool end_frame(struct frame_receiver *receiver, struct frame *frame)
{
    size_t size = 0u;
    uint32_t *outcome = judge(receiver, &size);
    const bool is_accepted = outcome == &receiver->accepted;

    (*outcome)++;
    if (is_accepted) {
        read_frame(receiver->bytes, size, frame);
    } else {
        receiver->garbage_bytes += (uint32_t)receiver->size;
    }
    start_anew(receiver);
    return is_accepted;
}

bool frame_take(struct frame_receiver *receiver, uint8_t byte, struct frame *frame)
{
    if (byte == DELIMITER) {
        return (receiver->size > 0u || receiver->is_damaged) && end_frame(receiver, frame);
    }
    if (receiver->size < FRAME_STUFFED_MAX) {
        receiver->bytes[receiver->size++] = byte;
    } else {
        receiver->is_too_long = true;
        receiver->garbage_bytes++;
    }
    return false;
}
