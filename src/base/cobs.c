#include "base/cobs.h"

#include <stdbool.h>

enum { CODE_MAX = 255 }; /* a code and 254 bytes behind it, with no 0 after them */

size_t cobs_encode(const uint8_t *bytes, size_t size, uint8_t *out, size_t capacity)
{
    size_t code = 0u; /* where the code stands whose bytes are being written */
    size_t end = 1u;

    if (capacity == 0u) {
        return 0u;
    }
    for (size_t i = 0u; i < size; i++) {
        const uint8_t byte = bytes[i]; /* read before anything is written, for bytes = out + 1 */
        const bool is_full = end - code == CODE_MAX;

        if (capacity - end < (is_full ? 2u : 1u)) {
            return 0u;
        }
        if (is_full) {
            out[code] = CODE_MAX;
            code = end++;
        }
        if (byte == 0u) {
            out[code] = (uint8_t)(end - code);
            code = end++;
        } else {
            out[end++] = byte;
        }
    }
    out[code] = (uint8_t)(end - code);
    return end;
}

enum cobs_error cobs_decode(uint8_t *bytes, size_t size, size_t *decoded)
{
    size_t to = 0u;
    size_t from = 0u;

    *decoded = 0u;
    if (size == 0u) {
        return COBS_EMPTY;
    }
    while (from < size) {
        const uint8_t code = bytes[from];
        const size_t next = from + code;

        if (code == 0u) {
            return COBS_ZERO;
        }
        for (from++; from < next && from < size; from++) {
            if (bytes[from] == 0u) {
                return COBS_ZERO;
            }
            bytes[to++] = bytes[from];
        }
        if (next > size) {
            return COBS_BEYOND;
        }
        if (code < CODE_MAX && next < size) {
            bytes[to++] = 0u;
        }
    }
    *decoded = to;
    return COBS_OK;
}
