/* A row on the firmware's own code: two trials, one left to run its whole span and one that may be cut short. */
#ifndef MERIT_RUN_H
#define MERIT_RUN_H

#include "set.h"
#include "sim/trial.h"

/* A plain record, so that it passes through a pipe. */
struct run {
    bool is_refused;
    uint8_t propensity, motion, period; /* at the end */
    uint8_t predicted;                  /* enum predictor_verdict */
    uint8_t cut_propensity, cut_end;    /* of the trial that may be cut */
    bool has_flash;                     /* flagged at some time, long after the pad had touched or before it did */
    bool has_onset;                     /* the pad touched before the flag came up */
    float latency_periods, latency_ms;  /* from there to the flag; meaningful with has_onset */
    float speed_vref, speed_ratio;      /* half the range of v that the verdict reports: in Vref, and over |v0| */
    uint32_t saturations, caps;
    float periods, cut_periods; /* that each trial took */
};

struct run run_row(const struct set *set, int arith);

#endif
