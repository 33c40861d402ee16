/* Asked of the device and of nothing else. */
#include "squeal/paper/lab_live.h"

#include "sim/detector.h"
#include "squeal/paper/lab_parts.h"
#include "squeal/paper/record.h"

#include <math.h>
#include <stdarg.h>

enum { TEXT_SIZE = 512 };

static void set_text(struct lab *lab, const char *format, va_list values)
{
    char text[TEXT_SIZE];

    if (vsnprintf(text, sizeof text, format, values) >= (int)sizeof text) {
        lab_fail(lab, "a set of more than %d characters", TEXT_SIZE);
    }
    lab_set(lab, text);
}

void lab_setf(struct lab *lab, const char *format, ...)
{
    va_list values;

    va_start(values, format);
    set_text(lab, format, values);
    va_end(values);
}

void lab_table1(struct lab *lab, const char *format, ...)
{
    va_list values;

    lab_preset(lab, "table1");
    va_start(values, format);
    set_text(lab, format, values);
    va_end(values);
}

static int param_index(struct lab *lab, const char *symbol)
{
    const int param = device_find(lab->device, DEVICE_PARAMS, symbol);

    if (param < 0) {
        lab_fail(lab, "%s", device_problem(lab->device));
    }
    return param;
}

void lab_put(struct lab *lab, const char *symbol, double value)
{
    const struct device_value change = {param_index(lab, symbol), (float)value};

    lab_need(lab, device_set(lab->device, &change, 1, NULL, false, NULL));
}

struct device_point lab_trial(struct lab *lab, unsigned transient, unsigned window)
{
    const struct device_span span = {transient, window, true};
    const double load_n = lab_get(lab, "N0");
    char axis[TEXT_SIZE];

    (void)snprintf(axis, sizeof axis, "N0 %.9g %.9g 1", load_n, load_n);
    return *lab_scan(lab, axis, &span, NULL);
}

double lab_point_xpp_m(const struct device_point *point)
{
    return point->error == 0 && point->motion != CLASS_DIVERGING ? 2e-6 * (double)point->amplitude_um : (double)NAN;
}

bool lab_point_has_events(const struct device_point *point)
{
    switch ((enum detector_class)point->motion) {
    case CLASS_STICKSLIP:
    case CLASS_CROSS:
    case CLASS_LIMITCYCLE_STICKSLIP:
    case CLASS_APERIODIC:
    case CLASS_DIVERGING:
        return true;
    case CLASS_UNSETTLED:
    case CLASS_REST:
    case CLASS_DECAYING:
    case CLASS_GROWING:
    case CLASS_FORCED:
    case CLASS_LIMITCYCLE_SLIP:
    default:
        return false;
    }
}

double lab_xpp_m(struct lab *lab, unsigned periods)
{
    const struct device_point point = lab_trial(lab, periods, 40);

    return lab_point_xpp_m(&point);
}

double lab_events(struct lab *lab)
{
    struct device_status status;

    lab_need(lab, device_status(lab->device, &status));
    return (double)status.events;
}

/* --- Borders ------------------------------------------------------------------------------------------------------ */

struct answer {
    struct device_border border;
    bool has_border, has_ended;
};

static void take_border(void *context, const struct device_border *border)
{
    struct answer *answer = context;

    answer->border = *border;
    answer->has_border = true;
}

static void take_end(void *context, const struct device_tally *tally)
{
    struct answer *answer = context;

    answer->has_ended = tally->reason == 0;
}

struct device_border lab_border(struct lab *lab, const char *symbol)
{
    const struct device_span span = {1600, 40, false};
    struct answer answer = {.has_border = false};
    const struct device_study study = {.context = &answer, .on_border = take_border, .on_end = take_end};
    uint32_t results;

    lab_need(lab, device_margin(lab->device, param_index(lab, symbol), 16.0f, &span, &study, &results));
    if (!answer.has_ended) {
        lab_need(lab, device_await_study(lab->device, NULL));
    }
    if (!answer.has_border || !answer.has_ended) {
        lab_fail(lab, "the search for the border of %s ended early", symbol);
    }
    return answer.border;
}

double lab_bisect(struct lab *lab, double no, double yes, int times, bool (*is_yes)(struct lab *lab, double value))
{
    for (int i = 0; i < times; i++) {
        const double middle = 0.5 * (no + yes);
        *(is_yes(lab, middle) ? &yes : &no) = middle;
    }
    return 0.5 * (no + yes);
}

/* --- Pictures ----------------------------------------------------------------------------------------------------- */

void lab_path(struct lab *lab, char path[PAPER_PATH_MAX], const char *name)
{
    (void)snprintf(path, PAPER_PATH_MAX, "%s/%s", lab->options->out, name);
}

void lab_picture(struct lab *lab, const char *name, const char *caption)
{
    record_write(lab->record, RECORD_FIGURE, name, caption, NULL);
}
