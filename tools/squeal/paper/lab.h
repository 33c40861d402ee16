/* What an experiment works with: a device of its own, and a record of what it found.
 *
 *     lab_preset(lab, "fig5-n5");
 *     lab_settle(lab, 6000);
 *     struct lab_track track;
 *     const struct lab_motion motion = lab_measure(lab, 400, &track);
 *     lab_compare(lab, "N = 5 N", "peak to peak", motion.xpp_m, "m", 2.07612, 0.004);
 *
 * Nothing here returns a failure: one ends the experiment, and its record says why. Only that the plant leaves its
 * domain is no failure; it is told where it matters. All periods are those of the normal direction, Tn. */
#ifndef SQUEAL_LAB_H
#define SQUEAL_LAB_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "squeal/device/device.h"
#include "squeal/paper/paper.h"

enum { LAB_SIGNALS_MAX = 8, LAB_CLASS_MAX = 40 };

struct lab;

/* Runs an experiment in this process, from opening its device to closing it. Ends the process. */
void lab_run(const struct experiment *experiment, const struct paper_options *options, FILE *record);

const struct paper_options *lab_options(const struct lab *lab);

/* Ends the experiment with a problem. */
void lab_fail(struct lab *lab, const char *format, ...) __attribute__((format(printf, 2, 3), noreturn));

/* Memory that need not be given back, and is zero. */
void *lab_memory(struct lab *lab, size_t count, size_t size);

/* The experiments. */
#define EXPERIMENT(id, title, function) void experiment_##function(struct lab *lab);
#include "squeal/paper/experiments.def"
#undef EXPERIMENT

/* --- The set ------------------------------------------------------------------------------------------------------ */

/* A named set, or the paper's Table 1 for "table1", with the number format, method and steps of the options; step 0. */
void lab_preset(struct lab *lab, const char *name);

/* Changes the set as "set" on the console does: "N0 5 alpha -0.02"; back to step 0. */
void lab_set(struct lab *lab, const char *assignments);

/* A parameter in force. */
double lab_get(struct lab *lab, const char *symbol);

/* Length of a normal period and of a step in seconds; steps to a period. */
double lab_period_s(struct lab *lab);
double lab_step_s(struct lab *lab);
unsigned lab_steps_per_period(struct lab *lab);

/* --- Running ------------------------------------------------------------------------------------------------------ */

/* Back to the initial state. */
void lab_reset(struct lab *lab);

/* Lets periods pass. False: the plant has left its domain, now or before. */
bool lab_settle(struct lab *lab, unsigned periods);

/* Samples, column by column in the order in which the signals were asked for, up to where the plant left its domain. */
struct lab_track {
    size_t count, columns;
    uint64_t *step; /* since the reset */
    double *t_s;
    double *value[LAB_SIGNALS_MAX];
    const char *name[LAB_SIGNALS_MAX], *unit[LAB_SIGNALS_MAX];
};

/* Samples of "x,xd,mode" over so many periods, each every-th step. A sample that is lost is a failure. */
struct lab_track lab_record(struct lab *lab, const char *signals, unsigned periods, unsigned every);

/* Is it the sample at the end of a whole normal period? */
bool lab_is_strobe(struct lab *lab, const struct lab_track *track, size_t sample);

/* The part of a track from a sample on; the columns are shared. */
struct lab_track lab_part(const struct lab_track *track, size_t from);

/* What the pad does over a stretch of time. NaN where the plant has left its domain. */
struct lab_motion {
    bool is_diverging;
    double t_v10_s; /* first time that it was faster than 10 |v0|; NaN: never */
    double xmax_m, xmin_m, xpp_m, vmax_m_per_s, vmin_m_per_s;
    double stick, slip_minus;             /* shares of the time, as the device's detector finds them */
    double frequency_hz, frequency_ratio; /* upward passages of the middle; the same by that of the normal direction */
    char class[LAB_CLASS_MAX]; /* the device's word with its multiplicity: stickslip-p1, aperiodic, diverging */
    unsigned period;           /* the multiplicity; 0 where it has none */
};

/* Measures over so many periods, 32 or more and a multiple of 8, from samples of every step and the device's verdicts.
 * track, if not NULL, takes the samples: x, xd, mode. */
struct lab_motion lab_measure(struct lab *lab, unsigned periods, struct lab_track *track);

/* Trials on the device along "N0 1 10 19" or such, two axes at most, as scan on the console has them: the points in
 * order, the first axis fastest. count may be NULL. */
const struct device_point *lab_scan(struct lab *lab, const char *axes, const struct device_span *span, size_t *count);

/* --- What was found ----------------------------------------------------------------------------------------------- */

/* The reference solution's cell for a case of the golden table; NaN where it has no number. */
double lab_reference(struct lab *lab, const char *name, const char *column);
const char *lab_reference_text(struct lab *lab, const char *name, const char *column);

/* Data behind a picture, NAME.csv; ends with lab_csv_close. The header line is without its line end. */
FILE *lab_csv_open(struct lab *lab, const char *name, const char *header);
void lab_csv_close(struct lab *lab, FILE *file, const char *name);
void lab_csv_tracks(struct lab *lab, const char *name, const struct lab_track *tracks, size_t count);

/* A picture, NAME.svg and NAME.png: write data blocks and variables for gnuplot into what is opened, then end it with
 * the commands that draw them. Text that goes into variables: figure_plain(). */
FILE *lab_figure_open(struct lab *lab);
void lab_figure_block(FILE *script, const char *block, const struct lab_track *track, size_t across, size_t up);
void lab_figure_close(struct lab *lab, FILE *script, const char *name, const char *caption, const char *commands);

/* A paragraph. */
void lab_note(struct lab *lab, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* What was measured of a subject, beside the picture before it: alone, or against a reference with an absolute
 * tolerance, both NaN being equal; words must be the same. */
void lab_number(struct lab *lab, const char *subject, const char *quantity, double value, const char *unit);
void lab_compare(struct lab *lab, const char *subject, const char *quantity, double value, const char *unit,
                 double reference, double tolerance);
void lab_compare_words(struct lab *lab, const char *subject, const char *quantity, const char *words,
                       const char *reference);

/* Judges a claim of claims.def: what was measured in words, and the picture that shows it. */
void lab_claim(struct lab *lab, const char *id, enum paper_verdict verdict, const char *figure, const char *measured,
               ...) __attribute__((format(printf, 5, 6)));

#endif
