/* frames: random frames through the codec and a bad line, and whether one arrives that was not sent.
 *   frames [--frames n] [--ber p] [--drop p] [--double p] [--swap p] [--payload min-max] [--seed n] [--crc-bits k]
 * Rates are per bit for --ber, per byte for the others. --crc-bits below 32 spoils the check on purpose: frames are
 * taken whose CRC is right in its low k bits. Ends with 1 if a frame was accepted that differs from the one sent, if a
 * frame was lost that the line had not touched and that followed a delimiter, if bytes are not accounted for, or if
 * nothing arrived at all. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/assert.h"
#include "base/bytes.h"
#include "base/crc32.h"
#include "base/random.h"
#include "channel.h"
#include "protocol/frame.h"

enum { STREAM = 0, TEXT_SIZE = 256, WRONG_SHOWN = 5 };

struct options {
    uint64_t frames;
    double rate[CHANNEL_FAULTS];
    size_t payload_min, payload_max;
    uint32_t seed;
    unsigned crc_bits;
};

/* A frame on its way. */
struct sent {
    struct frame frame;
    uint8_t payload[FRAME_PAYLOAD_MAX];
    bool is_hit;    /* the line changed its bytes */
    bool is_joined; /* what came before it did not end in a delimiter */
    bool is_delivered;
};

struct campaign {
    struct options options;
    struct channel channel;
    struct frame_receiver receiver;
    uint64_t draws;
    struct sent sent[2];                  /* this frame and the one before it, which a flip may delimit late */
    uint8_t piece[FRAME_STUFFED_MAX + 1]; /* what came since the last delimiter, as far as it may be a frame */
    size_t piece_size;
    uint8_t last_byte;
    uint64_t hit, intact, lost, lost_joined, lost_untouched, wrong;
    uint64_t bytes, delimiters, accepted_bytes;
};

void base_assert_failed(const char *file, unsigned line)
{
    fprintf(stderr, "%s:%u: assertion failed\n", file, line);
    abort();
}

static uint32_t draw(struct campaign *campaign)
{
    return random_words(campaign->options.seed, STREAM, campaign->draws++).first;
}

/* Random bytes, bytes half of which are 0, or all the same: what stuffing finds easy and hard. */
static void make_frame(struct campaign *campaign, uint64_t number, struct sent *sent)
{
    const struct options *options = &campaign->options;
    const uint32_t spread = (uint32_t)(options->payload_max - options->payload_min) + 1u;
    const uint32_t choice = draw(campaign);
    const uint32_t kind = choice >> 30;

    sent->is_hit = sent->is_joined = sent->is_delivered = false;
    sent->frame = (struct frame){.type = (uint8_t)choice,
                                 .sequence = (uint16_t)number,
                                 .step = (uint32_t)number * 64u,
                                 .payload = sent->payload,
                                 .size = options->payload_min + (choice >> 8 & 0xffffu) % spread};
    for (size_t i = 0u; i < sent->frame.size; i += 4u) {
        const uint32_t word = kind < 3u ? draw(campaign) : (choice >> 29 & 1u) * UINT32_MAX;
        const uint32_t mask = kind == 2u ? draw(campaign) : 0u;

        for (size_t j = i; j < sent->frame.size && j < i + 4u; j++) {
            const unsigned shift = 8u * (unsigned)(j - i);

            sent->payload[j] = (mask >> shift & 1u) != 0u ? 0u : (uint8_t)(word >> shift);
        }
    }
}

static bool is_same(const struct frame *a, const struct frame *b)
{
    return a->type == b->type && a->sequence == b->sequence && a->step == b->step && a->size == b->size &&
           memcmp(a->payload, b->payload, a->size) == 0;
}

static void judge(struct campaign *campaign, const struct frame *frame, uint64_t number)
{
    for (unsigned i = 0u; i < 2u; i++) {
        struct sent *sent = &campaign->sent[i];

        if (!sent->is_delivered && is_same(frame, &sent->frame)) {
            sent->is_delivered = true;
            campaign->intact++;
            return;
        }
    }
    if (campaign->wrong++ < WRONG_SHOWN) {
        printf("wrong: sequence %u, %zu bytes, where %u was sent with %zu\n", frame->sequence, frame->size,
               campaign->sent[number & 1u].frame.sequence, campaign->sent[number & 1u].frame.size);
    }
}

/* The spoilt check: would the piece be a frame if only the low bits of its CRC counted? */
static bool is_weakly_good(struct campaign *campaign, struct frame *frame)
{
    const uint32_t mask = (UINT32_C(1) << campaign->options.crc_bits) - 1u;
    struct bytes_reader reader = {.bytes = campaign->piece};
    uint32_t crc;

    if (cobs_decode(campaign->piece, campaign->piece_size, &reader.size) != COBS_OK || reader.size < FRAME_SIZE_MIN) {
        return false;
    }
    crc = crc32_add(0u, reader.bytes, reader.size - 4u);
    frame->type = bytes_get_u8(&reader);
    frame->sequence = bytes_get_u16(&reader);
    frame->step = bytes_get_u32(&reader);
    frame->size = reader.size - FRAME_SIZE_MIN;
    frame->payload = bytes_get_block(&reader, frame->size);
    return ((crc ^ bytes_get_u32(&reader)) & mask) == 0u;
}

static void receive(struct campaign *campaign, uint8_t byte, uint64_t number)
{
    const uint32_t bad_crc = campaign->receiver.bad_crc;
    struct frame frame;

    campaign->bytes++;
    campaign->delimiters += byte == 0u ? 1u : 0u;
    campaign->last_byte = byte;
    if (frame_take(&campaign->receiver, byte, &frame)) {
        campaign->accepted_bytes += FRAME_SIZE_MIN + frame.size + 1u; /* one for the stuffing */
        judge(campaign, &frame, number);
    } else if (campaign->options.crc_bits < 32u && campaign->receiver.bad_crc != bad_crc &&
               is_weakly_good(campaign, &frame)) {
        judge(campaign, &frame, number);
    }
    if (byte == 0u) {
        campaign->piece_size = 0u;
    } else if (campaign->piece_size < sizeof campaign->piece) {
        campaign->piece[campaign->piece_size++] = byte;
    }
}

/* A frame that can no longer arrive. */
static void settle(struct campaign *campaign, const struct sent *sent)
{
    campaign->hit += sent->is_hit ? 1u : 0u;
    if (sent->is_delivered) {
        return;
    }
    campaign->lost++;
    if (!sent->is_hit) {
        campaign->lost_joined += sent->is_joined ? 1u : 0u;
        campaign->lost_untouched += sent->is_joined ? 0u : 1u;
    }
}

static void send_frame(struct campaign *campaign, uint64_t number)
{
    static uint8_t storage[TEXT_SIZE];
    static uint8_t arriving[2 * FRAME_WIRE_MAX];
    struct sent *sent = &campaign->sent[number & 1u];
    struct text text;
    const uint8_t *wire;
    size_t size;
    size_t count;

    if (number >= 2u) {
        settle(campaign, sent);
    }
    make_frame(campaign, number, sent);
    text_init(&text, storage, sizeof storage);
    if (!frame_write(&text, &sent->frame)) {
        abort(); /* it fits an empty text */
    }
    wire = text_peek(&text, &size);
    count = channel_carry(&campaign->channel, wire, size, arriving);
    sent->is_hit = count != size || memcmp(wire, arriving, size) != 0;
    sent->is_joined = campaign->last_byte != 0u;
    for (size_t i = 0u; i < count; i++) {
        receive(campaign, arriving[i], number);
    }
}

static bool print_result(const struct campaign *campaign)
{
    const struct frame_receiver *receiver = &campaign->receiver;
    const uint64_t garbage = campaign->bytes - campaign->delimiters - campaign->accepted_bytes;
    const uint32_t unaccounted = (uint32_t)garbage - receiver->garbage_bytes;
    const struct {
        const char *name;
        uint64_t count;
    } rows[] = {
        {"sent", campaign->options.frames},
        {"hit by the line", campaign->hit},
        {"delivered intact", campaign->intact},
        {"lost", campaign->lost},
        {"lost, not hit, joined to one before", campaign->lost_joined},
        {"lost, not hit, after a delimiter", campaign->lost_untouched},
        {"WRONG ACCEPTS", campaign->wrong},
        {"pieces refused: too long", receiver->too_long},
        {"pieces refused: stuffing", receiver->bad_cobs},
        {"pieces refused: too short", receiver->too_short},
        {"pieces refused: CRC", receiver->bad_crc},
        {"bytes on the line", campaign->bytes},
        {"bytes of garbage", garbage},
        {"bytes not accounted for", unaccounted},
    };

    for (size_t i = 0u; i < sizeof rows / sizeof rows[0]; i++) {
        printf("%-36s %12" PRIu64 "\n", rows[i].name, rows[i].count);
    }
    return campaign->wrong == 0u && campaign->lost_untouched == 0u && unaccounted == 0u && campaign->intact > 0u;
}

static bool parse_rate(const char *text, double *rate)
{
    char *end;

    *rate = strtod(text, &end);
    return end != text && *end == '\0' && *rate >= 0.0 && *rate < 1.0;
}

static bool parse_count(const char *text, double max, double *count)
{
    char *end;

    *count = strtod(text, &end); /* 1e7 is a count too */
    return end != text && *end == '\0' && *count >= 0.0 && *count <= max;
}

static bool parse_option(const char *name, const char *value, struct options *options)
{
    static const char *const rates[CHANNEL_FAULTS] = {"--ber", "--drop", "--double", "--swap"};
    double count;

    for (int i = 0; i < CHANNEL_FAULTS; i++) {
        if (strcmp(name, rates[i]) == 0) {
            return parse_rate(value, &options->rate[i]);
        }
    }
    if (strcmp(name, "--payload") == 0) {
        char end;

        return sscanf(value, "%zu-%zu%c", &options->payload_min, &options->payload_max, &end) == 2 &&
               options->payload_min <= options->payload_max && options->payload_max <= FRAME_PAYLOAD_MAX;
    }
    if (!parse_count(value, 1e12, &count)) {
        return false;
    }
    if (strcmp(name, "--frames") == 0) {
        options->frames = (uint64_t)count;
    } else if (strcmp(name, "--seed") == 0 && count <= (double)UINT32_MAX) {
        options->seed = (uint32_t)count;
    } else if (strcmp(name, "--crc-bits") == 0 && count <= 32.0) {
        options->crc_bits = (unsigned)count;
    } else {
        return false;
    }
    return true;
}

int main(int count, char **word)
{
    static struct campaign campaign;
    struct options *options = &campaign.options;

    *options = (struct options){.frames = 1000000u, .rate = {1e-3}, .payload_max = 48u, .seed = 1u, .crc_bits = 32u};
    for (int i = 1; i < count; i += 2) {
        if (i + 1 == count || !parse_option(word[i], word[i + 1], options)) {
            fprintf(stderr, "frames: %s: not understood\n", word[i]);
            return 2;
        }
    }
    channel_open(&campaign.channel, options->rate, options->seed);
    frame_open(&campaign.receiver);
    for (uint64_t number = 0u; number < options->frames; number++) {
        send_frame(&campaign, number);
    }
    receive(&campaign, 0u, options->frames - 1u); /* ends what is left on the line */
    for (uint64_t number = 0u; number < 2u && number < options->frames; number++) {
        settle(&campaign, &campaign.sent[number]);
    }
    return print_result(&campaign) ? 0 : 1;
}
