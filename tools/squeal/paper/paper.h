/* The paper, done again on a device: experiments that run it, draw figures, compare numbers and judge claims. Data flow
 * one way: an experiment writes into its record and into files; the page is made of the records. */
#ifndef SQUEAL_PAPER_H
#define SQUEAL_PAPER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#include "squeal/support/csv.h"

enum { PAPER_JOBS_MAX = 16, PAPER_PATH_MAX = 1024 };

struct lab;

struct paper_options {
    const char *port, *out;                    /* a port's name; the folder that takes all files */
    const char *arith, *normal, *method, *spp; /* as the device's parameters are set */
    const char *line;                          /* the command line, for the page */
    const struct csv *reference;               /* the golden table */
    bool is_small;                             /* a look at everything in a few seconds */
    bool is_part;                              /* not all experiments are wanted, so that claims stay unjudged */
    double limit_s;                            /* for one answer of the device */
    unsigned jobs;                             /* experiments at a time */
};

struct experiment {
    const char *id, *title;
    void (*run)(struct lab *lab);
    bool is_wanted;
};

struct claim {
    const char *id, *claim, *paper;
};

enum paper_verdict { PAPER_HOLDS, PAPER_IN_PART, PAPER_REFUTED, PAPER_NOT_JUDGED };

extern struct experiment paper_experiments[];
extern const size_t paper_experiment_count;
extern const struct claim paper_claims[];
extern const size_t paper_claim_count;

/* The place of a claim; paper_claim_count if there is none of that name. */
size_t paper_claim_find(const char *id);

/* holds, in part, refuted, not judged. */
const char *paper_verdict_name(enum paper_verdict verdict);

/* Runs the wanted experiments, so many at a time; the record of each goes into the file of its place, which stays NULL
 * where none is wanted. Whatever happens in an experiment is in its record. False, told on standard error: no files, no
 * processes. */
bool paper_run(const struct paper_options *options, FILE *records[]);

#endif
