/* Consistent overhead byte stuffing (Cheshire and Baker 1999): any bytes become bytes other than 0, so that a 0 may
 * stand between frames, for one byte more in every 254.
 *
 *     11 22 00 33      ->      03 11 22 02 33
 *                              |        |
 *                              a code:  how far to the next one; there stood a 0, except before the first code and
 *                                       after a code of 255, and none stands at the end
 *
 * What is decoded ends where its encoding does; delimiters are the caller's. [ANY, pure] */
#ifndef BASE_COBS_H
#define BASE_COBS_H

#include <stddef.h>
#include <stdint.h>

/* Bytes that an encoding of so many takes at most. */
#define COBS_SIZE_MAX(size) ((size) + ((size) + 253u) / 254u + ((size) == 0u ? 1u : 0u))

enum cobs_error {
    COBS_OK,
    COBS_EMPTY, /* no byte at all: even nothing has an encoding, 01 */
    COBS_ZERO,  /* a 0 inside */
    COBS_BEYOND /* a code points beyond the end */
};

/* Encodes size bytes into at most capacity bytes. Returns how many it took, or 0 if they were too few; what was written
 * until then is of no use. Up to 254 bytes may lie right behind where their encoding begins: bytes = out + 1. */
size_t cobs_encode(const uint8_t *bytes, size_t size, uint8_t *out, size_t capacity);

/* Decodes size bytes in place; *decoded bytes come out, always fewer than went in. On an error *decoded is 0, and the
 * bytes are of no use. Of two faults the first is named. */
enum cobs_error cobs_decode(uint8_t *bytes, size_t size, size_t *decoded);

#endif
