/* splitmix64: a counter, well stirred. */
#include "dice.h"

#include <math.h>

uint64_t dice_next(struct dice *dice)
{
    uint64_t z = dice->state += 0x9e3779b97f4a7c15u;

    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

int dice_choice(struct dice *dice, int count) { return (int)((dice_next(dice) >> 33) % (uint64_t)count); }

double dice_uniform(struct dice *dice, double low, double high)
{
    const double share = (double)(dice_next(dice) >> 11) / 9007199254740992.0; /* 2^53 */

    return low + share * (high - low);
}

/* low (high/low)^u, the bits of u taken one by one: a square root is rounded alike everywhere, a power is not. */
double dice_log(struct dice *dice, double low, double high)
{
    const uint64_t bits = dice_next(dice);
    double ratio = high / low;
    double value = low;

    for (int bit = 63; bit >= 24; bit--) {
        ratio = sqrt(ratio);
        value *= (bits >> bit) & 1u ? ratio : 1.0;
    }
    return value;
}
