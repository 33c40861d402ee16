/* Integer arithmetic that takes more than a line. */
#include "base/fixed.h"

#include "base/compiler.h"
#include "base/fmath.h"

#define TIMES_MAX ((int64_t)1 << 62)

unsigned fixed_bits(uint64_t magnitude)
{
    const uint32_t high = (uint32_t)(magnitude >> 32);
    const uint32_t low = (uint32_t)magnitude;

    return high != 0u ? 64u - BASE_LEADING_ZEROS(high) : low != 0u ? 32u - BASE_LEADING_ZEROS(low) : 0u;
}

/* All bits of the part over the first sixteen of the whole, which leave at least fifteen of the quotient. */
uint32_t fixed_ratio_q30(uint32_t part, uint32_t whole)
{
    const unsigned whole_zeros = BASE_LEADING_ZEROS(whole);
    const unsigned part_zeros = part != 0u ? BASE_LEADING_ZEROS(part) : 31u;
    const uint32_t quotient = (part << part_zeros) / ((whole << whole_zeros) >> 16); /* times 2^(part - whole + 16) */
    const unsigned down = part_zeros - whole_zeros;
    const uint32_t ratio = down <= 14u ? quotient << (14u - down) : quotient >> (down - 14u);

    return ratio < (1u << 30) ? ratio : 1u << 30;
}

int64_t fixed_times_float(int64_t factor, float value, int exponent)
{
    const uint32_t bits = fmath_bits(value);
    const uint32_t field = bits >> 23 & 0xffu;
    const int64_t significand = (int64_t)(bits & 0x7fffffu) | (field != 0u ? 0x800000 : 0);
    const int64_t product = (bits >> 31) != 0u ? -factor * significand : factor * significand;
    const int power = (field != 0u ? (int)field : 1) - 150 + exponent;
    const uint64_t magnitude = product < 0 ? 0u - (uint64_t)product : (uint64_t)product;

    if (product == 0) {
        return 0;
    }
    if (field == 0xffu || (int)fixed_bits(magnitude) + power > 62) {
        return product < 0 ? -TIMES_MAX : TIMES_MAX;
    }
    if (power < 0) {
        return power < -62 ? 0 : fixed_shift_right(product, (unsigned)-power);
    }
    return product * ((int64_t)1 << power);
}

/* Logarithm by repeated squaring of the mantissa: sixteen bits, one at a time. */
int32_t fixed_log2_q16(uint64_t value)
{
    uint32_t exponent = 63u;
    uint32_t mantissa;
    uint32_t fraction = 0u;

    while (exponent > 0u && (value >> 63) == 0u) {
        value <<= 1;
        exponent--;
    }
    mantissa = (uint32_t)(value >> 32); /* 1.31 */
    for (uint32_t bit = 1u << 15; bit != 0u; bit >>= 1) {
        const uint64_t square = (uint64_t)mantissa * mantissa; /* 2.62 */

        if ((square >> 63) != 0u) {
            fraction |= bit;
            mantissa = (uint32_t)(square >> 32);
        } else {
            mantissa = (uint32_t)(square >> 31);
        }
    }
    return (int32_t)((exponent << 16) | fraction);
}
