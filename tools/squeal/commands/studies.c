/* Studies on the device: scan, a map as CSV, and margin, the borders of squeal. */
#include "squeal/commands/linked.h"

#include "base/errors.h"
#include "sim/detector.h"
#include "sim/trial.h"
#include "squeal/support/children.h"
#include "squeal/support/csv.h"
#include "squeal/support/progress.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { AXES_MAX = 2, POINTS_MAX = 256, SCAN_TRANSIENT = 360, MARGIN_TRANSIENT = 1600, WINDOW = 40 };

#define MARGIN_WITHIN 16.0

/* One study under way. */
struct study {
    struct device *device;
    struct device_axis axes[AXES_MAX];
    size_t axis_count;
    FILE *file; /* NULL: nothing is written */
    const char *path;
    struct progress progress;
    size_t came;
    bool is_awaited; /* progress has begun */
    bool has_ended;
    struct device_tally tally;
};

static int fail_here(const char *problem)
{
    (void)fflush(stdout);
    fprintf(stderr, "squeal: %s\n", problem);
    return EXIT_FAILED;
}

static const struct device_row *param_of(const struct study *study, int index)
{
    return device_row(study->device, DEVICE_PARAMS, (size_t)index);
}

static bool read_span(const struct arguments *arguments, unsigned transient, struct device_span *span)
{
    uint64_t periods = transient, window = WINDOW;

    if (!arguments_whole(arguments, "--transient", 0, 65535, &periods) ||
        !arguments_whole(arguments, "--window", 8, 65535, &window)) {
        return false;
    }
    *span = (struct device_span){(unsigned)periods, (unsigned)window, arguments_flag(arguments, "--whole")};
    return true;
}

static void on_end(void *context, const struct device_tally *tally)
{
    struct study *study = context;

    study->has_ended = true;
    study->tally = *tally;
}

/* The first results may come in one piece with the reply, before anybody waits for them. */
static void on_progress(struct study *study)
{
    study->came++;
    if (study->is_awaited) {
        progress_show(&study->progress, study->came);
    }
}

/* Waits for the end and says how it was. The first Ctrl-C ends the study in words. */
static int await(struct study *study, const char *what, uint32_t results)
{
    progress_start(&study->progress, results > 0 ? results : 1, what);
    study->is_awaited = true;
    children_hold_interrupt(true);
    const enum device_result result = device_await_study(study->device, children_is_interrupted);
    children_hold_interrupt(false);
    (void)progress_end(&study->progress);
    if (result != DEVICE_OK) {
        return linked_fail(study->device, result);
    }
    if (!study->has_ended) {
        return fail_here("the study ended without a word");
    }
    printf("%u trials: %u squeal, %u watch, %u quiet, %u unknown; %u refused, %u diverged; %llu steps\n",
           study->tally.trials, study->tally.squeal, study->tally.watch, study->tally.quiet, study->tally.unknown,
           study->tally.refused, study->tally.diverged, (unsigned long long)study->tally.steps);
    if (study->tally.reason == ERROR_STOPPED) {
        return fail_here("stopped before its end");
    }
    if (study->tally.reason != ERROR_OK) {
        return fail_here("the set in force cannot be tried: set it right first");
    }
    return study->came == results ? EXIT_OK : fail_here("results are missing");
}

/* --- scan --------------------------------------------------------------------------------------------------------- */

/* Reads "NAME FROM TO POINTS [log]" from the operands on. Returns how many it took, 0 after a mistake with *code. */
static size_t read_axis(struct study *study, char *const *words, size_t count, struct device_axis *axis, int *code)
{
    uint64_t points = 0;

    *code = EXIT_USAGE;
    if (count < 4) {
        fprintf(stderr, "squeal: an axis is NAME FROM TO POINTS, and log for equal ratios\n");
        return 0;
    }
    axis->param = device_find(study->device, DEVICE_PARAMS, words[0]);
    if (axis->param < 0 || !device_parse(study->device, (size_t)axis->param, words[1], &axis->from) ||
        !device_parse(study->device, (size_t)axis->param, words[2], &axis->to)) {
        *code = linked_fail_name(study->device);
        return 0;
    }
    if (!arguments_parse_whole("POINTS", words[3], 1, POINTS_MAX, &points)) {
        return 0;
    }
    axis->points = (unsigned)points;
    axis->is_log = count > 4 && strcmp(words[4], "log") == 0;
    *code = EXIT_OK;
    return axis->is_log ? 5 : 4;
}

static int read_axes(struct study *study, const struct arguments *arguments)
{
    size_t taken = 0;
    int code = EXIT_OK;

    while (taken < arguments->operand_count && study->axis_count < AXES_MAX && code == EXIT_OK) {
        taken += read_axis(study, arguments->operands + taken, arguments->operand_count - taken,
                           &study->axes[study->axis_count], &code);
        study->axis_count++;
    }
    if (code == EXIT_OK && taken < arguments->operand_count) {
        fprintf(stderr, "squeal: a scan has one axis or two\n");
        return EXIT_USAGE;
    }
    return code;
}

static void write_head(const struct study *study)
{
    const struct device_identity *identity = device_identity(study->device);

    (void)fprintf(study->file, "# squeal scan: version %s, build %s, board %s\ni,j", identity->version, identity->build,
                  identity->board);
    for (size_t i = 0; i < study->axis_count; i++) {
        const struct device_row *row = param_of(study, study->axes[i].param);
        (void)fprintf(study->file, linked_unit(row)[0] == '\0' ? ",%s" : ",%s[%s]", row->symbol, row->unit);
    }
    (void)fputs(
        ",propensity,class,period,amplitude[um],velocity[mm/s],frequency[Hz],level[dB],growth[1/s],growth_error[1/s],"
        "predicted,predicted_growth[1/s],end,loud,undecided,periods,error\n",
        study->file);
}

static void write_outcome(FILE *file, const struct device_point *point)
{
    const float values[] = {point->amplitude_um, point->velocity_mm_s, point->frequency_hz,
                            point->level_db,     point->growth_per_s,  point->growth_error_per_s};
    char text[DEVICE_TEXT_MAX];

    (void)fprintf(file, ",%s,%s,%u", detector_propensity_name(point->propensity), detector_class_name(point->motion),
                  point->period);
    for (size_t i = 0; i < sizeof values / sizeof values[0]; i++) {
        (void)fprintf(file, ",%s", linked_number(values[i], text));
    }
    (void)fprintf(file, ",%s,%s,%s,%u,%u", detector_propensity_name(point->predicted),
                  linked_number(point->predicted_growth_per_s, text), trial_end_name(point->end),
                  point->is_loud ? 1u : 0u, point->is_undecided ? 1u : 0u);
    (void)fprintf(file, ",%s,\n", linked_number(point->periods, text));
}

static void on_point(void *context, const struct device_point *point)
{
    struct study *study = context;
    char text[DEVICE_TEXT_MAX];

    (void)fprintf(study->file, "%u,%u", point->index % study->axes[0].points, point->index / study->axes[0].points);
    for (size_t i = 0; i < study->axis_count; i++) {
        device_format(param_of(study, study->axes[i].param), point->at[i], text);
        (void)fprintf(study->file, ",%s", text);
    }
    if (point->error == ERROR_OK) {
        write_outcome(study->file, point);
    } else {
        (void)fprintf(study->file, ",,,,,,,,,,,,,,,,%s\n", device_error_name(point->error));
    }
    on_progress(study);
}

static int scan(struct study *study, const struct arguments *arguments, const struct device_span *span)
{
    const struct device_study listener = {.context = study, .on_point = on_point, .on_end = on_end};
    char problem[CSV_PROBLEM_MAX];
    uint32_t results = 0;
    int code = read_axes(study, arguments);

    if (code != EXIT_OK) {
        return code;
    }
    study->file = csv_create(study->path, problem);
    if (study->file == NULL) {
        return fail_here(problem);
    }
    write_head(study);
    const enum device_result result =
        device_scan(study->device, study->axes, study->axis_count, span, &listener, &results);
    code = result == DEVICE_OK ? await(study, "points", results) : linked_fail(study->device, result);
    if (!csv_close(study->file, study->path, problem)) {
        return fail_here(problem);
    }
    if (study->came > 0) {
        printf("%s: %zu points\n", study->path, study->came);
    }
    return code;
}

int command_scan(const struct arguments *arguments)
{
    struct study study = {.path = arguments_need(arguments, "--out")};
    struct device_span span;

    if (study.path == NULL || !arguments_has_operands(arguments, 4, 10) ||
        !read_span(arguments, SCAN_TRANSIENT, &span)) {
        return EXIT_USAGE;
    }
    int code = linked_open(arguments, &study.device);
    code = code == EXIT_OK ? scan(&study, arguments, &span) : code;
    device_close(study.device);
    return code;
}

/* --- margin ------------------------------------------------------------------------------------------------------- */

static void tell_side(const char *name, const struct device_side *side)
{
    char border[DEVICE_TEXT_MAX], quiet[DEVICE_TEXT_MAX], squeal[DEVICE_TEXT_MAX];

    if (isfinite(side->border)) {
        printf("; %s %s (quiet %s, squeal %s)", name, linked_number(side->border, border),
               linked_number(side->quiet, quiet), linked_number(side->squeal, squeal));
    } else if (isfinite(side->searched)) {
        printf("; none %s up to %s", name, linked_number(side->searched, border));
    }
}

static void on_border(void *context, const struct device_border *border)
{
    static const char *const quiets[] = {"nothing near quiets it", "less of it quiets", "more of it quiets",
                                         "quiet all about"};
    struct study *study = context;
    const struct device_row *row = param_of(study, border->param);
    char text[DEVICE_TEXT_MAX];

    if (row != NULL) {
        printf("%s = %s%s: %s", row->symbol, linked_number(border->value, text), linked_unit(row),
               border->is_squeal ? "squeal" : "quiet");
        tell_side("below", &border->below);
        tell_side("above", &border->above);
        printf("; %s\n", quiets[border->quiets & 3]);
        (void)fflush(stdout);
    }
    on_progress(study);
}

static int margin(struct study *study, const struct arguments *arguments, double within, const struct device_span *span)
{
    const struct device_study listener = {.context = study, .on_border = on_border, .on_end = on_end};
    const bool is_one = arguments->operand_count > 0;
    const int param = is_one ? device_find(study->device, DEVICE_PARAMS, arguments->operands[0]) : -1;
    uint32_t results = 0;

    if (is_one && param < 0) {
        return linked_fail_name(study->device);
    }
    const enum device_result result = device_margin(study->device, param, (float)within, span, &listener, &results);
    return result == DEVICE_OK ? await(study, "parameters", results) : linked_fail(study->device, result);
}

int command_margin(const struct arguments *arguments)
{
    struct study study = {0};
    struct device_span span;
    double within = MARGIN_WITHIN;

    if (!arguments_has_operands(arguments, 0, 1) || !read_span(arguments, MARGIN_TRANSIENT, &span) ||
        !arguments_real(arguments, "--within", 1.001, 1e6, &within)) {
        return EXIT_USAGE;
    }
    int code = linked_open(arguments, &study.device);
    code = code == EXIT_OK ? margin(&study, arguments, within, &span) : code;
    device_close(study.device);
    return code;
}
