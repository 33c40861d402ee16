/* Logarithm by repeated squaring of the mantissa: sixteen bits, one at a time. */
#include "base/fixed.h"

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
