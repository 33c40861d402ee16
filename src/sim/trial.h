/* A trial: a set run from its own start in a plant of its own, a slice at a time, until one knows what becomes of it.
 * It is what main does for a map or a border; the plant in the interrupt knows nothing of it.
 *
 *   begin -> transient (cut short once the end is certain) -> window, measured whole -> done
 *
 * The transient is cut short in three cases only. The plant left its domain: there is no window then. It squeals in a
 * motion that repeats, found twice in a row after the profiles have come to rest. Or what is free in its motion decays,
 * in two frames in a row, and the closed form says that it must and that the motion left stays off the disc. A sine of
 * the load is never at rest.
 *
 * Who asks for a border or a share only wants to know on which side a set lies: with is_brief a trial is over,
 * without a window, as soon as the growth of the free motion is known beyond its error. */
#ifndef SIM_TRIAL_H
#define SIM_TRIAL_H

#include <stdbool.h>
#include <stdint.h>

#include "sim/sim.h"

enum {
    TRIAL_PERIODS_MAX = 1000000, /* of transient or window */
    TRIAL_WINDOW_MIN = 8,
    TRIAL_TRANSIENT_DEFAULT = 360,
    TRIAL_TRANSIENT_BRIEF = 1600, /* of a brief trial that cannot decide */
    TRIAL_WINDOW_DEFAULT = 40,
    TRIAL_PAUSE_PERIODS = 32 /* without a change of regime: what comes then is a new onset */
};

/* How long to look, in normal periods; the transient counts from when the profiles have come to rest. */
struct trial_span {
    uint32_t transient, window;
    bool is_whole; /* never cut the transient short */
    bool is_brief; /* over as soon as growth or decay is certain */
};

/* Why the window was opened, or not. */
enum trial_end { TRIAL_RUNS, TRIAL_WAS_WHOLE, TRIAL_SQUEALED, TRIAL_DECAYED, TRIAL_DIVERGED, TRIAL_GREW };

/* Growth of the free part of the motion while the pad slips on: a straight line through the logarithms of its
 * amplitude, one a frame. */
struct trial_line {
    uint32_t count;
    int32_t first_log2_q16;
    int64_t last;                       /* logarithms here are in Q12, less the first */
    int64_t sum, sum_square, sum_place; /* of the logarithms; of place times logarithm */
    int64_t change_square;              /* of their changes from frame to frame */
};

struct trial {
    struct trial_span span;
    struct sim_plan plan;
    struct sim sim;
    uint8_t end;       /* enum trial_end */
    uint8_t promised;  /* the end that the last frame promised */
    uint32_t sure;     /* frames in a row that promised it */
    uint32_t settled;  /* frames since the profiles came to rest */
    uint64_t until;    /* step at which the present part ends */
    bool is_measuring; /* the window is open */
    bool is_over;
    struct trial_line line;

    /* onset: the first change of regime after a pause, and the first verdict of squeal */
    bool has_event, has_flag;
    uint64_t event_step; /* last change of regime */
    uint64_t flag_step;
    bool has_onset;      /* the pad stuck or crossed before it was flagged, without a pause since */
    uint64_t onset_step; /* when it began to, if so */
};

/* Starts a trial of a set. On a problem there is none. [MAIN] */
struct params_problem trial_begin(struct trial *trial, const struct params *params, const struct trial_span *span);

/* Makes at most so many steps; true when the trial is over. [MAIN] */
bool trial_go_on(struct trial *trial, uint32_t steps);

/* Normal periods since its start. [MAIN] */
float trial_periods(const struct trial *trial);

/* Growth of the free motion in e-folds per normal period over the whole trial, and the error that noise leaves in it
 * (three standard deviations); false if too few frames showed any. [MAIN] */
bool trial_growth(const struct trial *trial, float *growth, float *error);

/* Does the set squeal, or will it: by the verdict, or by a growth beyond its error? Of a trial that is over. [MAIN] */
bool trial_is_loud(const struct trial *trial);

/* Was the growth within its error to the end, without squeal? Then is_loud is false for want of proof. [MAIN] */
bool trial_is_undecided(const struct trial *trial);

/* The word of the protocol for enum trial_end. [MAIN] */
const char *trial_end_name(uint8_t end);

#endif
