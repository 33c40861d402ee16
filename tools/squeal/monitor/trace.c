/* Two rings: samples by their count, periods by their number. */
#include "squeal/monitor/trace.h"

#include <math.h>
#include <string.h>

void trace_clear(struct trace *trace, double step_s, uint32_t steps_per_period, uint32_t every)
{
    memset(trace, 0, sizeof *trace);
    trace->step_s = step_s;
    trace->steps_per_period = steps_per_period > 0u ? steps_per_period : 1u;
    trace->every = every;
}

void trace_break(struct trace *trace, uint32_t every)
{
    trace->every = every;
    trace->is_broken = true;
}

const struct trace_point *trace_point(const struct trace *trace, uint64_t age)
{
    if (age >= trace->points || age >= TRACE_POINTS) {
        return NULL;
    }
    return &trace->point[(trace->points - 1u - age) % TRACE_POINTS];
}

const struct trace_period *trace_period(const struct trace *trace, uint64_t number)
{
    const struct trace_period *period = &trace->period[number % TRACE_PERIODS];

    return period->is_filled && period->number == number ? period : NULL;
}

static void add_to_period(struct trace *trace, uint64_t step, float x_m, uint8_t propensity)
{
    const uint64_t number = step / trace->steps_per_period;
    struct trace_period *period = &trace->period[number % TRACE_PERIODS];

    if (!period->is_filled || period->number != number) {
        *period = (struct trace_period){number, x_m, x_m, propensity, true};
    }
    period->low_m = fminf(period->low_m, x_m);
    period->high_m = fmaxf(period->high_m, x_m);
    period->propensity = propensity;
}

void trace_add(struct trace *trace, uint64_t step, double x_m, double xd_m_per_s, uint8_t propensity, uint32_t missing)
{
    const struct trace_point *last = trace_point(trace, 0u);
    bool is_next = last != NULL && missing == 0u && !trace->is_broken;

    if (last != NULL && step <= last->step) {
        trace_clear(trace, trace->step_s, trace->steps_per_period, trace->every);
        is_next = false;
    }
    trace->is_broken = false;
    trace->lost += missing;
    trace->point[trace->points % TRACE_POINTS] = (struct trace_point){step, x_m, xd_m_per_s, is_next};
    trace->points++;
    if (isfinite(x_m)) {
        add_to_period(trace, step, (float)x_m, propensity);
    }
}

size_t trace_latest(const struct trace *trace, size_t limit, double *values)
{
    size_t count = 0u;

    while (count < limit && trace_point(trace, count) != NULL) {
        count++;
        if (!trace_point(trace, count - 1u)->is_next) {
            break; /* what comes before it is not its neighbour */
        }
    }
    for (size_t i = 0u; values != NULL && i < count; i++) {
        values[i] = trace_point(trace, count - 1u - i)->xd_m_per_s;
    }
    return count;
}

/* Samples that are not older than so many periods. */
static uint64_t count_within(const struct trace *trace, unsigned periods)
{
    const struct trace_point *latest = trace_point(trace, 0u);
    const uint64_t span = (uint64_t)periods * trace->steps_per_period;
    uint64_t count = 0u;

    for (const struct trace_point *point = latest; point != NULL && latest->step - point->step <= span;
         point = trace_point(trace, count)) {
        count++;
    }
    return count;
}

/* About its mean. */
static double rms_velocity(const struct trace *trace, uint64_t count)
{
    double sum = 0.0;
    double squares = 0.0;
    double variance;

    for (uint64_t age = 0u; age < count; age++) {
        const double xd = trace_point(trace, age)->xd_m_per_s;

        sum += xd / (double)count;
        squares += xd * xd / (double)count;
    }
    variance = squares - sum * sum;
    return sqrt(variance > 0.0 ? variance : 0.0);
}

/* Of the energy, which does not swing with the motion as its halves do: the newer half of the samples over the
 * older. */
static double growth(const struct trace *trace, uint64_t count, double middle_m, double frequency_hz)
{
    const double omega = 2.0 * 3.14159265358979323846 * frequency_hz;
    const double span_s = (double)(trace_point(trace, 0u)->step - trace_point(trace, count - 1u)->step) * trace->step_s;
    double energy[2] = {0.0, 0.0};

    for (uint64_t age = 0u; age < count / 2u * 2u; age++) {
        const struct trace_point *point = trace_point(trace, age);
        const double x_m = point->x_m - middle_m;
        const double xd = point->xd_m_per_s / omega;

        energy[age < count / 2u ? 0 : 1] += x_m * x_m + xd * xd;
    }
    return 0.5 * log(energy[0] / energy[1]) / (0.5 * span_s);
}

static double frequency(const struct trace *trace, uint64_t count, double middle_m)
{
    double first_step = 0.0;
    double last_step = 0.0;
    unsigned passages = 0u;

    for (uint64_t age = count - 1u; age > 0u; age--) {
        const struct trace_point *from = trace_point(trace, age);
        const struct trace_point *to = trace_point(trace, age - 1u);

        if (from->x_m < middle_m && to->x_m >= middle_m) {
            const double share = (middle_m - from->x_m) / (to->x_m - from->x_m);

            last_step = (double)from->step + share * (double)(to->step - from->step);
            first_step = passages == 0u ? last_step : first_step;
            passages++;
        }
    }
    return passages < 2u ? (double)NAN : (passages - 1u) / ((last_step - first_step) * trace->step_s);
}

struct trace_measure trace_measure(const struct trace *trace, unsigned periods)
{
    const uint64_t count = count_within(trace, periods);
    const double none = (double)NAN;
    struct trace_measure measure = {none, none, none, none, none, none, none, none};
    double middle_m;

    if (count < 4u) {
        return measure;
    }
    measure.x_low_m = measure.xd_low_m_per_s = INFINITY;
    measure.x_high_m = measure.xd_high_m_per_s = -(double)INFINITY;
    for (uint64_t age = 0u; age < count; age++) {
        const struct trace_point *point = trace_point(trace, age);

        measure.x_low_m = fmin(measure.x_low_m, point->x_m);
        measure.x_high_m = fmax(measure.x_high_m, point->x_m);
        measure.xd_low_m_per_s = fmin(measure.xd_low_m_per_s, point->xd_m_per_s);
        measure.xd_high_m_per_s = fmax(measure.xd_high_m_per_s, point->xd_m_per_s);
    }
    middle_m = 0.5 * (measure.x_high_m + measure.x_low_m);
    measure.amplitude_m = 0.5 * (measure.x_high_m - measure.x_low_m);
    measure.velocity_m_per_s = rms_velocity(trace, count);
    measure.frequency_hz = frequency(trace, count, middle_m);
    measure.growth_per_s = growth(trace, count, middle_m, measure.frequency_hz);
    if (!isfinite(measure.growth_per_s)) {
        measure.growth_per_s = none;
    }
    return measure;
}
