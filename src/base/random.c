/* Threefry-2x32, and what is made of its words. */
#include "base/random.h"

#include "base/compiler.h"
#include "base/fmath.h"

#define KEY_PARITY 0x1BD11BDAu /* of the key schedule that Threefry shares with the cipher Threefish */
#define LN2 0.693147181f

static uint32_t rotate_left(uint32_t word, unsigned bits) { return word << bits | word >> (32u - bits); }

BASE_INLINE void mix_once(struct random_words *words, unsigned bits)
{
    words->first += words->second;
    words->second = rotate_left(words->second, bits) ^ words->first;
}

/* Four rounds of the one kind, four of the other. */
BASE_INLINE void mix_odd(struct random_words *words)
{
    mix_once(words, 13u);
    mix_once(words, 15u);
    mix_once(words, 26u);
    mix_once(words, 6u);
}

BASE_INLINE void mix_even(struct random_words *words)
{
    mix_once(words, 17u);
    mix_once(words, 29u);
    mix_once(words, 16u);
    mix_once(words, 24u);
}

BASE_INLINE void add_key(struct random_words *words, uint32_t first, uint32_t second)
{
    words->first += first;
    words->second += second;
}

struct random_words random_words(uint32_t seed, uint32_t stream, uint64_t index)
{
    const uint32_t third = KEY_PARITY ^ seed ^ stream;
    struct random_words words = {(uint32_t)index, (uint32_t)(index >> 32)};

    add_key(&words, seed, stream);
    mix_odd(&words);
    add_key(&words, stream, third + 1u);
    mix_even(&words);
    add_key(&words, third, seed + 2u);
    mix_odd(&words);
    add_key(&words, seed, stream + 3u);
    mix_even(&words);
    add_key(&words, stream, third + 4u);
    mix_odd(&words);
    add_key(&words, third, seed + 5u);
    return words;
}

int32_t random_uniform_q31(uint32_t seed, uint32_t stream, uint64_t index)
{
    return (int32_t)(random_words(seed, stream, index).first | 1u);
}

/* The radius comes from a word as a number above 0 and up to 1, whose logarithm is finite; -2 ln u = -2 ln 2 log2 u. */
float random_normal(uint32_t seed, uint32_t stream, uint64_t index)
{
    const struct random_words words = random_words(seed, stream, index);
    const float unit = ((float)words.first + 0.5f) * (1.0f / 4294967296.0f);
    const float radius = fmath_sqrt(-2.0f * LN2 * fmath_log2(unit));

    return radius * fmath_sine_turns(words.second);
}
