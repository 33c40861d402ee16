/* The disc's surface under the pad: what makes a brake force of N(t) act as N(t) (1 + texture). Two parts:
 *
 *   roughness  white noise, uniformly distributed, with the given rms, so never beyond sqrt(3) of it; one value holds
 *              for 1/16 of a normal period, which is the longest model step, so every spp meets the same realisation
 *   run-out    a sine of the disc's angle, once a revolution, held for as long
 *
 * Textures are in Q30. With both ratios 0 there is none, and no bit of a trajectory knows of this file. */
#ifndef SIM_TEXTURE_H
#define SIM_TEXTURE_H

#include <stdbool.h>
#include <stdint.h>

#include "model/params.h"
#include "model/scale.h"

struct texture {
    bool is_active;
    uint32_t seed;
    unsigned hold_shift; /* one random value holds for 2^hold_shift steps */
    int32_t roughness;   /* largest random part, Q30 */
    int32_t runout;      /* amplitude, Q30 */
    uint64_t turns;      /* 2^-64 turns that the disc makes in a step at a speed of 2^-27 units */
    uint32_t turns_rest; /* and 2^-95 turns: a disc that creeps must not stall on rounding */
};

/* Where the disc stands. 2^64 is a turn, so it wraps as the disc does; the rest counts 2^-95 turns and is positive. */
struct texture_angle {
    uint64_t turns;
    uint32_t rest;
};

/* Texture of a checked set. [MAIN] */
void texture_derive(struct texture *texture, const struct params *params, const struct scale *scale);

/* Does a new texture begin with this step? It holds for 1/16 of a normal period. [ISR, pure] */
static inline bool texture_begins(const struct texture *texture, uint64_t step)
{
    return ((uint32_t)step & ((1u << texture->hold_shift) - 1u)) == 0u;
}

/* Texture that begins with a step: the noise of its index, and the run-out at the middle of its time. angle is that of
 * its start, disc the speed at it in Q4.27. Pure: the random part depends on (seed, step) alone. [ISR] */
int32_t texture_value(const struct texture *texture, const struct texture_angle *angle, uint64_t step, int32_t disc);

/* The disc turns by one step at this speed, forwards or backwards, without rounding. [ISR] */
void texture_turn(const struct texture *texture, struct texture_angle *angle, int32_t disc);

/* A load under a texture, in either arithmetic. */
static inline float texture_load_f32(float load, int32_t texture)
{
    return load * (1.0f + (float)texture * (1.0f / 1073741824.0f));
}

int32_t texture_load_q27(int32_t load, int32_t texture);

#endif
