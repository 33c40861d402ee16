#include "base/bytes.h"

#include "base/compiler.h"
#include "base/fmath.h"

/* Where a field of so many bytes goes, or 0. */
static uint8_t *reserve(struct bytes_writer *writer, size_t size)
{
    if (writer->overflowed || writer->capacity - writer->size < size) {
        writer->overflowed = true;
        return 0;
    }
    writer->size += size;
    return writer->bytes + (writer->size - size);
}

/* Not inlined once for every kind, nor is get(). */
static BASE_NOINLINE void put(struct bytes_writer *writer, uint64_t value, size_t size)
{
    uint8_t *field = reserve(writer, size);

    for (size_t i = 0u; field != 0 && i < size; i++) {
        field[i] = (uint8_t)value;
        value >>= 8;
    }
}

void bytes_put_u8(struct bytes_writer *writer, uint8_t value) { put(writer, value, 1u); }
void bytes_put_u16(struct bytes_writer *writer, uint16_t value) { put(writer, value, 2u); }
void bytes_put_u32(struct bytes_writer *writer, uint32_t value) { put(writer, value, 4u); }
void bytes_put_u64(struct bytes_writer *writer, uint64_t value) { put(writer, value, 8u); }
void bytes_put_i32(struct bytes_writer *writer, int32_t value) { put(writer, (uint32_t)value, 4u); }
void bytes_put_f32(struct bytes_writer *writer, float value) { put(writer, fmath_bits(value), 4u); }

void bytes_put_text(struct bytes_writer *writer, const char *text, size_t width)
{
    uint8_t *field = reserve(writer, width);

    for (size_t i = 0u; field != 0 && i < width; i++) {
        field[i] = (uint8_t)*text;
        text += *text != '\0' ? 1 : 0;
    }
}

void bytes_put_block(struct bytes_writer *writer, const uint8_t *block, size_t size)
{
    uint8_t *field = reserve(writer, size);

    for (size_t i = 0u; field != 0 && i < size; i++) {
        field[i] = block[i];
    }
}

const uint8_t *bytes_get_block(struct bytes_reader *reader, size_t size)
{
    if (reader->is_short || reader->size - reader->offset < size) {
        reader->is_short = true;
        return 0;
    }
    reader->offset += size;
    return reader->bytes + (reader->offset - size);
}

static BASE_NOINLINE uint64_t get(struct bytes_reader *reader, size_t size)
{
    const uint8_t *field = bytes_get_block(reader, size);
    uint64_t value = 0u;

    for (size_t i = size; field != 0 && i > 0u; i--) {
        value = value << 8 | field[i - 1u];
    }
    return value;
}

uint8_t bytes_get_u8(struct bytes_reader *reader) { return (uint8_t)get(reader, 1u); }
uint16_t bytes_get_u16(struct bytes_reader *reader) { return (uint16_t)get(reader, 2u); }
uint32_t bytes_get_u32(struct bytes_reader *reader) { return (uint32_t)get(reader, 4u); }
uint64_t bytes_get_u64(struct bytes_reader *reader) { return get(reader, 8u); }
int32_t bytes_get_i32(struct bytes_reader *reader) { return (int32_t)get(reader, 4u); }
float bytes_get_f32(struct bytes_reader *reader) { return fmath_from_bits((uint32_t)get(reader, 4u)); }

void bytes_get_text(struct bytes_reader *reader, char *text, size_t width)
{
    const uint8_t *field = bytes_get_block(reader, width);

    for (size_t i = 0u; i < width; i++) {
        text[i] = field != 0 ? (char)field[i] : '\0';
    }
    text[width] = '\0';
}

bool bytes_is_spent(const struct bytes_reader *reader) { return !reader->is_short && reader->offset == reader->size; }
