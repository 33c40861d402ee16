#include "sim/watch.h"

#include "base/compiler.h"
#include "base/fixed.h"
#include "base/fmath.h"

enum { SHARE_BITS = 30 };

#define STEP_MAX_S 2e4f /* a longer one is over any limit too */
#define HASTE 1.000001f /* what is rounded in the steps of a ramp must not make it late */

static uint64_t limit_of(float silence_s)
{
    return silence_s > 0.0f ? (uint64_t)fixed_times_float(1, silence_s, WATCH_TIME_BITS) : WATCH_NEVER;
}

static struct watch_pace pace_of(float step_s, float ramp_s)
{
    const float part = fmath_min(HASTE * step_s / fmath_max(ramp_s, step_s), 1.0f);
    struct watch_pace pace;

    pace.time = (uint64_t)fixed_times_float(1, fmath_min(step_s, STEP_MAX_S), WATCH_TIME_BITS);
    pace.ramp = (uint64_t)fixed_times_float(1, part, WATCH_TIME_BITS);
    return pace;
}

void watch_configure(struct watch_config *config, const struct params *params, const struct scale *scale)
{
    config->stale = limit_of(params->stale_s);
    config->safe = limit_of(params->safe_s);
    config->locked = pace_of(scale->step_s, params->ramp_s);
    config->free = pace_of(1.0f / (params->tick_hz * params->steps_per_tick), params->ramp_s);
}

void watch_hear(struct watch *watch, const struct watch_config *config, bool is_held)
{
    watch->state = is_held && watch_is_wanted(config) ? WATCH_FRESH : WATCH_OFF;
    watch->silence = 0u;
    watch->ramp = 0u;
}

void watch_follow(struct watch *watch, const struct watch_config *config, bool is_held)
{
    const bool is_on = is_held && watch_is_wanted(config);

    if (watch->state != WATCH_SAFE && is_on != (watch->state != WATCH_OFF)) {
        watch_hear(watch, config, is_held);
    }
}

static uint64_t least(uint64_t a, uint64_t b) { return a < b ? a : b; }

void watch_advance(struct watch *watch, const struct watch_config *config, const struct watch_pace *pace)
{
    if (watch->state == WATCH_FRESH && watch->silence >= config->stale) {
        watch->state = WATCH_STALE;
        watch->stales++;
    }
    if (watch->state != WATCH_SAFE && watch->silence >= config->safe) {
        watch->state = WATCH_SAFE;
        watch->safes++;
    }
    if (watch->state == WATCH_SAFE) {
        watch->ramp = least(watch->ramp + pace->ramp, WATCH_ALL);
    }
    watch->silence = least(watch->silence + pace->time, WATCH_SILENCE_MAX);
}

void watch_pass(struct watch *watch, const struct watch_pace *pace, uint32_t count)
{
    const uint64_t many = least(count, 1u << 16);

    if (watch->state == WATCH_SAFE) {
        watch->ramp = least(watch->ramp + many * pace->ramp, WATCH_ALL);
    }
    watch->silence = least(watch->silence + many * pace->time, WATCH_SILENCE_MAX);
}

int32_t watch_share_q30(const struct watch *watch)
{
    return (int32_t)((WATCH_ALL - watch->ramp) >> (WATCH_TIME_BITS - SHARE_BITS));
}

const char *watch_state_name(uint8_t state)
{
    static const char *const names[] = {"off", "fresh", "stale", "safe"};

    return state < BASE_COUNT(names) ? names[state] : "?";
}
