/* Is the controller still there? A plant that steers a rig must not look alive while its controller is silent:
 *
 *     OFF --demand--> FRESH --silent for `stale`--> STALE --silent for `safe`--> SAFE
 *                       ^------------demand-----------'                           |
 *                       '------------------an explicit start----------------------'
 *
 * In STALE what was asked for is held, and flagged; in SAFE the brake force goes to 0 at a constant rate. A state
 * machine on integers, without a clock of its own: the caller says what a step counts for. It is asked before each
 * step, so that what it decides depends on the steps and the demands alone. PROTOCOL.md, "Safe state". */
#ifndef SIM_WATCH_H
#define SIM_WATCH_H

#include <stdbool.h>
#include <stdint.h>

#include "model/params.h"
#include "model/scale.h"

enum watch_state {
    WATCH_OFF, /* nobody steers, or nobody wants to know */
    WATCH_FRESH,
    WATCH_STALE,
    WATCH_SAFE
};

enum { WATCH_TIME_BITS = 44 }; /* times are in 2^-44 s, and so is the part of the force that is gone in 2^-44 */

#define WATCH_ALL (UINT64_C(1) << WATCH_TIME_BITS)
#define WATCH_SILENCE_MAX (UINT64_C(1) << 60) /* longer than any limit; it is not counted beyond */
#define WATCH_NEVER UINT64_MAX

/* What a step counts for. */
struct watch_pace {
    uint64_t time;
    uint64_t ramp; /* part of the force that it takes away, once safe */
};

struct watch_config {
    uint64_t stale, safe;           /* silence that is too long, or WATCH_NEVER */
    struct watch_pace locked, free; /* a step that was granted, by plant time; one in free run, by wall time */
};

struct watch {
    uint8_t state;          /* enum watch_state */
    uint64_t silence;       /* since the last demand took hold, at the beginning of the step to come */
    uint64_t ramp;          /* part of the force that is gone */
    uint32_t stales, safes; /* times that it became so since reset */
};

/* Limits and paces of a checked set. [MAIN] */
void watch_configure(struct watch_config *config, const struct params *params, const struct scale *scale);

/* Are there limits at all? [ANY] */
static inline bool watch_is_wanted(const struct watch_config *config)
{
    return config->stale != WATCH_NEVER || config->safe != WATCH_NEVER;
}

/* A demand has taken hold, or in SAFE an explicit start. is_held: force or speed, or both, are the controller's.
 * [ISR] */
void watch_hear(struct watch *watch, const struct watch_config *config, bool is_held);

/* Another set took hold. A watch that it switches on begins now; one that it switches off ends, but SAFE stays.
 * [ISR] */
void watch_follow(struct watch *watch, const struct watch_config *config, bool is_held);

/* A step begins: decides its state, then counts it. Not for WATCH_OFF. [ISR] */
void watch_advance(struct watch *watch, const struct watch_config *config, const struct watch_pace *pace);

/* Time that passes without a step: as much as so many of this pace take, at most 2^16 of them. [ISR] */
void watch_pass(struct watch *watch, const struct watch_pace *pace, uint32_t count);

/* Part of the force that is left, Q30: 2^30 until SAFE. [ISR] */
int32_t watch_share_q30(const struct watch *watch);

/* Does the state say that the controller's demand is too old to be judged by? [ANY] */
static inline bool watch_is_silent(uint8_t state) { return state >= WATCH_STALE; }

/* The words of the protocol. [MAIN] */
const char *watch_state_name(uint8_t state);

#endif
