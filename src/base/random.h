/* Random numbers without a state: each is a function of (seed, stream, index) alone, so any may be asked for, in any
 * order and on any machine, and is the same to the bit. Streams are independent of each other, and so are seeds.
 *
 * The words are those of Threefry-2x32 with 20 rounds (Salmon, Moraes, Dror, Shaw: Parallel random numbers: as easy as
 * 1, 2, 3; 2011) under the key (seed, stream): additions, rotations and exclusive ors, some 60 instructions for two
 * words. For simulation, not for secrets. [ANY, pure] */
#ifndef BASE_RANDOM_H
#define BASE_RANDOM_H

#include <stdint.h>

struct random_words {
    uint32_t first, second;
};

/* Two independent words. */
struct random_words random_words(uint32_t seed, uint32_t stream, uint64_t index);

/* Uniform over -1 ... 1, ends excluded, in Q31; its rms is 1/sqrt(3). Always odd, so that a value and its opposite are
 * equally likely and the mean is 0 exactly. */
int32_t random_uniform_q31(uint32_t seed, uint32_t stream, uint64_t index);

/* Normally distributed with mean 0 and variance 1, by Box and Muller; never beyond 6.8. */
float random_normal(uint32_t seed, uint32_t stream, uint64_t index);

#endif
