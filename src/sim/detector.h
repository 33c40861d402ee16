/* Does the brake squeal, and how? A streaming detector for the timer interrupt: integer arithmetic on the plant's
 * output, a bounded handful of operations a step, the longer work sliced over the steps that follow.
 *
 *   step    -> period -> frame (8 periods) -> window (4 frames) -> verdict
 *   extremes   strobe    growth, events       propensity, class
 *
 * One detector serves every number format. The rules and the reasons for each constant: DETECTOR.md. */
#ifndef SIM_DETECTOR_H
#define SIM_DETECTOR_H

#include <stdbool.h>
#include <stdint.h>

#include "model/plant.h"

enum {
    DETECTOR_FRAME_PERIODS = 8,
    DETECTOR_WINDOW_FRAMES = 4,
    DETECTOR_STROBES = 64, /* states kept, one a period */
    DETECTOR_PEAKS = 32,   /* maxima of x kept */
    DETECTOR_PERIOD_MAX = 16
};

/* How likely is noise now? UNKNOWN until the window is full after any change. */
enum detector_propensity { PROPENSITY_UNKNOWN, PROPENSITY_QUIET, PROPENSITY_WATCH, PROPENSITY_SQUEAL };

/* What kind of motion it is. */
enum detector_class {
    CLASS_UNSETTLED,            /* not enough seen yet */
    CLASS_REST,                 /* no motion above the floor */
    CLASS_DECAYING,             /* slips on; the free part of the motion dies out */
    CLASS_GROWING,              /* slips on; the free part grows */
    CLASS_FORCED,               /* slips on, repeats with the normal oscillation */
    CLASS_STICKSLIP,            /* sticks and repeats with the normal oscillation */
    CLASS_CROSS,                /* overtakes the disc without sticking and repeats */
    CLASS_LIMITCYCLE_SLIP,      /* repeats by itself, without sticking */
    CLASS_LIMITCYCLE_STICKSLIP, /* repeats by itself, with sticking or crossing */
    CLASS_APERIODIC,            /* repeats in nothing that was tried: quasi-periodic, long period or chaotic */
    CLASS_DIVERGING             /* left the domain */
};

/* What the detector must know of the plant, derived with the scale. Speeds in Q4.27 of Vref. */
struct detector_config {
    uint32_t steps_per_period;
    int32_t step_q27;       /* h in units of x per v */
    uint32_t stiffness_q16; /* weight of x against v in the strobe's distance: Z2 in units of x, squared */
    uint32_t gain_q16;      /* forced speed of the pad per speed of the normal oscillation */
    int32_t load_speed;     /* normal speed that a sine of the load explains */
    int32_t load_response;  /* speed of the pad that it explains */
};

/* The verdict of the last full frame, in the units of struct plant_output. */
struct detector_verdict {
    uint32_t frame;     /* frames since reset */
    uint8_t propensity; /* enum detector_propensity */
    uint8_t motion;     /* enum detector_class */
    uint8_t period;     /* multiplicity, 0 where it does not apply */
    bool has_growth;    /* growth could be measured */
    int32_t growth_q16; /* log2 of the free amplitude per frame */
    int32_t growth_error_q16;
    int32_t free_log2_q16; /* log2 of the free part's amplitude in the last frame; below 0: nothing but rounding */
    int32_t x_max, x_min, v_max, v_min; /* over the window */
    int32_t acceleration;               /* largest change of v in a step, over the window */
    uint64_t variance;                  /* of v over the last frame, in 2^-32 */
    int32_t disc;                       /* disc speed at the end of the frame */
    uint32_t stick, slip_minus;         /* shares of the window, PLANT_SHARE_ONE = all */
    uint32_t cycles; /* between first and last upward passage in the window, and the steps they took in Q15 */
    uint64_t cycle_steps_q15;
};

struct detector_frame {
    int32_t x_max, x_min, v_max, v_min, w_max, w_min, acceleration;
    int32_t y_max; /* largest contact, without which nothing squeals */
    uint64_t stick, slip_minus;
    uint64_t first_q15, last_q15; /* upward passages, steps since reset */
    uint32_t crossings;
    int32_t change_log2_q16; /* of the summed squares of strobe-to-strobe changes; negative: none */
};

/* What remains to be done after a frame, a little in every step. */
enum detector_stage { STAGE_IDLE, STAGE_MEASURE, STAGE_JUDGE, STAGE_STROBES, STAGE_PEAKS };

struct detector_search {
    uint8_t stage;  /* enum detector_stage */
    uint8_t period; /* being tried */
    uint8_t index;  /* next pair of it */
    uint32_t head;  /* strobes or peaks written when the search began */
};

/* Values that are no news, so many from low on. */
struct detector_band {
    int32_t low;
    uint32_t count;
};

struct detector {
    uint32_t phase; /* steps into the present period */
    struct detector_config config;
    /* the step before */
    int32_t x1, v1;
    /* what changes no extreme of the present frame, is no turn and no passage; all of it follows from the rest, and a
     * band that is empty is found anew */
    struct detector_band x_band, v_band, w_band, change_band;
    /* the present frame */
    struct detector_frame now;
    uint64_t change_sum; /* squared second differences of the strobes */
    int32_t v_sum;       /* of the present period, of at most 1024 steps */
    int64_t frame_v_sum;
    uint64_t v_square_sum;
    uint32_t periods;
    /* the window */
    struct detector_frame frames[DETECTOR_WINDOW_FRAMES];
    uint32_t frame;            /* frames since the window was restarted */
    uint32_t evidence;         /* for squeal, gathered frame by frame, forgotten slowly */
    int32_t level, hysteresis; /* of the crossings */
    bool is_below;
    uint64_t period_step; /* since reset, at the begin of the present period */
    /* strobes and maxima */
    int32_t strobe_x[DETECTOR_STROBES], strobe_v[DETECTOR_STROBES];
    int32_t peak_x[DETECTOR_PEAKS];
    uint32_t peak_time_q8[DETECTOR_PEAKS];
    uint32_t strobes, peaks; /* written so far */
    struct detector_search search;
    struct detector_verdict verdict;
    bool has_diverged;
};

/* Steps since reset. [ANY] */
static inline uint64_t detector_step(const struct detector *detector)
{
    return detector->period_step + detector->phase;
}

/* Something that the bands follow from was changed: to be called then. [ISR] */
void detector_empty_bands(struct detector *detector);

/* Forgets everything and starts with the present state. [ISR] */
void detector_reset(struct detector *detector, const struct detector_config *config, const struct plant_output *now);

/* Something changed: the verdict is unknown until the window is full again. [ISR] */
void detector_restart(struct detector *detector, const struct detector_config *config);

/* Books one step. Returns true when a frame's verdict is new. Cost: some 60 instructions, at most 8 comparisons more
 * while a search is under way, 16 with 16 steps a period. [ISR] */
bool detector_push(struct detector *detector, const struct plant_output *output);

/* A step that must not count, since nobody knows what it answers to: only where the plant stands is noted. After a
 * restart the verdict stays unknown over such steps, however many, and its window begins with the first that counts
 * again. Returns false. [ISR] */
bool detector_skip(struct detector *detector, const struct plant_output *output);

/* The plant left its domain: squeal, diverging, until reset. [ISR] */
void detector_set_diverged(struct detector *detector);

/* The words of the protocol. [MAIN] */
const char *detector_propensity_name(uint8_t propensity);
const char *detector_class_name(uint8_t motion);

#endif
