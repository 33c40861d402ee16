/* Keeps what the device streams: every sample goes to state.csv as it comes, and what pictures and sound need stays in
 * memory, act by act. */
#ifndef SQUEAL_RECORD_H
#define SQUEAL_RECORD_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#include "sim/detector.h"
#include "squeal/console/session.h"
#include "squeal/support/csv.h"

/* The signals that the tool asks for, in this order. */
#define RECORD_SIGNALS "step,t,x,xd,y,yd,N,F,vr,mode,propensity"

/* The header that the device then sends, and that state.csv gets behind its act. A column in another unit is another
 * column. */
#define RECORD_HEADER "step,t[s],x[m],xd[m/s],y[m],yd[m/s],N[N],F[N],vr[m/s],mode,propensity"

enum { RECORD_ACTS = 5 };

struct act_sample {
    double step, t_s, x_m, xd_m_per_s;
    double disc_m_per_s; /* v0 = vr + xd */
    enum detector_propensity propensity;
};

/* One act: its samples, and what the device said at its end. */
struct act {
    int number;
    bool is_done; /* told to the end, every command answered ok */
    bool has_verdict;
    double every;   /* steps from one sample to the next */
    double missing; /* samples that the step column shows to be missing */
    struct act_sample *samples;
    size_t count, capacity;
    size_t start;                   /* first sample of the last run: a reset within the act starts a new one */
    char title[SESSION_LINE_MAX];   /* the first line of the narration, "act <number>: ..." */
    char verdict[SESSION_LINE_MAX]; /* fields */
    char status[SESSION_LINE_MAX];
    char first_hash[16]; /* of the state before the act and after it */
    char *parameters;    /* body lines of list, joined by LF */
};

struct record {
    FILE *file;
    char path[512];
    struct act *act;               /* that the samples belong to; NULL while none is expected */
    char problem[CSV_PROBLEM_MAX]; /* the first thing that went wrong with a sample; empty if nothing */
};

/* Opens state.csv at the path; false with the problem set if it cannot. */
bool record_open(struct record *record, const char *path);

/* Takes the header of a stream: it must name the signals that were asked for, in SI units. */
void record_header(struct record *record, const char *text);

/* Takes one line of a stream. */
void record_sample(struct record *record, const char *text);

/* Reads a propensity by its name or number; false if it is none. */
bool record_propensity(const char *text, enum detector_propensity *propensity);

/* Closes the file; false with the problem set if anything was not written or a sample was not understood. */
bool record_close(struct record *record);

#endif
