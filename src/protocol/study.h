/* Studies: a map, borders, a share of squeal. Each asks for one set after the other and has it tried in a plant of its own,
 * in slices between two polls of the console; the plant in the interrupt goes on undisturbed.
 *
 *   study: next set -> trial -> a body line -> next set ... -> answer */
#ifndef PROTOCOL_STUDY_H
#define PROTOCOL_STUDY_H

#include <stdbool.h>
#include <stdint.h>

#include "base/text.h"
#include "sim/margin.h"
#include "sim/occurrence.h"
#include "sim/scan.h"
#include "sim/trial.h"

struct console;

/* Steps of a trial a poll. The program polls the console twice between two looks at the line: 256. */
enum { STUDY_SLICE_STEPS = 128 };

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

struct study_scan {
    struct scan scan;
    uint32_t point; /* to be tried, or under way */
};

struct study_margin {
    struct params base;
    const struct params_info *only; /* NULL: one after the other */
    float factor;
    bool has_base, is_loud; /* the base was tried, and what it said */
    struct margin margin;   /* of the parameter under way */
    bool is_searching;      /* it waits for the trial of wanted */
    uint32_t done, of;      /* parameters */
};

struct study_occurrence {
    struct occurrence occurrence;
    struct occurrence_draw draw; /* under way */
    uint32_t done, of;           /* trials */
    uint32_t clamped;
};

struct study {
    struct trial trial;
    struct trial_span span;
    bool is_trying;
    struct params wanted; /* of the trial to begin or under way, of scan and margin */
    struct study_tally tally;
    struct study_scan scan;
    struct study_margin margin;
    struct study_occurrence occurrence;
};

/* The commands. [MAIN] */
void study_scan_obey(struct console *console);
void study_margin_obey(struct console *console);
void study_occurrence_obey(struct console *console);

/* Each goes on with its own; true if something was done. [MAIN] */
bool study_scan_continue(struct console *console);
bool study_margin_continue(struct console *console);
bool study_occurrence_continue(struct console *console);

/* Is one under way? [MAIN] */
bool study_is_under_way(const struct console *console);

/* Ends the study under way with what it has, because a stop waits. [MAIN] */
void study_cut_short(struct console *console);

#endif
