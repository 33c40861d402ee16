/* The link's line: every good frame that goes in has one reply that comes out, in this order, and nothing else
 * comes. */
#include <string.h>

#include "firmware.h"
#include "watch_parts.h"

enum { PENDING_MAX = 512, PIECE_MAX = 252, CRC_SIZE = 4, HEAD_SIZE = 7, UNSOLICITED_MIN = 0x40, SEQUENCES = 0x10000 };

struct watch_client watch_client;

/* Bytes since the last 00. */
struct piece {
    uint8_t bytes[PIECE_MAX];
    size_t size;
    bool is_damaged, is_too_long;
};

static struct {
    struct piece in, out;
    struct request {
        uint8_t type;
        uint16_t sequence;
    } pending[PENDING_MAX];
    unsigned first, count; /* of those pending */
    uint32_t accepted, samples;
    uint16_t next_sample; /* sequence, if none is lost */
} seen;

void watch_link_reset(void)
{
    memset(&watch_client, 0, sizeof watch_client);
    seen.in.size = seen.out.size = 0u;
    seen.in.is_damaged = seen.in.is_too_long = seen.out.is_damaged = seen.out.is_too_long = false;
    seen.first = seen.count = 0u;
    seen.accepted = seen.samples = 0u;
    seen.next_sample = 0u;
}

void watch_link_lost(void) { seen.in.is_damaged = true; }

uint32_t watch_link_samples(void) { return seen.samples; }

unsigned watch_unanswered(void) { return seen.count; }

static uint32_t crc_of(const uint8_t *bytes, size_t size)
{
    static uint32_t table[256];
    uint32_t crc = 0xffffffffu;

    for (uint32_t i = 0u; table[1] == 0u || (i != 0u && i < 256u); i++) {
        uint32_t word = i;

        for (unsigned bit = 0u; bit < 8u; bit++) {
            word = (word & 1u) != 0u ? word >> 1u ^ 0xedb88320u : word >> 1u;
        }
        table[i] = word;
    }
    for (size_t i = 0u; i < size; i++) {
        crc = crc >> 8u ^ table[(crc ^ bytes[i]) & 0xffu];
    }
    return ~crc;
}

static uint32_t word_at(const uint8_t *bytes, unsigned size)
{
    uint32_t word = 0u;

    while (size-- > 0u) {
        word = word << 8u | bytes[size];
    }
    return word;
}

/* Size of the frame without its CRC, in frame; 0: it is none. */
static size_t open_piece(const struct piece *piece, uint8_t frame[PIECE_MAX])
{
    size_t size = 0u;

    if (piece->is_damaged || piece->is_too_long) {
        return 0u;
    }
    for (size_t at = 0u; at < piece->size;) {
        const size_t code = piece->bytes[at];

        if (at + code > piece->size) {
            return 0u;
        }
        memcpy(frame + size, piece->bytes + at + 1u, code - 1u);
        size += code - 1u;
        at += code;
        if (at < piece->size) {
            frame[size++] = 0u;
        }
    }
    if (size < HEAD_SIZE + CRC_SIZE || crc_of(frame, size - CRC_SIZE) != word_at(frame + size - CRC_SIZE, CRC_SIZE)) {
        return 0u;
    }
    return size - CRC_SIZE;
}

/* Takes a byte; at the end of a piece that is not empty true comes back, and the piece stays until the next byte. */
static bool has_ended(struct piece *piece, uint8_t byte)
{
    if (byte == 0u) {
        return piece->size > 0u || piece->is_damaged;
    }
    if (piece->size == PIECE_MAX) {
        piece->is_too_long = true;
        return false;
    }
    piece->bytes[piece->size++] = byte;
    return false;
}

static void begin_piece(struct piece *piece)
{
    piece->size = 0u;
    piece->is_damaged = false;
    piece->is_too_long = false;
}

static void expect_reply(const uint8_t *frame)
{
    WATCH(seen.count < PENDING_MAX);
    seen.pending[(seen.first + seen.count++) % PENDING_MAX] =
        (struct request){.type = frame[0], .sequence = (uint16_t)word_at(frame + 1, 2u)};
    seen.accepted++;
}

void watch_link_taken(const uint8_t *bytes, size_t size)
{
    uint8_t frame[PIECE_MAX];

    for (size_t i = 0u; i < size; i++) {
        if (!has_ended(&seen.in, bytes[i])) {
            continue;
        }
        if (open_piece(&seen.in, frame) != 0u) {
            expect_reply(frame);
        }
        begin_piece(&seen.in);
    }
    WATCH(firmware.link->receiver.accepted == seen.accepted);
}

static size_t reply_size(uint8_t type)
{
    switch (type) {
#define MESSAGE(type, field, name, request, reply, help) \
    case type:                                           \
        return reply;
#include "protocol/messages.def"
#undef MESSAGE
    default:
        return SIZE_MAX;
    }
}

static void learn(const struct request *request, const uint8_t *frame)
{
    const uint8_t *payload = frame + HEAD_SIZE;

    watch_client.step = word_at(frame + 3, 4u);
    if (request->type == LINK_STAGE) {
        watch_client.crc = word_at(payload + 5, 4u);
    } else if (request->type == LINK_TABLE) {
        watch_client.crc = word_at(payload + 4, 4u);
    } else if (request->type == LINK_REVERT) {
        watch_client.crc = word_at(payload, 4u);
    } else if (request->type == LINK_STEP) {
        watch_client.step_sequence = request->sequence;
    } else if (request->type == LINK_STREAM) {
        seen.next_sample = 0u;
    }
}

/* A gap in their numbers says what was lost; they never go back. */
static void take_sample(const uint8_t *frame, size_t size)
{
    const uint16_t sequence = (uint16_t)word_at(frame + 1, 2u);

    WATCH(size % 4u == 0u && size <= 4u * 32u);
    WATCH((uint16_t)(sequence - seen.next_sample) < SEQUENCES / 2u);
    seen.next_sample = (uint16_t)(sequence + 1u);
    seen.samples++;
}

static void take_reply(const uint8_t *frame, size_t size)
{
    const struct request request = seen.pending[seen.first];

    WATCH(seen.count > 0u);
    WATCH(word_at(frame + 1, 2u) == request.sequence);
    seen.first = (seen.first + 1u) % PENDING_MAX;
    seen.count--;
    if (frame[0] == LINK_ERROR) {
        WATCH(size == LINK_ERROR_SIZE && frame[HEAD_SIZE] == request.type);
        watch_client.step = word_at(frame + 3, 4u);
        return;
    }
    WATCH(frame[0] == request.type + LINK_REPLY);
    WATCH(size == reply_size(request.type));
    learn(&request, frame);
}

void watch_link_sent(const uint8_t *bytes, size_t size)
{
    uint8_t frame[PIECE_MAX];

    for (size_t i = 0u; i < size; i++) {
        size_t length;

        if (!has_ended(&seen.out, bytes[i])) {
            WATCH(bytes[i] != 0u && !seen.out.is_too_long);
            continue;
        }
        length = open_piece(&seen.out, frame);
        WATCH(length != 0u);
        begin_piece(&seen.out);
        if (frame[0] == LINK_SAMPLE) {
            take_sample(frame, length - HEAD_SIZE);
        } else if (frame[0] < UNSOLICITED_MIN || frame[0] >= LINK_REPLY) {
            take_reply(frame, length - HEAD_SIZE);
        }
    }
}
