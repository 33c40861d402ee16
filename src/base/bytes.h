/* Fields in bytes, the low byte first, one after the other:
 *
 *     struct bytes_reader reader = {.bytes = bytes, .size = size};
 *     const uint8_t kind = bytes_get_u8(&reader);
 *     const float force_n = bytes_get_f32(&reader);
 *     if (!bytes_is_spent(&reader)) {
 *         return false;
 *     }
 *
 * A field that does not fit is not written, and from then on none is; a field that is not there reads as 0, and so do
 * all that follow. So a list of fields needs one look at its end. Nothing beyond the end is touched. [ANY, pure] */
#ifndef BASE_BYTES_H
#define BASE_BYTES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct bytes_writer {
    uint8_t *bytes;  /* capacity of them, owned by the caller */
    size_t capacity; /* bytes */
    size_t size;     /* bytes written so far */
    bool overflowed; /* a field did not fit */
};

struct bytes_reader {
    const uint8_t *bytes;
    size_t size;   /* bytes */
    size_t offset; /* bytes read so far */
    bool is_short; /* a field was not there */
};

void bytes_put_u8(struct bytes_writer *writer, uint8_t value);
void bytes_put_u16(struct bytes_writer *writer, uint16_t value);
void bytes_put_u32(struct bytes_writer *writer, uint32_t value);
void bytes_put_u64(struct bytes_writer *writer, uint64_t value);
void bytes_put_i32(struct bytes_writer *writer, int32_t value);
void bytes_put_f32(struct bytes_writer *writer, float value); /* its bits, of a NaN too */

/* A 0-terminated text in width bytes: cut there, or filled up with zeros. */
void bytes_put_text(struct bytes_writer *writer, const char *text, size_t width);

/* So many bytes as they are. */
void bytes_put_block(struct bytes_writer *writer, const uint8_t *block, size_t size);

uint8_t bytes_get_u8(struct bytes_reader *reader);
uint16_t bytes_get_u16(struct bytes_reader *reader);
uint32_t bytes_get_u32(struct bytes_reader *reader);
uint64_t bytes_get_u64(struct bytes_reader *reader);
int32_t bytes_get_i32(struct bytes_reader *reader);
float bytes_get_f32(struct bytes_reader *reader);

/* A text of width bytes into width + 1 characters, the last of them 0. */
void bytes_get_text(struct bytes_reader *reader, char *text, size_t width);

/* Where the next size bytes lie, or 0. */
const uint8_t *bytes_get_block(struct bytes_reader *reader, size_t size);

/* Every field was there, and nothing is left. */
bool bytes_is_spent(const struct bytes_reader *reader);

#endif
