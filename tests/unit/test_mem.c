/* On the host the C library serves the names of these functions, so the project's own are compiled here under others.
 */
#define memcpy test_memcpy
#define memmove test_memmove
#define memset test_memset
#define memcmp test_memcmp
#include "base/mem.c"

#include "tap.h"
#include "tests.h"

enum { SIZE = 40, OFFSETS = 8, LENGTHS = 24 };

static void fill(uint8_t *bytes)
{
    for (unsigned i = 0u; i < SIZE; i++) {
        bytes[i] = (uint8_t)(i * 37u + 11u);
    }
}

static uint8_t pattern(unsigned index) { return (uint8_t)(index * 37u + 11u); }

static bool copies(unsigned to, unsigned from, unsigned length)
{
    uint32_t in_words[SIZE / 4];
    uint32_t out_words[SIZE / 4] = {0u};
    uint8_t *in = (uint8_t *)in_words;
    uint8_t *out = (uint8_t *)out_words;
    bool ok;

    fill(in);
    ok = memcpy(out + to, in + from, length) == out + to;
    for (unsigned i = 0u; i < SIZE; i++) {
        ok = ok && out[i] == (i >= to && i < to + length ? pattern(i - to + from) : 0u);
    }
    return ok;
}

static bool moves(unsigned to, unsigned from, unsigned length)
{
    uint32_t words[SIZE / 4];
    uint8_t *bytes = (uint8_t *)words;
    bool ok;

    fill(bytes);
    ok = memmove(bytes + to, bytes + from, length) == bytes + to;
    for (unsigned i = 0u; i < SIZE; i++) {
        ok = ok && bytes[i] == pattern(i >= to && i < to + length ? i - to + from : i);
    }
    return ok;
}

static bool sets(unsigned to, unsigned length)
{
    uint32_t words[SIZE / 4];
    uint8_t *bytes = (uint8_t *)words;
    bool ok;

    fill(bytes);
    ok = memset(bytes + to, 0x1a5, length) == bytes + to; /* only the low byte counts */
    for (unsigned i = 0u; i < SIZE; i++) {
        ok = ok && bytes[i] == (i >= to && i < to + length ? 0xa5u : pattern(i));
    }
    return ok;
}

static void check_compare(void)
{
    const uint8_t a[] = {1u, 2u, 3u, 200u, 5u};
    const uint8_t b[] = {1u, 2u, 3u, 100u, 6u};

    tap_check(memcmp(a, b, 3u) == 0 && memcmp(a, b, 0u) == 0, "equal beginnings compare equal, empty ones too");
    tap_check(memcmp(a, b, 5u) > 0 && memcmp(b, a, 5u) < 0, "the first difference decides, as unsigned bytes");
}

void test_mem(void)
{
    bool are_copied = true;
    bool are_moved = true;
    bool are_set = true;

    for (unsigned to = 0u; to < OFFSETS; to++) {
        for (unsigned length = 0u; length <= LENGTHS; length++) {
            are_set = are_set && sets(to, length);
            for (unsigned from = 0u; from < OFFSETS; from++) {
                are_copied = are_copied && copies(to, from, length);
                are_moved = are_moved && moves(to, from, length);
            }
        }
    }
    tap_check(are_copied, "memcpy copies every length between every alignment, and nothing beside it");
    tap_check(are_moved, "memmove does the same between ranges that overlap either way");
    tap_check(are_set, "memset fills every length at every alignment, and nothing beside it");
    check_compare();
}
