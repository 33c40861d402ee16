/* The control law: how hard to press so that the brake brakes and does not squeal. A pure function of what it was, what
 * it sees and its settings: no clock, no wire, nothing remembered elsewhere. One call a turn.
 *
 *               +--------+         squeal          +---------+
 *      +------->| BUILD  |------------------------>| RELEASE |<-------------------+
 *      |        +--------+                         +---------+                    |
 *      |  watch |        ^ quiet for hold_s         ^       | low pressure reached |
 *      |        v        |                          |       v                      |
 *      |        +--------+         squeal           |   +---------+  not quiet     |
 *      |        |  HOLD  |--------------------------+   | DITHER  |  in patience_s |
 *      |        +--------+                              +---------+----------------+
 *      |                                                    | quiet for calm_s
 *      +----------------------------------------------------+
 *
 *      SAFE   from anywhere when the plant is not sound; no pressure; left only by law_start()
 *
 * BUILD     pressure rises towards the driver's demand: after each squeal careful_ratio as fast, but not below a least.
 * HOLD      motion grows, nothing is heard yet: pressure is eased, not built up.
 * RELEASE   pressure falls to keep_ratio of what squealed, or by another step to lower_ratio of what did not calm down.
 * DITHER    pressure jumps about the low one until the pad has come to rest.
 *
 * A jump of pressure makes the pad ring at its own 2 kHz, and a ringing pad is what squeal grows from. A turn is two
 * and a half of these periods (conversation.h), so of a jump made in two equal halves, a turn apart, the second takes
 * away what the first set going. That is all that the mean of two turns does.
 *
 * Pressure never exceeds the demand; a demand of 0 releases at once and forgets what was learned. */
#ifndef LAW_H
#define LAW_H

#include <stdbool.h>
#include <stdint.h>

#include "sim/detector.h"

enum law_phase { LAW_BUILD, LAW_HOLD, LAW_RELEASE, LAW_DITHER, LAW_SAFE };

struct law_settings {
    float turn_s;               /* time between two calls, > 0 */
    float build_pa_per_s;       /* until squeal is heard first */
    float build_least_pa_per_s; /* however often it was heard */
    float careful_ratio;        /* 0 .. 1 */
    float release_pa_per_s;
    float ease_per_s;   /* share of the pressure that HOLD takes away in a second */
    float keep_ratio;   /* 0 .. 1 */
    float lower_ratio;  /* 0 .. 1 */
    float dither_ratio; /* height of the jumps, over the low pressure; 0: none */
    float hold_s, calm_s, patience_s;
};

struct law_inputs {
    float demand_pa;    /* the driver's */
    uint8_t propensity; /* enum detector_propensity, as the plant tells it */
    bool is_sound;      /* the plant answers and is in no fault */
};

struct law {
    enum law_phase phase;
    float pressure_pa; /* to be applied in the turn that comes */
    float wanted_pa;   /* what the phase wants; the mean of two turns' is applied */
    float low_pa;      /* that RELEASE goes to and DITHER keeps about */
    float build_pa_per_s;
    uint32_t phase_turns; /* since the phase began */
    uint32_t quiet_turns; /* in a row, within the phase */
    uint32_t squeals;     /* heard since the start */
};

/* Settings for a turn of this length that suit the preset brake. */
struct law_settings law_usual(float turn_s);

/* No pressure, nothing learned. */
struct law law_start(const struct law_settings *settings);

/* The law one turn later. */
struct law law_next(const struct law_settings *settings, const struct law *now, const struct law_inputs *inputs);

/* "build", "hold", "release", "dither", "safe" */
const char *law_phase_name(enum law_phase phase);

#endif
