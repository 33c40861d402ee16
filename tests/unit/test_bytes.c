/* Fields in bytes: where each byte lies, and what happens at the end. */
#include "base/bytes.h"

#include "base/fmath.h"
#include "base/mem.h"
#include "tap.h"
#include "tests.h"

enum { GUARD = 0xa5, FIELDS_SIZE = 1 + 2 + 4 + 8 + 4 + 4 + 5 + 3 };

static uint8_t storage[FIELDS_SIZE + 1];

static void put_fields(struct bytes_writer *writer)
{
    bytes_put_u8(writer, 0x01u);
    bytes_put_u16(writer, 0x0203u);
    bytes_put_u32(writer, 0x04050607u);
    bytes_put_u64(writer, 0x08090a0b0c0d0e0fu);
    bytes_put_i32(writer, -2);
    bytes_put_f32(writer, 1.0f);
    bytes_put_text(writer, "abc", 5u);
    bytes_put_block(writer, (const uint8_t *)"\0\1\2", 3u);
}

static const uint8_t expected[FIELDS_SIZE] = {1,    3,    2,    7, 6, 5,    4,    15,  14,  13,  12, 11, 10, 9, 8, 0xfe,
                                              0xff, 0xff, 0xff, 0, 0, 0x80, 0x3f, 'a', 'b', 'c', 0,  0,  0,  1, 2};

static void check_layout(void)
{
    struct bytes_writer writer = {.bytes = storage, .capacity = FIELDS_SIZE};

    memset(storage, GUARD, sizeof storage);
    put_fields(&writer);
    tap_check(writer.size == FIELDS_SIZE && !writer.overflowed, "fields take the room of their kinds");
    tap_check(memcmp(storage, expected, FIELDS_SIZE) == 0, "the low byte comes first");
    tap_check(storage[FIELDS_SIZE] == GUARD, "nothing is written behind the end");
}

/* Whatever the room: the fields that fit, whole, and no later one in the place of one that does not. */
static void check_overflow(void)
{
    static const size_t ends[] = {0u, 1u, 3u, 7u, 15u, 19u, 23u, 28u, FIELDS_SIZE};
    bool ok = true;

    for (size_t capacity = 0u; capacity < FIELDS_SIZE; capacity++) {
        struct bytes_writer writer = {.bytes = storage, .capacity = capacity};
        size_t end = 0u;

        for (size_t i = 0u; ends[i] <= capacity; i++) {
            end = ends[i];
        }
        memset(storage, GUARD, sizeof storage);
        put_fields(&writer);
        ok = ok && writer.overflowed && writer.size == end && memcmp(storage, expected, end) == 0;
        for (size_t i = end; i < sizeof storage; i++) {
            ok = ok && storage[i] == GUARD;
        }
    }
    tap_check(ok, "what does not fit raises the flag and is left out, with all that follows");
}

static bool get_fields(struct bytes_reader *reader, bool *is_zero)
{
    char text[6];
    const uint8_t a = bytes_get_u8(reader);
    const uint16_t b = bytes_get_u16(reader);
    const uint32_t c = bytes_get_u32(reader);
    const uint64_t d = bytes_get_u64(reader);
    const int32_t e = bytes_get_i32(reader);
    const float f = bytes_get_f32(reader);
    const uint8_t *block;

    memset(text, GUARD, sizeof text);
    bytes_get_text(reader, text, 5u);
    block = bytes_get_block(reader, 3u);
    *is_zero = block == 0 && (reader->size >= 28u || text[0] == '\0') && text[5] == '\0' &&
               (reader->size >= 23u || fmath_bits(f) == 0u) && (reader->size >= 19u || e == 0) &&
               (reader->size >= 15u || d == 0u) && (reader->size >= 7u || c == 0u) && (reader->size >= 3u || b == 0u) &&
               (reader->size >= 1u || a == 0u);
    return a == 1u && b == 0x0203u && c == 0x04050607u && d == 0x08090a0b0c0d0e0fu && e == -2 && f == 1.0f &&
           memcmp(text, "abc\0\0", 6u) == 0 && block == reader->bytes + 28;
}

static void check_reading(void)
{
    struct bytes_reader reader = {.bytes = expected, .size = FIELDS_SIZE};
    bool is_zero;
    bool ok = true;

    tap_check(get_fields(&reader, &is_zero) && bytes_is_spent(&reader), "what was written is read, and all of it");
    (void)bytes_get_u8(&reader);
    tap_check(reader.is_short && !bytes_is_spent(&reader), "one byte more is too many");
    for (size_t size = 0u; size < FIELDS_SIZE; size++) {
        reader = (struct bytes_reader){.bytes = expected, .size = size};
        ok = ok && !get_fields(&reader, &is_zero) && is_zero && reader.is_short && !bytes_is_spent(&reader);
    }
    tap_check(ok, "a field that is cut reads as 0, and so do those behind it");
    reader = (struct bytes_reader){.bytes = expected, .size = 3u};
    (void)bytes_get_u16(&reader);
    tap_check(!reader.is_short && !bytes_is_spent(&reader), "bytes that are left are seen");
    (void)bytes_get_u32(&reader);
    tap_check(reader.offset == 2u && bytes_get_u8(&reader) == 0u && !bytes_is_spent(&reader),
              "after a field that was not there, none is");
}

static void check_values(void)
{
    static const uint32_t floats[] = {0x80000000u, 0x7f800000u, 0xff800000u, 0x7fc12345u, 0x00000001u, 0x7f7fffffu};
    bool ok = true;

    for (size_t i = 0u; i < sizeof floats / sizeof floats[0]; i++) {
        struct bytes_writer writer = {.bytes = storage, .capacity = 8u};
        struct bytes_reader reader = {.bytes = storage, .size = 8u};

        bytes_put_f32(&writer, fmath_from_bits(floats[i]));
        bytes_put_i32(&writer, INT32_MIN);
        ok = ok && fmath_bits(bytes_get_f32(&reader)) == floats[i] && bytes_get_i32(&reader) == INT32_MIN;
    }
    tap_check(ok, "every float keeps its bits, the least integer its value");
}

static void check_text(void)
{
    struct bytes_writer writer = {.bytes = storage, .capacity = 8u};
    struct bytes_reader reader = {.bytes = storage, .size = 8u};
    char text[4] = {'x', 'x', 'x', 'x'};

    memset(storage, GUARD, sizeof storage);
    bytes_put_text(&writer, "abcdef", 4u);
    bytes_put_text(&writer, "", 2u);
    bytes_put_text(&writer, "xy", 2u);
    tap_check(!writer.overflowed && memcmp(storage, "abcd\0\0xy", 8u) == 0, "a text is cut or filled up to its width");
    bytes_get_text(&reader, text, 2u);
    tap_check_text(text, "ab", "and always ends when it is read");
    tap_check(text[3] == 'x', "without a character beyond");
}

void test_bytes(void)
{
    check_layout();
    check_overflow();
    check_reading();
    check_values();
    check_text();
}
