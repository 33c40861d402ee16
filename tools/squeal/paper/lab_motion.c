/* Samples of a run, and what the pad's motion is by them and by the device's own detector. */
#include "squeal/paper/lab_parts.h"

#include "sim/detector.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { WINDOW_PERIODS = 32, NAME_SIZE = 32 };

/* What a listener fills. */
struct filling {
    struct lab_track *track;
    size_t capacity;
    double step_s;
    size_t place[LAB_SIGNALS_MAX]; /* of each signal that comes, in the order in which it comes */
    uint64_t missing;
};

static void take_sample(void *context, const struct device_sample *sample)
{
    struct filling *filling = context;
    struct lab_track *track = filling->track;
    const size_t at = track->count;

    filling->missing += sample->missing;
    if (at >= filling->capacity || sample->count != track->columns) {
        filling->missing++;
        return;
    }
    track->step[at] = sample->step;
    track->t_s[at] = (double)sample->step * filling->step_s;
    for (size_t i = 0; i < sample->count; i++) {
        track->value[filling->place[i]][at] = sample->value[i];
    }
    track->count++;
}

/* Begins the stream of these signals. */
static void record_begin(struct lab *lab, const char *signals, size_t capacity, unsigned every, struct filling *filling)
{
    struct lab_track *track = filling->track;
    int signal[LAB_SIGNALS_MAX];

    *track = (struct lab_track){.step = lab_memory(lab, capacity, sizeof *track->step),
                                .t_s = lab_memory(lab, capacity, sizeof *track->t_s)};
    for (const char *at = signals; *at != '\0' && track->columns < LAB_SIGNALS_MAX; at += *at == ',' ? 1 : 0) {
        const size_t length = strcspn(at, ",");
        char *name = lab_memory(lab, NAME_SIZE, 1);
        (void)snprintf(name, NAME_SIZE, "%.*s", (int)length, at);
        at += length;
        const int row = device_find(lab->device, DEVICE_SIGNALS, name);
        if (row < 0) {
            lab_fail(lab, "%s", device_problem(lab->device));
        }
        track->name[track->columns] = name;
        track->unit[track->columns] = device_row(lab->device, DEVICE_SIGNALS, (size_t)row)->unit;
        track->value[track->columns] = lab_memory(lab, capacity, sizeof(double));
        signal[track->columns++] = row;
    }
    /* They come in the order of the device's table. */
    for (size_t i = 0; i < track->columns; i++) {
        size_t before = 0;
        for (size_t j = 0; j < track->columns; j++) {
            before += signal[j] < signal[i] ? 1 : 0;
        }
        filling->place[before] = i;
    }
    filling->capacity = capacity;
    filling->step_s = lab->step_s;
    device_on_sample(lab->device, take_sample, filling);
    lab_need(lab, device_stream(lab->device, signal, track->columns, every, NULL));
}

static void record_end(struct lab *lab, const struct filling *filling)
{
    lab_need(lab, device_stream(lab->device, NULL, 0, 0, NULL));
    device_on_sample(lab->device, NULL, NULL);
    if (filling->missing > 0) {
        lab_fail(lab, "%llu samples were lost", (unsigned long long)filling->missing);
    }
}

struct lab_track lab_record(struct lab *lab, const char *signals, unsigned periods, unsigned every)
{
    const uint64_t steps = (uint64_t)periods * lab->steps_per_period;
    struct lab_track track;
    struct filling filling = {.track = &track};

    record_begin(lab, signals, (size_t)(steps / every + 2), every, &filling);
    lab_step(lab, steps);
    record_end(lab, &filling);
    return track;
}

bool lab_is_strobe(struct lab *lab, const struct lab_track *track, size_t sample)
{
    return track->step[sample] % lab->steps_per_period == 0;
}

struct lab_track lab_part(const struct lab_track *track, size_t from)
{
    struct lab_track part = *track;

    from = from < track->count ? from : track->count;
    part.count -= from;
    part.step += from;
    part.t_s += from;
    for (size_t i = 0; i < part.columns; i++) {
        part.value[i] += from;
    }
    return part;
}

/* --- What they say ------------------------------------------------------------------------------------------------ */

enum { COLUMN_X, COLUMN_V, COLUMN_MODE };

static void widen(double value, double *low, double *high)
{
    *low = value < *low ? value : *low;
    *high = value > *high ? value : *high;
}

/* Where x turns between two samples, by the cubic through both and their velocities: its velocity is the parabola
 * through theirs and the mean one. */
static double turning_point(double x0, double v0, double x1, double v1, double step)
{
    const double mean = (x1 - x0) / step;
    const double b = 6.0 * mean - 4.0 * v0 - 2.0 * v1, a = 3.0 * (v0 + v1) - 6.0 * mean; /* v = v0 + b s + a s^2 */
    const double root = sqrt(fmax(b * b - 4.0 * a * v0, 0.0));
    const double s = fmin(fmax(-2.0 * v0 / (b + (b < 0.0 ? -root : root)), 0.0), 1.0);

    return x0 + step * s * (v0 + s * (b / 2.0 + s * a / 3.0));
}

/* The top of the parabola through three samples of a smooth curve. */
static double vertex(double before, double at, double after)
{
    const double slope = after - before, curve = before - 2.0 * at + after;

    return curve != 0.0 ? at - slope * slope / (8.0 * curve) : at; /* on a straight line no sample turns */
}

static void find_extremes(const struct lab_track *track, struct lab_motion *motion)
{
    const double *x = track->value[COLUMN_X], *v = track->value[COLUMN_V], *mode = track->value[COLUMN_MODE];

    motion->xmax_m = motion->vmax_m_per_s = -(double)INFINITY;
    motion->xmin_m = motion->vmin_m_per_s = (double)INFINITY;
    for (size_t i = 0; i < track->count; i++) {
        widen(x[i], &motion->xmin_m, &motion->xmax_m);
        widen(v[i], &motion->vmin_m_per_s, &motion->vmax_m_per_s);
        if (i > 0 && v[i - 1] * v[i] < 0.0) {
            widen(turning_point(x[i - 1], v[i - 1], x[i], v[i], track->t_s[i] - track->t_s[i - 1]), &motion->xmin_m,
                  &motion->xmax_m);
        }
        const bool is_smooth = i > 1 && mode[i] != 0.0 && mode[i - 1] == mode[i] && mode[i - 2] == mode[i];
        if (is_smooth && (v[i - 1] - v[i - 2]) * (v[i] - v[i - 1]) < 0.0) {
            widen(vertex(v[i - 2], v[i - 1], v[i]), &motion->vmin_m_per_s, &motion->vmax_m_per_s);
        }
    }
    motion->xpp_m = motion->xmax_m - motion->xmin_m;
}

static void find_frequency(const struct lab_track *track, double period_s, struct lab_motion *motion)
{
    const double *x = track->value[COLUMN_X], level = 0.5 * (motion->xmax_m + motion->xmin_m);
    double first_s = 0.0, last_s = 0.0;
    size_t passages = 0;

    for (size_t i = 1; i < track->count; i++) {
        if (x[i - 1] < level && x[i] >= level) {
            const double share = (level - x[i - 1]) / (x[i] - x[i - 1]);
            last_s = track->t_s[i - 1] + share * (track->t_s[i] - track->t_s[i - 1]);
            first_s = passages == 0 ? last_s : first_s;
            passages++;
        }
    }
    motion->frequency_hz = passages > 1 ? (double)(passages - 1) / (last_s - first_s) : (double)NAN;
    motion->frequency_ratio = motion->frequency_hz * period_s;
}

static void take_class(struct lab_motion *motion, const struct device_verdict *verdict)
{
    motion->period = verdict->period;
    (void)snprintf(motion->class, sizeof motion->class, verdict->period > 0 ? "%s-p%u" : "%s",
                   detector_class_name(verdict->motion), (unsigned)verdict->period);
}

struct lab_motion lab_measure(struct lab *lab, unsigned periods, struct lab_track *out)
{
    const double none = (double)NAN;
    struct lab_motion motion = {.xmax_m = none,
                                .xmin_m = none,
                                .xpp_m = none,
                                .vmax_m_per_s = none,
                                .vmin_m_per_s = none,
                                .frequency_hz = none,
                                .frequency_ratio = none};
    struct lab_track track;
    struct filling filling = {.track = &track};
    struct device_verdict verdict = {.stick = NAN, .slip_minus = NAN};
    unsigned windows = 0;

    record_begin(lab, "x,xd,mode", (size_t)periods * lab->steps_per_period + 1, 1, &filling);
    for (unsigned done = 0; done < periods && !lab->has_left;) {
        const unsigned part = periods - done < WINDOW_PERIODS ? periods - done : WINDOW_PERIODS;
        (void)lab_settle(lab, part);
        done += part;
        lab_need(lab, device_verdict(lab->device, &verdict));
        if (part == WINDOW_PERIODS) {
            motion.stick += (double)verdict.stick;
            motion.slip_minus += (double)verdict.slip_minus;
            windows++;
        }
    }
    lab_need(lab, device_verdict(lab->device, &verdict));
    record_end(lab, &filling);
    motion.t_v10_s = (double)verdict.t_v10_s;
    motion.is_diverging = lab->has_left || verdict.motion == CLASS_DIVERGING;
    take_class(&motion, &verdict);
    motion.stick = motion.is_diverging ? none : motion.stick / windows;
    motion.slip_minus = motion.is_diverging ? none : motion.slip_minus / windows;
    if (!motion.is_diverging) {
        find_extremes(&track, &motion);
        find_frequency(&track, lab_period_s(lab), &motion);
    }
    if (out != NULL) {
        *out = track;
    }
    return motion;
}
