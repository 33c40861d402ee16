/* Studies: a map, borders, a share of squeal. Each asks for one set after the other and has it tried in a plant of its
 * own, a slice at a time; who asked is told of each result as it comes:
 *
 *   study_begin_...  ->  study_go_on ... STUDY_HAS_RESULT ... STUDY_HAS_RESULT ... STUDY_IS_DONE
 *
 *   next set -> trial -> result -> next set ...
 *
 * It knows nothing of wires; who will hear no more simply does not go on. */
#ifndef SIM_STUDY_H
#define SIM_STUDY_H

#include <stdbool.h>
#include <stdint.h>

#include "sim/margin.h"
#include "sim/occurrence.h"
#include "sim/scan.h"
#include "sim/trial.h"

/* Steps of a trial that study_go_on() makes. The program goes on twice between two looks at its lines: 256. */
enum { STUDY_SLICE_STEPS = 128 };

enum study_kind { STUDY_SCAN, STUDY_MARGIN, STUDY_OCCURRENCE };

enum study_news {
    STUDY_TRIES,
    STUDY_HAS_RESULT, /* of a point, of a parameter's borders, of a draw: number done, counted from 1 */
    STUDY_IS_DONE,    /* all results were told */
    STUDY_IS_REFUSED  /* the set itself cannot be tried, so nothing of it is known: see problem */
};

/* What the trials of a study came to. */
struct study_tally {
    uint32_t trials; /* begun, and those refused */
    uint32_t by_propensity[4];
    uint32_t loud;      /* squeals, or surely will: trial_is_loud() */
    uint32_t undecided; /* neither, for want of proof: trial_is_undecided() */
    uint32_t refused;   /* sets that the model cannot hold */
    uint32_t diverged;
    uint32_t caps, saturations, gap_held; /* of all trials, as in status */
    uint64_t steps;
};

struct study_margin {
    struct params base;
    const struct params_info *only; /* NULL: one after the other */
    float factor;
    bool has_base, is_loud; /* the base was tried, and what it said */
    struct margin margin;   /* of the parameter under way */
    bool is_searching;      /* it waits for the trial of wanted */
};

struct study_occurrence {
    struct occurrence occurrence;
    struct occurrence_draw draw; /* under way */
    uint32_t clamped;
};

struct study {
    uint8_t kind;      /* enum study_kind */
    uint32_t done, of; /* results */
    struct study_tally tally;

    struct trial_span span;
    bool is_trying;
    struct trial trial;            /* under way, or the last one */
    struct params_problem problem; /* why that could not be begun */
    struct params wanted;          /* its set, of a scan or a margin */

    /* that of its kind */
    union {
        struct scan scan;
        struct study_margin margin;
        struct study_occurrence occurrence;
    } its;
};

/* Each begins one, whatever was under way. What they ask for must be in the ranges of scan.h, margin.h, occurrence.h
 * and trial.h; margin's only is NULL for all that margin_covers(). [MAIN] */
void study_begin_scan(struct study *study, const struct scan *scan, const struct trial_span *span);
void study_begin_margin(struct study *study, const struct params *base, const struct params_info *only, float factor,
                        const struct trial_span *span);
void study_begin_occurrence(struct study *study, const struct occurrence *occurrence, uint32_t trials,
                            const struct trial_span *span);

/* A slice. [MAIN] */
enum study_news study_go_on(struct study *study);

/* The share of loud trials among those that were tried, with Wilson's interval at 95 %. Of none it is not a number,
 * from 0 to 1. [MAIN] */
struct study_share {
    float share, low, high;
};

struct study_share study_share(const struct study *study);

#endif
