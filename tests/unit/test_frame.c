/* Frames: the bytes of one, round trips of all sizes, and what a receiver makes of every kind of damage. */
#include "protocol/frame.h"

#include "base/compiler.h"
#include "base/mem.h"
#include "tap.h"
#include "tests.h"

enum { GUARD = 0xa5, TEXT_SIZE = 1024 };

static struct text text;
static uint8_t storage[TEXT_SIZE];
static struct frame_receiver receiver;
static struct frame received;
static uint8_t payload[FRAME_PAYLOAD_MAX];
static uint8_t wire[FRAME_WIRE_MAX];      /* the frame under test */
static uint8_t good_wire[FRAME_WIRE_MAX]; /* and the one that follows it */
static size_t good_size;

static const struct frame good = {
    .type = 9u, .sequence = 77u, .step = 123456u, .payload = (const uint8_t *)"follows", .size = 7u};

/* The bytes of a frame on the wire. */
static size_t write_wire(const struct frame *frame, uint8_t *out)
{
    size_t size;

    text_init(&text, storage, sizeof storage);
    (void)frame_write(&text, frame);
    memcpy(out, text_peek(&text, &size), text.head);
    return size;
}

/* A frame of so many random bytes, every fourth of them 0. */
static struct frame random_frame(uint32_t *state, size_t size)
{
    const struct frame frame = {.type = (uint8_t)(tap_random(state) >> 24),
                                .sequence = (uint16_t)(tap_random(state) >> 16),
                                .step = tap_random(state),
                                .payload = payload,
                                .size = size};

    for (size_t i = 0u; i < size; i++) {
        const uint32_t word = tap_random(state);

        payload[i] = word >> 30 == 0u ? 0u : (uint8_t)word;
    }
    return frame;
}

static bool is_same(const struct frame *a, const struct frame *b)
{
    return a->type == b->type && a->sequence == b->sequence && a->step == b->step && a->size == b->size &&
           memcmp(a->payload, b->payload, a->size) == 0;
}

/* How many frames come out of these bytes; the last is in received. */
static unsigned take(const uint8_t *bytes, size_t size)
{
    unsigned count = 0u;

    for (size_t i = 0u; i < size; i++) {
        count += frame_take(&receiver, bytes[i], &received) ? 1u : 0u;
    }
    return count;
}

/* The frame that follows damage is received, and as it was sent. */
static bool goes_on(void) { return take(good_wire, good_size) == 1u && is_same(&received, &good); }

static uint32_t refused(void)
{
    return receiver.damaged + receiver.too_long + receiver.bad_cobs + receiver.too_short + receiver.bad_crc;
}

/* Made by a program of its own: struct.pack, zlib.crc32 and the stuffing of the paper. */
static void check_bytes(void)
{
    static const uint8_t expected[] = {0x07, 0x21, 0x02, 0x01, 0x05, 0x04, 0x03, 0x01, 0x02,
                                       0xff, 0x06, 0x07, 0x12, 0xdc, 0xdc, 0x25, 0x00};
    const struct frame frame = {
        .type = 0x21u, .sequence = 0x0102u, .step = 0x00030405u, .payload = (const uint8_t *)"\0\xff\0\7", .size = 4u};

    tap_check(write_wire(&frame, wire) == sizeof expected && memcmp(wire, expected, sizeof expected) == 0,
              "the bytes of a frame are those of the specification");
    frame_open(&receiver);
    tap_check(take(expected, sizeof expected - 1u) == 0u && take(expected + sizeof expected - 1u, 1u) == 1u,
              "which is received with its last byte");
    tap_check(is_same(&received, &frame) && receiver.accepted == 1u && refused() == 0u && receiver.garbage_bytes == 0u,
              "as it was sent");
}

static void check_sizes(void)
{
    uint32_t state = 11u;
    bool ok = true;

    frame_open(&receiver);
    for (size_t size = 0u; size <= FRAME_PAYLOAD_MAX; size++) {
        const struct frame frame = random_frame(&state, size);

        text_init(&text, storage, 512u);
        text.head = text.tail = size * 7u; /* across the end of the storage as well */
        ok = ok && frame_write(&text, &frame) && text.head - text.tail == size + FRAME_SIZE_MIN + 2u;
        for (size_t i = text.tail; i != text.head; i++) {
            ok = ok && frame_take(&receiver, storage[i & 511u], &received) == (i + 1u == text.head);
        }
        ok = ok && is_same(&received, &frame);
    }
    tap_check(ok, "every size of payload comes through");
    tap_check(receiver.accepted == FRAME_PAYLOAD_MAX + 1u && refused() == 0u && receiver.garbage_bytes == 0u,
              "and nothing is refused");
    memset(payload, 0xff, sizeof payload);
    tap_check(write_wire(&(struct frame){.payload = payload, .size = FRAME_PAYLOAD_MAX}, wire) == FRAME_WIRE_MAX,
              "the longest is as long as it may be");
}

static void check_room(void)
{
    uint32_t state = 13u;
    const struct frame frame = random_frame(&state, 20u);
    bool ok = true;

    for (size_t room = 0u; room < 40u; room++) {
        size_t head;

        memset(storage, GUARD, sizeof storage);
        text_init(&text, storage, 64u);
        text.head += 64u - room;
        head = text.head;
        if (room < 20u + FRAME_SIZE_MIN + 2u) {
            ok = ok && !frame_write(&text, &frame) && text.head == head && storage[head & 63u] == GUARD;
        } else {
            ok = ok && frame_write(&text, &frame) && text.head == head + 33u;
        }
        ok = ok && !text.overflowed && storage[64] == GUARD;
    }
    tap_check(ok, "a frame goes out whole, or leaves no trace");
}

static const size_t sizes[] = {0u, 1u, 24u, FRAME_PAYLOAD_MAX}; /* of the payloads that are damaged */

/* Takes the frame with a bit turned over; the delimiter is the last byte. */
static bool is_refused_flipped(size_t size, size_t bit)
{
    const uint32_t before = refused();
    bool ok;

    wire[bit / 8u] ^= (uint8_t)(1u << bit % 8u);
    ok = take(wire, size) == 0u;
    wire[bit / 8u] ^= (uint8_t)(1u << bit % 8u);
    if (bit / 8u == size - 1u) {
        ok = ok && take(good_wire, good_size) == 0u; /* what lost its delimiter takes one with it */
    }
    return ok && refused() > before;
}

static void check_flips(void)
{
    uint32_t state = 17u;
    bool is_refused = true;
    bool is_resumed = true;
    bool is_good = true;

    frame_open(&receiver);
    for (size_t i = 0u; i < BASE_COUNT(sizes); i++) {
        const struct frame frame = random_frame(&state, sizes[i]);
        const size_t size = write_wire(&frame, wire);

        for (size_t bit = 0u; bit < 8u * size; bit++) {
            is_refused = is_refused && is_refused_flipped(size, bit);
            is_resumed = is_resumed && goes_on();
        }
        is_good = is_good && take(wire, size) == 1u && is_same(&received, &frame);
    }
    tap_check(is_refused, "a frame with one wrong bit is refused and counted, whichever it is");
    tap_check(is_resumed, "and the next delimiter mends it");
    tap_check(is_good, "without it the frame is good");
}

/* The frame as it is up to the cut, then the given bytes, then from there on, without skip bytes. */
static bool is_refused_with(size_t size, size_t cut, size_t skip, const uint8_t *bytes, size_t count)
{
    const uint32_t before = refused();

    return take(wire, cut) == 0u && take(bytes, count) == 0u && take(wire + cut + skip, size - cut - skip) == 0u &&
           refused() > before && goes_on();
}

static bool is_refused_short(size_t size)
{
    bool ok = true;

    for (size_t i = 1u; i < size - 1u; i++) {
        ok = ok && is_refused_with(size, i, size - 1u - i, wire, 0u); /* cut at its end, then at its start */
        ok = ok && is_refused_with(size, 0u, i, wire, 0u);
    }
    for (size_t i = 0u; i < size - 1u; i++) {
        ok = ok && is_refused_with(size, i, 1u, wire, 0u);
    }
    return ok;
}

static bool is_refused_long(size_t size)
{
    bool ok = true;

    for (size_t i = 0u; i < size - 1u; i++) {
        static const uint8_t added[] = {1u, 2u, 0x55u, 0xffu};

        ok = ok && is_refused_with(size, i, 0u, wire + i, 1u); /* doubled */
        for (size_t j = 0u; j < sizeof added; j++) {
            ok = ok && is_refused_with(size, i, 0u, added + j, 1u);
        }
        ok = ok && (i == 0u || is_refused_with(size, i, 0u, (const uint8_t *)"", 1u)); /* split */
    }
    return ok;
}

static void check_losses(void)
{
    uint32_t state = 19u;
    bool ok_short = true;
    bool ok_long = true;
    bool ok_merged = true;

    frame_open(&receiver);
    for (size_t i = 0u; i < BASE_COUNT(sizes); i++) {
        const struct frame frame = random_frame(&state, sizes[i]);
        const size_t size = write_wire(&frame, wire);

        ok_short = ok_short && is_refused_short(size);
        ok_long = ok_long && is_refused_long(size);
        ok_merged = ok_merged && take(wire, size - 1u) == 0u && take(good_wire, good_size) == 0u && goes_on();
    }
    tap_check(ok_short, "a frame that lacks its end, its beginning or a byte is refused, wherever");
    tap_check(ok_long, "so is one with a byte too many, or a delimiter inside");
    tap_check(ok_merged, "a lost delimiter costs the next frame too, and no other");
}

static bool counts_are(uint32_t accepted, uint32_t too_long, uint32_t bad_cobs, uint32_t too_short, uint32_t bad_crc)
{
    return receiver.accepted == accepted && receiver.too_long == too_long && receiver.bad_cobs == bad_cobs &&
           receiver.too_short == too_short && receiver.bad_crc == bad_crc;
}

/* So many bytes of 1, which stuff zeros. */
static void take_ones(unsigned count)
{
    while (count-- > 0u) {
        (void)take((const uint8_t *)"\1", 1u);
    }
}

static void check_reasons(void)
{
    frame_open(&receiver);
    (void)take((const uint8_t *)"\3\1", 3u);
    tap_check(counts_are(0u, 0u, 1u, 0u, 0u) && receiver.garbage_bytes == 2u,
              "bad stuffing is counted, with its bytes");
    take_ones(FRAME_SIZE_MIN);
    (void)take((const uint8_t *)"", 1u);
    tap_check(counts_are(0u, 0u, 1u, 1u, 0u), "ten bytes are no frame");
    take_ones(FRAME_SIZE_MIN + 1u);
    (void)take((const uint8_t *)"", 1u);
    tap_check(counts_are(0u, 0u, 1u, 1u, 1u), "eleven zeros are one with a wrong CRC");
    take_ones(FRAME_STUFFED_MAX);
    (void)take((const uint8_t *)"", 1u);
    tap_check(counts_are(0u, 0u, 1u, 1u, 2u), "252 bytes may be a frame");
    take_ones(FRAME_STUFFED_MAX + 1u);
    (void)take((const uint8_t *)"", 1u);
    tap_check(counts_are(0u, 1u, 1u, 1u, 2u), "253 are too many");
    take_ones(70000u);
    (void)take((const uint8_t *)"", 1u);
    tap_check(counts_are(0u, 2u, 1u, 1u, 2u), "70000 too, and are one piece");
    tap_check(receiver.garbage_bytes == 2u + 11u + 12u + 252u + 253u + 70000u, "all garbage is counted");
    tap_check(goes_on() && counts_are(1u, 2u, 1u, 1u, 2u), "then a frame is received");
}

/* What a line that is too long would hold if it wrapped: a whole frame behind a full buffer. */
static void check_no_wrap(void)
{
    frame_open(&receiver);
    take_ones(FRAME_STUFFED_MAX);
    tap_check(take(good_wire, good_size) == 0u && receiver.too_long == 1u, "a frame behind a full buffer is not one");
    tap_check(goes_on(), "the next one is");
}

static void check_delimiters(void)
{
    static const uint8_t storm[300] = {0u};

    frame_open(&receiver);
    tap_check(take(storm, sizeof storm) == 0u && refused() == 0u && receiver.garbage_bytes == 0u,
              "delimiters alone are nothing");
    tap_check(goes_on() && take(storm, 1u) == 0u && goes_on() && goes_on(), "between frames as well");
    tap_check(take((const uint8_t *)"\5\5\5", 3u) == 0u && take(storm, 1u) == 0u && goes_on(),
              "one before a frame gets rid of what the line held");
    tap_check(counts_are(4u, 0u, 1u, 0u, 0u) && receiver.garbage_bytes == 3u, "which is counted");
}

static void check_damage(void)
{
    frame_open(&receiver);
    (void)take(good_wire, 5u);
    frame_damage(&receiver);
    tap_check(take(good_wire + 5, good_size - 5u) == 0u && receiver.damaged == 1u,
              "a frame in which bytes were lost is dropped, even if it looks whole");
    tap_check(receiver.garbage_bytes == good_size - 1u && goes_on(), "the next one is not");
    frame_damage(&receiver);
    tap_check(take((const uint8_t *)"", 1u) == 0u && receiver.damaged == 2u && goes_on(),
              "a loss between frames ends with the next delimiter");
    (void)take(good_wire, 5u);
    frame_damage(&receiver);
    take_ones(300u);
    (void)take((const uint8_t *)"", 1u);
    tap_check(receiver.damaged == 3u && receiver.too_long == 0u && goes_on(), "one piece has one reason");
}

/* Random bytes in pieces, each followed by a good frame. */
static void check_garbage(void)
{
    const uint32_t pieces = tap_is_hosted() ? 20000u : 200u;
    uint32_t state = 23u;
    uint32_t bytes = 0u;
    bool ok = true;

    frame_open(&receiver);
    for (uint32_t i = 0u; i < pieces; i++) {
        const uint32_t size = tap_random(&state) % 400u;

        for (uint32_t j = 0u; j < size; j++) {
            const uint8_t byte = (uint8_t)(tap_random(&state) >> tap_random(&state) % 25u);

            bytes += byte != 0u ? 1u : 0u;
            ok = ok && !frame_take(&receiver, byte, &received);
        }
        ok = ok && take((const uint8_t *)"", 1u) == 0u && goes_on();
    }
    tap_check(ok && receiver.accepted == pieces, "garbage is never a frame, and costs none that is delimited");
    tap_check(receiver.garbage_bytes == bytes, "every byte of it is counted");
}

void test_frame(void)
{
    good_size = write_wire(&good, good_wire);
    check_bytes();
    check_sizes();
    check_room();
    check_flips();
    check_losses();
    check_reasons();
    check_no_wrap();
    check_delimiters();
    check_damage();
    check_garbage();
}
