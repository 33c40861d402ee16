/* What the samples of a plant tell: the latest ones, the extremes of each normal period before them, and what can be
 * measured on them. */
#ifndef SQUEAL_TRACE_H
#define SQUEAL_TRACE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { TRACE_POINTS = 8192, TRACE_PERIODS = 32768 }; /* powers of two */

struct trace_point {
    uint64_t step;
    double x_m, xd_m_per_s;
    bool is_next; /* no sample is missing between the one before and this one */
};

/* Extremes over one normal period. */
struct trace_period {
    uint64_t number; /* steps since reset / steps a period */
    float low_m, high_m;
    uint8_t propensity; /* at its end */
    bool is_filled;
};

struct trace {
    double step_s;
    uint32_t steps_per_period;
    uint32_t every;  /* steps between two samples */
    bool is_broken;  /* the next sample is not the neighbour of the last one */
    uint64_t points; /* since trace_clear() */
    uint64_t lost;   /* samples, since trace_clear() */
    struct trace_point point[TRACE_POINTS];
    struct trace_period period[TRACE_PERIODS];
};

/* Nothing seen; what the steps mean from here on. */
void trace_clear(struct trace *trace, double step_s, uint32_t steps_per_period, uint32_t every);

/* The samples from here on are so many steps apart. */
void trace_break(struct trace *trace, uint32_t every);

/* A sample. missing: how many were lost just before. One with an earlier step than the last begins anew. */
void trace_add(struct trace *trace, uint64_t step, double x_m, double xd_m_per_s, uint8_t propensity, uint32_t missing);

/* The sample of that age, 0 the latest; NULL if it is gone or never was. */
const struct trace_point *trace_point(const struct trace *trace, uint64_t age);

/* The period of that number; NULL where there was no sample. */
const struct trace_period *trace_period(const struct trace *trace, uint64_t number);

/* Samples without a gap, the latest the last, at most limit of them: how many. values: velocities, if wanted. */
size_t trace_latest(const struct trace *trace, size_t limit, double *values);

/* Over the last so many normal periods; nan where there is nothing to measure. */
struct trace_measure {
    double amplitude_m;      /* half the range of x */
    double velocity_m_per_s; /* rms about its mean */
    double frequency_hz;     /* of the upward passages of the middle of x */
    double growth_per_s;     /* of the motion about its middle, second half over first */
    double x_low_m, x_high_m;
    double xd_low_m_per_s, xd_high_m_per_s;
};

struct trace_measure trace_measure(const struct trace *trace, unsigned periods);

#endif
