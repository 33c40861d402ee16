/* Products of more than 64 bits, by halves. */
#include "sim/turns.h"

uint64_t turns_in_step(float turns)
{
    const float fraction = turns < 4294967296.0f ? turns - (float)(uint32_t)turns : 0.0f;
    const float scaled = fraction * 4294967296.0f; /* in 2^-32 turns, exact but for its own bits */
    const uint32_t high = (uint32_t)scaled;

    return ((uint64_t)high << 32) | (uint32_t)((scaled - (float)high) * 4294967296.0f);
}

uint64_t turns_in_time(uint64_t turns_per_step, uint64_t time)
{
    const uint64_t part = time & ((UINT64_C(1) << 30) - 1u);

    return turns_per_step * (time >> 30) + ((turns_per_step >> 32) * part << 2) +
           ((turns_per_step & UINT32_MAX) * part >> 30);
}

uint64_t turns_part(uint64_t turns, uint64_t whole)
{
    const uint64_t high = turns >> 32;
    const uint64_t low = turns & UINT32_MAX;
    const uint64_t upper = high * (whole & UINT32_MAX);
    const uint64_t lower = low * (whole >> 32);
    const uint64_t carry = (low * (whole & UINT32_MAX) >> 32) + (upper & UINT32_MAX) + (lower & UINT32_MAX);

    return high * (whole >> 32) + (upper >> 32) + (lower >> 32) + (carry >> 32);
}
