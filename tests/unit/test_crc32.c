#include "base/crc32.h"

#include "base/compiler.h"
#include "tap.h"
#include "tests.h"

static uint32_t crc_of_text(const char *text)
{
    uint32_t crc = 0u;

    for (; *text != '\0'; text++) {
        const uint8_t byte = (uint8_t)*text;

        crc = crc32_add(crc, &byte, 1u);
    }
    return crc;
}

/* By the definition: one bit at a time. */
static uint32_t crc_by_bits(const uint8_t *bytes, size_t size)
{
    uint32_t crc = 0xffffffffu;

    for (size_t i = 0u; i < 8u * size; i++) {
        const uint32_t bit = (uint32_t)bytes[i / 8u] >> i % 8u & 1u;

        crc = ((crc ^ bit) & 1u) != 0u ? crc >> 1 ^ 0xedb88320u : crc >> 1;
    }
    return ~crc;
}

/* What zlib 1.2.13 gives. */
static void check_vectors(void)
{
    uint8_t bytes[256] = {0u};

    tap_check(crc32_add(0u, bytes, 0u) == 0u, "nothing has 0");
    tap_check(crc_of_text("123456789") == 0xcbf43926u, "the check value of the polynomial's catalogue");
    tap_check(crc_of_text("a") == 0xe8b7be43u, "one letter as in zlib");
    for (unsigned i = 0u; i < 256u; i++) {
        bytes[i] = (uint8_t)i;
    }
    tap_check(crc32_add(0u, bytes, 256u) == 0x29058c73u, "all bytes as in zlib");
    for (unsigned i = 0u; i < 64u; i++) {
        bytes[i] = i < 32u ? 0u : 0xffu;
    }
    tap_check(crc32_add(0u, bytes, 32u) == 0x190a55adu, "32 zeros as in zlib");
    tap_check(crc32_add(0u, bytes + 32, 32u) == 0xff6cab0bu, "32 times 255 as in zlib");
}

static void check_random(void)
{
    uint32_t state = 1u;
    bool is_equal = true;
    bool is_one = true;

    for (unsigned i = 0u; i < (tap_is_hosted() ? 20000u : 200u); i++) {
        uint8_t bytes[64];
        const size_t size = tap_random(&state) % (BASE_COUNT(bytes) + 1u);
        const size_t cut = size == 0u ? 0u : tap_random(&state) % size;

        for (size_t j = 0u; j < size; j++) {
            bytes[j] = (uint8_t)(tap_random(&state) >> 24);
        }
        is_equal = is_equal && crc32_add(0u, bytes, size) == crc_by_bits(bytes, size);
        is_one = is_one && crc32_add(crc32_add(0u, bytes, cut), bytes + cut, size - cut) == crc32_add(0u, bytes, size);
    }
    tap_check(is_equal, "random bytes have the CRC of the definition");
    tap_check(is_one, "in two parts as well as in one");
}

void test_crc32(void)
{
    check_vectors();
    check_random();
}
