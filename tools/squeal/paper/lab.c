/* An experiment's device: opened and closed with it, its set, and stepping. */
#include "squeal/paper/lab_parts.h"

#include "squeal/paper/record.h"
#include "squeal/support/children.h"

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { PROBLEM_SIZE = 1024, VALUES_MAX = 32, WORD_SIZE = 64, NAME_SIZE = 512 };

void lab_fail(struct lab *lab, const char *format, ...)
{
    char problem[PROBLEM_SIZE];
    va_list values;

    va_start(values, format);
    (void)vsnprintf(problem, sizeof problem, format, values);
    va_end(values);
    record_write(lab->record, RECORD_FAILURE, problem, NULL);
    device_close(lab->device);
    _exit(1);
}

void lab_need(struct lab *lab, enum device_result result)
{
    if (result != DEVICE_OK) {
        lab_fail(lab, "%s", device_problem(lab->device));
    }
}

void *lab_memory(struct lab *lab, size_t count, size_t size)
{
    void *memory = calloc(count > 0 ? count : 1, size);

    if (memory == NULL) {
        lab_fail(lab, "out of memory");
    }
    return memory;
}

void lab_run(const struct experiment *experiment, const struct paper_options *options, FILE *record)
{
    char problem[DEVICE_PROBLEM_MAX], board[NAME_SIZE], build[NAME_SIZE];
    struct lab lab = {.options = options, .record = record};

    children_guard();
    lab.device = device_open(options->port, options->limit_s, problem);
    if (lab.device == NULL) {
        lab_fail(&lab, "%s", problem);
    }
    const struct device_identity *identity = device_identity(lab.device);
    (void)snprintf(board, sizeof board, "%s, %s", identity->board, identity->core);
    (void)snprintf(build, sizeof build, "%s, %s", identity->version, identity->build);
    record_write(record, RECORD_DEVICE, board, build, NULL);
    experiment->run(&lab);
    device_close(lab.device);
    _exit(0);
}

const struct paper_options *lab_options(const struct lab *lab) { return lab->options; }

/* --- The set ------------------------------------------------------------------------------------------------------ */

/* Takes the next word of a text, which moves behind it. False at the end. */
static bool word_take(const char **text, char word[WORD_SIZE])
{
    *text += strspn(*text, " ");
    const size_t length = strcspn(*text, " ");
    (void)snprintf(word, WORD_SIZE, "%.*s", (int)length, *text);
    *text += length;
    return length > 0;
}

static int param_find(struct lab *lab, const char *symbol)
{
    const int param = device_find(lab->device, DEVICE_PARAMS, symbol);

    if (param < 0) {
        lab_fail(lab, "%s", device_problem(lab->device));
    }
    return param;
}

static float value_parse(struct lab *lab, int param, const char *text)
{
    float value = 0.0f;

    if (!device_parse(lab->device, (size_t)param, text, &value)) {
        lab_fail(lab, "%s", device_problem(lab->device));
    }
    return value;
}

/* How long a step is now, and how many are a period. */
static void time_read(struct lab *lab)
{
    struct device_status status;
    char text[DEVICE_TEXT_MAX];
    const int spp = param_find(lab, "spp");
    float value;

    lab_need(lab, device_status(lab->device, &status));
    lab_need(lab, device_get(lab->device, spp, &value));
    device_format(device_row(lab->device, DEVICE_PARAMS, (size_t)spp), value, text);
    lab->steps_per_period = (unsigned)strtoul(text, NULL, 10);
    lab->step_s = (double)status.step_s;
    lab->has_left = false;
}

void lab_reset(struct lab *lab)
{
    uint64_t step;

    lab_need(lab, device_reset(lab->device, &step));
    lab->has_left = false;
}

void lab_set(struct lab *lab, const char *assignments)
{
    struct device_value values[VALUES_MAX];
    char symbol[WORD_SIZE], text[WORD_SIZE];
    size_t count = 0;

    lab_reset(lab); /* what stands at step 0 takes every change */
    for (; count < VALUES_MAX && word_take(&assignments, symbol); count++) {
        (void)word_take(&assignments, text);
        values[count].index = param_find(lab, symbol);
        values[count].value = value_parse(lab, values[count].index, text);
    }
    if (count > 0) {
        lab_need(lab, device_set(lab->device, values, count, NULL, true, NULL));
    }
    time_read(lab);
}

void lab_preset(struct lab *lab, const char *name)
{
    const struct paper_options *options = lab->options;
    const int preset = device_find(lab->device, DEVICE_PRESETS, name);
    char settings[NAME_SIZE];

    if (preset < 0) {
        lab_fail(lab, "%s", device_problem(lab->device));
    }
    lab_need(lab, device_preset(lab->device, preset, NULL));
    (void)snprintf(settings, sizeof settings, "spp %s normal %s method %s arith %s substeps 64 tick 200", options->spp,
                   options->normal, options->method, options->arith);
    lab_set(lab, settings);
}

double lab_get(struct lab *lab, const char *symbol)
{
    float value;

    lab_need(lab, device_get(lab->device, param_find(lab, symbol), &value));
    return (double)value;
}

double lab_step_s(struct lab *lab) { return lab->step_s; }
double lab_period_s(struct lab *lab) { return lab->step_s * lab->steps_per_period; }
unsigned lab_steps_per_period(struct lab *lab) { return lab->steps_per_period; }

/* --- Running ------------------------------------------------------------------------------------------------------ */

void lab_step(struct lab *lab, uint64_t count)
{
    struct master_state state = {0};

    if (lab->has_left || count == 0) {
        return;
    }
    lab_need(lab, device_step(lab->device, count, NULL, &state));
    if ((state.flags & LINK_WAS_CUT) != 0 && (state.flags & LINK_IS_FAULT) == 0) {
        lab_fail(lab, "something else stopped the plant at step %llu", (unsigned long long)state.step);
    }
    lab->has_left = (state.flags & LINK_IS_FAULT) != 0;
}

bool lab_settle(struct lab *lab, unsigned periods)
{
    lab_step(lab, (uint64_t)periods * lab->steps_per_period);
    return !lab->has_left;
}

/* --- Studies ------------------------------------------------------------------------------------------------------ */

struct scan {
    struct device_point *points;
    size_t count;
    bool has_ended;
    struct device_tally tally;
};

static void scan_point(void *context, const struct device_point *point)
{
    struct scan *scan = context;

    if (point->index < scan->count) {
        scan->points[point->index] = *point;
    }
}

static void scan_end(void *context, const struct device_tally *tally)
{
    struct scan *scan = context;

    scan->has_ended = true;
    scan->tally = *tally;
}

/* Reads "N0 1 10 19 alpha -0.1 -0.01 5 log". Returns how many axes. */
static size_t axes_read(struct lab *lab, const char *text, struct device_axis axes[2])
{
    char word[WORD_SIZE], from[WORD_SIZE], to[WORD_SIZE], points[WORD_SIZE];
    size_t count = 0;

    while (word_take(&text, word)) {
        if (strcmp(word, "log") == 0 && count > 0) {
            axes[count - 1].is_log = true;
            continue;
        }
        if (count == 2 || !word_take(&text, from) || !word_take(&text, to) || !word_take(&text, points)) {
            lab_fail(lab, "no axes of a scan");
        }
        const int param = param_find(lab, word);
        axes[count++] = (struct device_axis){.param = param,
                                             .from = value_parse(lab, param, from),
                                             .to = value_parse(lab, param, to),
                                             .points = (unsigned)strtoul(points, NULL, 10)};
    }
    return count;
}

const struct device_point *lab_scan(struct lab *lab, const char *axes, const struct device_span *span, size_t *count)
{
    struct device_axis axis[2] = {{0}, {.points = 1}};
    const size_t axis_count = axes_read(lab, axes, axis);
    struct scan scan = {.count = (size_t)axis[0].points * axis[1].points};
    const struct device_study study = {.context = &scan, .on_point = scan_point, .on_end = scan_end};
    uint32_t results;

    scan.points = lab_memory(lab, scan.count, sizeof *scan.points);
    lab_need(lab, device_scan(lab->device, axis, axis_count, span, &study, &results));
    if (!scan.has_ended) {
        lab_need(lab, device_await_study(lab->device, NULL));
    }
    if (!scan.has_ended || scan.tally.reason != 0 || scan.tally.results != scan.count) {
        lab_fail(lab, "a scan ended early: %s", device_error_name(scan.tally.reason));
    }
    if (count != NULL) {
        *count = scan.count;
    }
    return scan.points;
}
