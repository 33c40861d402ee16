#include "base/hash.h"

#include "tap.h"
#include "tests.h"

void test_hash(void)
{
    /* For words below 256 this is FNV-1a over bytes, whose published values are these. */
    tap_check(hash_word(HASH_INIT, 'a') == 0xe40c292cu, "a single a gives the published FNV-1a value");
    tap_check(hash_word(hash_word(HASH_INIT, 'f'), 'o') == 0x6222e842u, "so does fo");
    tap_check(hash_word(hash_word(hash_word(HASH_INIT, 'f'), 'o'), 'o') == 0xa9f37ed7u, "so does foo");
    tap_check(hash_word(hash_word(HASH_INIT, 1u), 2u) != hash_word(hash_word(HASH_INIT, 2u), 1u), "order counts");
    tap_check(hash_word(HASH_INIT, 0u) != HASH_INIT, "a zero counts");
    tap_check(hash_word(HASH_INIT, 0x80000000u) != hash_word(HASH_INIT, 0u), "the sign bit of a float counts");
}
