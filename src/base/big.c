/* Ten is 5 * 2: a power of ten is a multiplication by a power of five, or a division with a note that something was
 * left over, and a change of the exponent. */
#include "base/big.h"

/* Bits that a division leaves at least: more than a result of 32 bits needs for rounding. */
enum { QUOTIENT_BITS = 40 };

static const uint32_t powers_of_five[] = {1u,     5u,      25u,      125u,     625u,      3125u,      15625u,
                                          78125u, 390625u, 1953125u, 9765625u, 48828125u, 244140625u, 1220703125u};

void big_set(struct big *big, uint64_t value, int exponent)
{
    big->words[0] = (uint32_t)value;
    big->words[1] = (uint32_t)(value >> 32);
    big->count = big->words[1] != 0u ? 2u : big->words[0] != 0u ? 1u : 0u;
    big->exponent = exponent;
    big->is_inexact = false;
}

void big_multiply_add(struct big *big, uint32_t factor, uint32_t summand)
{
    uint32_t carry = summand;

    for (unsigned i = 0u; i < big->count; i++) {
        const uint64_t product = (uint64_t)big->words[i] * factor + carry;

        big->words[i] = (uint32_t)product;
        carry = (uint32_t)(product >> 32);
    }
    if (carry != 0u) {
        big->words[big->count++] = carry;
    }
}

uint32_t big_divide(struct big *big, uint32_t divisor)
{
    uint32_t remainder = 0u;

    /* Half a word at a time, because 64 by 32 bits would need a library. */
    for (unsigned i = big->count; i-- > 0u;) {
        const uint32_t high = remainder << 16 | big->words[i] >> 16;
        const uint32_t low = high % divisor << 16 | (big->words[i] & 0xffffu);

        big->words[i] = high / divisor << 16 | low / divisor;
        remainder = low % divisor;
    }
    while (big->count > 0u && big->words[big->count - 1u] == 0u) {
        big->count--;
    }
    return remainder;
}

static void big_shift_left(struct big *big, unsigned bits)
{
    const unsigned whole = bits / 32u;

    big_multiply_add(big, UINT32_C(1) << bits % 32u, 0u);
    if (whole == 0u || big->count == 0u) {
        return;
    }
    for (unsigned i = big->count; i-- > 0u;) {
        big->words[i + whole] = big->words[i];
    }
    for (unsigned i = 0u; i < whole; i++) {
        big->words[i] = 0u;
    }
    big->count += whole;
}

unsigned big_length(const struct big *big)
{
    uint32_t rest = big->count > 0u ? big->words[big->count - 1u] : 0u;
    unsigned length = big->count > 0u ? 32u * (big->count - 1u) : 0u;

    for (unsigned step = 16u; step > 0u; step /= 2u) {
        if (rest >> step != 0u) {
            rest >>= step;
            length += step;
        }
    }
    return length + rest;
}

uint32_t big_bits_at(const struct big *big, unsigned position)
{
    const unsigned index = position / 32u;
    const unsigned shift = position % 32u;
    const uint32_t low = index < big->count ? big->words[index] : 0u;
    const uint32_t high = index + 1u < big->count ? big->words[index + 1u] : 0u;

    return shift == 0u ? low : low >> shift | high << (32u - shift);
}

static bool big_is_zero_below(const struct big *big, unsigned position)
{
    const unsigned whole = position / 32u;

    for (unsigned i = 0u; i < whole && i < big->count; i++) {
        if (big->words[i] != 0u) {
            return false;
        }
    }
    return whole >= big->count || (big->words[whole] & ((UINT32_C(1) << position % 32u) - 1u)) == 0u;
}

/* Makes room for a quotient by 5^fives first: 5^3 < 2^7. */
static void divide_by_fives(struct big *big, unsigned fives)
{
    const unsigned length = big_length(big);
    const unsigned wanted = fives * 7u / 3u + 1u + QUOTIENT_BITS;

    if (length < wanted) {
        big_shift_left(big, wanted - length);
        big->exponent -= (int)(wanted - length);
    }
    while (fives > 0u) {
        const unsigned step = fives < 6u ? fives : 6u;

        big->is_inexact |= big_divide(big, powers_of_five[step]) != 0u;
        fives -= step;
    }
}

static void multiply_by_fives(struct big *big, unsigned fives)
{
    while (fives > 0u) {
        const unsigned step = fives < 13u ? fives : 13u;

        big_multiply_add(big, powers_of_five[step], 0u);
        fives -= step;
    }
}

void big_scale(struct big *big, int power)
{
    big->exponent += power;
    if (power < 0) {
        divide_by_fives(big, (unsigned)-power);
    } else {
        multiply_by_fives(big, (unsigned)power);
    }
}

uint32_t big_round(struct big *big, int exponent)
{
    if (exponent <= big->exponent) {
        big_shift_left(big, (unsigned)(big->exponent - exponent));
        return big_bits_at(big, 0u);
    }
    const unsigned dropped = (unsigned)(exponent - big->exponent);
    const uint32_t rounded = big_bits_at(big, dropped);
    const bool has_half = (big_bits_at(big, dropped - 1u) & 1u) != 0u;
    const bool is_tie = !big->is_inexact && big_is_zero_below(big, dropped - 1u);

    return rounded + (has_half && (!is_tie || (rounded & 1u) != 0u) ? 1u : 0u);
}
