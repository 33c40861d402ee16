/* Byte stuffing: published vectors, all edges of the blocks of 254, and nothing outside the buffers. */
#include "base/cobs.h"

#include "base/compiler.h"
#include "base/mem.h"
#include "tap.h"
#include "tests.h"

enum { SIZE_MAX_TESTED = 600, GUARD = 0xa5 };

static uint8_t plain[SIZE_MAX_TESTED];
static uint8_t stuffed[COBS_SIZE_MAX(SIZE_MAX_TESTED) + 1];

/* The encoding by the book, for comparison: 254 other than 0 make a block of their own. */
static size_t stuff_by_the_book(const uint8_t *bytes, size_t size, uint8_t *out)
{
    size_t end = 0u;
    size_t i = 0u;

    for (;;) {
        size_t run = 0u;

        while (i + run < size && bytes[i + run] != 0u && run < 254u) {
            run++;
        }
        out[end++] = (uint8_t)(run + 1u);
        memcpy(out + end, bytes + i, run);
        end += run;
        i += run;
        if (i == size) {
            return end;
        }
        i += run < 254u ? 1u : 0u;
        if (i == size && run < 254u) {
            out[end++] = 1u;
            return end;
        }
    }
}

static bool is_vector(const char *bytes, size_t size, const char *expected, size_t expected_size)
{
    size_t decoded;

    memcpy(plain, bytes, size);
    memset(stuffed, GUARD, sizeof stuffed);
    return cobs_encode(plain, size, stuffed, expected_size) == expected_size &&
           memcmp(stuffed, expected, expected_size) == 0 && stuffed[expected_size] == GUARD &&
           cobs_decode(stuffed, expected_size, &decoded) == COBS_OK && decoded == size &&
           memcmp(stuffed, bytes, size) == 0;
}

#define VECTOR(bytes, expected) \
    tap_check(is_vector(bytes, sizeof(bytes) - 1u, expected, sizeof(expected) - 1u), #bytes " is stuffed, and back")

static void check_vectors(void)
{
    VECTOR("", "\x01");
    VECTOR("\0", "\x01\x01");
    VECTOR("\0\0", "\x01\x01\x01");
    VECTOR("\0\x11\0", "\x01\x02\x11\x01");
    VECTOR("\x11\x22\0\x33", "\x03\x11\x22\x02\x33");
    VECTOR("\x11\x22\x33\x44", "\x05\x11\x22\x33\x44");
    VECTOR("\x11\0\0\0", "\x02\x11\x01\x01\x01");
    VECTOR("12345", "\x06"
                    "12345");
    VECTOR("12345\0006789", "\x06"
                            "12345\x05"
                            "6789");
    VECTOR("\0"
           "12345\0006789\0",
           "\x01\x06"
           "12345\x05"
           "6789\x01");
}

/* Round trip of plain[0 .. size), in the least room and in one byte less, apart and in place. */
static bool is_exact(size_t size)
{
    static uint8_t book[COBS_SIZE_MAX(SIZE_MAX_TESTED)];
    const size_t expected = stuff_by_the_book(plain, size, book);
    size_t decoded;
    bool ok = expected <= COBS_SIZE_MAX(size);

    for (size_t room = expected < 4u ? 0u : expected - 4u; room < expected; room++) {
        memset(stuffed, GUARD, sizeof stuffed);
        ok = ok && cobs_encode(plain, size, stuffed, room) == 0u && stuffed[room] == GUARD;
    }
    memset(stuffed, GUARD, sizeof stuffed);
    ok = ok && cobs_encode(plain, size, stuffed, expected) == expected && stuffed[expected] == GUARD &&
         memcmp(stuffed, book, expected) == 0;
    for (size_t i = 0u; i < expected; i++) {
        ok = ok && stuffed[i] != 0u;
    }
    ok = ok && cobs_decode(stuffed, expected, &decoded) == COBS_OK && decoded == size &&
         memcmp(stuffed, plain, size) == 0 && stuffed[expected] == GUARD;
    if (size <= 254u) {
        memcpy(stuffed + 1, plain, size);
        ok =
            ok && cobs_encode(stuffed + 1, size, stuffed, expected) == expected && memcmp(stuffed, book, expected) == 0;
    }
    return ok;
}

static void check_edges(void)
{
    static const size_t sizes[] = {0u, 1u, 2u, 252u, 253u, 254u, 255u, 256u, 507u, 508u, 509u, 510u, SIZE_MAX_TESTED};
    bool ok = true;

    for (size_t i = 0u; i < BASE_COUNT(sizes); i++) {
        memset(plain, 0, sizeof plain);
        ok = ok && is_exact(sizes[i]);
        memset(plain, 0xff, sizeof plain);
        ok = ok && is_exact(sizes[i]);
        for (size_t j = 0u; j < sizes[i] && j < 260u; j++) {
            plain[j] = 0u;
            ok = ok && is_exact(sizes[i]);
            plain[j] = 1u;
        }
    }
    tap_check(ok, "zeros, none, one anywhere: around 0, 254 and 508 bytes, in exactly the room that is needed");
    memset(plain, 0xff, sizeof plain);
    tap_check(cobs_encode(plain, 254u, stuffed, sizeof stuffed) == 255u && stuffed[0] == 255u,
              "254 bytes other than 0 are one block");
    tap_check(cobs_encode(plain, 255u, stuffed, sizeof stuffed) == 257u && stuffed[0] == 255u && stuffed[255] == 2u,
              "255 are two");
    tap_check(COBS_SIZE_MAX(0) == 1 && COBS_SIZE_MAX(254) == 255 && COBS_SIZE_MAX(255) == 257,
              "and that is the most they may take");
}

static void check_random(void)
{
    uint32_t state = 3u;
    bool ok = true;

    for (unsigned i = 0u; i < (tap_is_hosted() ? 20000u : 100u); i++) {
        const size_t size = tap_random(&state) % (SIZE_MAX_TESTED + 1u);
        const uint32_t zeros = tap_random(&state) % 9u; /* of 8 bytes; 0 and 8: none and all */

        for (size_t j = 0u; j < size; j++) {
            const uint32_t word = tap_random(&state);

            plain[j] = word % 8u < zeros ? 0u : (uint8_t)(1u + (word >> 8) % 255u);
        }
        ok = ok && is_exact(size);
    }
    tap_check(ok, "random bytes come back");
}

static bool is_contained;

/* Behind the bytes stand zeros, which would be named if they were read. */
static enum cobs_error decode(const char *bytes, size_t size)
{
    size_t decoded = 99u;
    enum cobs_error error;

    memset(stuffed, 0, sizeof stuffed);
    memcpy(stuffed, bytes, size);
    error = cobs_decode(stuffed, size, &decoded);
    is_contained = is_contained && (error == COBS_OK || decoded == 0u);
    return error;
}

static void check_errors(void)
{
    uint32_t state = 5u;
    bool ok = true;

    is_contained = true;
    tap_check(decode("", 0u) == COBS_EMPTY, "no byte at all is no encoding");
    tap_check(decode("\0", 1u) == COBS_ZERO && decode("\x02\0", 2u) == COBS_ZERO && decode("\x01\0", 2u) == COBS_ZERO,
              "a 0 is an error, as a code and elsewhere");
    tap_check(decode("\x02", 1u) == COBS_BEYOND && decode("\x02\x11\x03\x11", 4u) == COBS_BEYOND &&
                  decode("\xff\x11", 2u) == COBS_BEYOND,
              "a code that points beyond the end is another");
    tap_check(decode("\x03\x11\x22", 3u) == COBS_OK && decode("\x04\x11\x22", 3u) == COBS_BEYOND &&
                  decode("\x02\x11\x22", 3u) == COBS_BEYOND,
              "by one byte only, as well");
    tap_check(decode("\x09\0", 2u) == COBS_ZERO, "of two faults the first is named");
    for (unsigned i = 0u; i < (tap_is_hosted() ? 100000u : 1000u); i++) {
        char bytes[40];
        const size_t size = 1u + tap_random(&state) % sizeof bytes;
        size_t end = 0u;
        bool has_zero = false;

        for (size_t j = 0u; j < size; j++) {
            const uint32_t word = tap_random(&state);

            bytes[j] = (char)(word % 4u == 0u ? word >> 24 : word >> 30);
            has_zero = has_zero || bytes[j] == 0;
        }
        while (end < size && bytes[end] != 0) {
            end += (uint8_t)bytes[end];
        }
        ok = ok && (decode(bytes, size) == COBS_OK) == (!has_zero && end == size);
    }
    tap_check(ok, "of random bytes those are refused whose chain of codes does not end with them");
    tap_check(is_contained, "what is refused gives nothing");
}

void test_cobs(void)
{
    check_vectors();
    check_edges();
    check_random();
    check_errors();
}
