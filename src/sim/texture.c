/* Roughness from a generator without a state, run-out from an angle counted in integers. */
#include "sim/texture.h"

#include "base/fixed.h"
#include "base/fmath.h"
#include "base/random.h"

enum { STREAM_ROUGHNESS = 1, TEXTURE_BITS = 30, REST_BITS = 31 };

#define TURNS_MAX 33554432.0f /* 2^25 turns a step; a disc so fast has no angle that a step could see */

void texture_derive(struct texture *texture, const struct params *params, const struct scale *scale)
{
    const float way_m = scale->speed_m_per_s * scale->step_s;
    const float turns = fmath_min(way_m / (2.0f * FMATH_PI * params->radius_m), TURNS_MAX);
    const float scaled = turns * 137438953472.0f; /* 2^64/2^27, exact */
    const float rest = scaled < 4294967296.0f ? scaled - (float)(uint32_t)scaled : 0.0f;

    texture->is_active = params->roughness_ratio > 0.0f || params->runout_ratio > 0.0f;
    texture->seed = (uint32_t)params->seed;
    texture->hold_shift = (unsigned)params->steps_per_period;
    texture->roughness = fixed_from_float(SCALE_ROUGHNESS_PEAK * params->roughness_ratio, TEXTURE_BITS);
    texture->runout = fixed_from_float(params->runout_ratio, TEXTURE_BITS);
    texture->turns = (uint64_t)fixed_times_float(1, scaled - rest, 0);
    texture->turns_rest = (uint32_t)fixed_times_float(1, rest, REST_BITS);
}

static int32_t roughness(const struct texture *texture, uint64_t step)
{
    const int32_t noise = random_uniform_q31(texture->seed, STREAM_ROUGHNESS, step >> texture->hold_shift);

    return fixed_product(noise, texture->roughness, 31u);
}

static int32_t runout(const struct texture *texture, const struct texture_angle *angle, int32_t disc)
{
    const int64_t half = fixed_floor((int64_t)((uint64_t)(int64_t)disc * texture->turns), 1u);
    const uint64_t middle = angle->turns + ((uint64_t)half << texture->hold_shift);

    return fixed_product(fmath_sine_turns_q30((uint32_t)(middle >> 32)), texture->runout, TEXTURE_BITS);
}

int32_t texture_value(const struct texture *texture, const struct texture_angle *angle, uint64_t step, int32_t disc)
{
    const int32_t random = texture->roughness != 0 ? roughness(texture, step) : 0;

    return random + (texture->runout != 0 ? runout(texture, angle, disc) : 0);
}

void texture_turn(const struct texture *texture, struct texture_angle *angle, int32_t disc)
{
    const int64_t rest = (int64_t)disc * texture->turns_rest + angle->rest;

    angle->turns += (uint64_t)(int64_t)disc * texture->turns + (uint64_t)fixed_floor(rest, REST_BITS);
    angle->rest = (uint32_t)((uint64_t)rest & ((UINT32_C(1) << REST_BITS) - 1u));
}

int32_t texture_load_q27(int32_t load, int32_t texture) { return load + fixed_product(load, texture, TEXTURE_BITS); }
