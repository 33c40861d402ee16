/* record: a run from the initial state, its samples as CSV, the velocity as a sound, and a record with which it can be
 * made again. */
#include "squeal/commands/linked.h"

#include "base/decimal.h"
#include "protocol/signals.h"
#include "squeal/record/recording.h"
#include "squeal/record/table_file.h"
#include "squeal/support/wav.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { PATH_SIZE = 1024, SPP_DEFAULT = 64, SAMPLES_A_PERIOD = 32, SOUND_LONGEST_S = 600 };

/* What is asked for, and what the samples go into. */
struct take {
    const struct arguments *arguments;
    struct device *device;
    struct recording recording;
    struct recording_samples samples;
    int signals[DEVICE_SIGNALS_MAX];
    char csv[PATH_SIZE], json[PATH_SIZE], wav[PATH_SIZE];
    FILE *file;
    float step_s;
    int velocity;      /* place of xd among the signals; -1: not there */
    double *t_s, *v;   /* of each sample, for the sound; NULL: no sound */
    size_t capacity;   /* of both */
    bool is_too_large; /* for the memory */
};

static int fail_here(const char *problem)
{
    (void)fflush(stdout);
    fprintf(stderr, "squeal: %s\n", problem);
    return EXIT_FAILED;
}

/* Reads "x,xd,N" into the signals. Step and time are written with every sample, so they need not come over the line. */
static int read_signals(struct take *take)
{
    static const char standard[] = "x,xd,y,yd,N,F,vr,mode,propensity,v0";
    const char *list = arguments_text(take->arguments, "--signals");

    for (const char *at = list != NULL ? list : standard; *at != '\0'; at += *at == ',' ? 1 : 0) {
        char symbol[DEVICE_TEXT(LINK_SYMBOL_WIDTH)];
        const size_t length = strcspn(at, ",");
        (void)snprintf(symbol, sizeof symbol, "%.*s", (int)length, at);
        at += length;
        const int signal = device_find(take->device, DEVICE_SIGNALS, symbol);
        if (signal < 0) {
            return linked_fail_name(take->device);
        }
        const bool comes_anyway = strcmp(symbol, "step") == 0 || strcmp(symbol, "t") == 0;
        if (!comes_anyway && take->samples.signal_count < DEVICE_SIGNALS_MAX) {
            take->signals[take->samples.signal_count++] = signal;
        }
    }
    take->samples.signals = take->signals;
    return EXIT_OK;
}

/* Tables from files, into the recording's own. */
static int read_tables(struct take *take, struct device_tables *tables)
{
    static const char *const options[PARAMS_TABLES] = {"--load-table", "--speed-table"};

    for (int i = 0; i < PARAMS_TABLES; i++) {
        const char *path = arguments_text(take->arguments, options[i]);
        char problem[CSV_PROBLEM_MAX];
        if (path == NULL) {
            continue;
        }
        tables->table[i] = &take->recording.tables[i];
        if (!table_file_read(path, (enum params_table_index)i, &take->recording.tables[i], problem)) {
            return fail_here(problem);
        }
    }
    return EXIT_OK;
}

/* The set: a preset, or what is in force, with the assignments on top; the run begins at step 0. */
static int prepare_set(struct take *take)
{
    const struct arguments *arguments = take->arguments;
    const char *preset = arguments_text(arguments, "--preset");
    struct device_value *values = calloc(arguments->operand_count + 1, sizeof *values);
    struct device_tables tables = {{NULL}};
    uint64_t step;
    int code = values != NULL ? read_tables(take, &tables) : fail_here("out of memory");
    const int index = preset != NULL ? device_find(take->device, DEVICE_PRESETS, preset) : 0;

    code = code != EXIT_OK ? code : index < 0 ? linked_fail_name(take->device) : EXIT_OK;
    code = code != EXIT_OK ? code
                           : linked_read_values(take->device, arguments->operands, arguments->operand_count, values);
    if (code == EXIT_OK) {
        enum device_result result =
            preset != NULL ? device_preset(take->device, index, NULL) : device_reset(take->device, &step);
        if (result == DEVICE_OK && (arguments->operand_count > 0 || tables.table[PARAMS_TABLE_LOAD] != NULL ||
                                    tables.table[PARAMS_TABLE_SPEED] != NULL)) {
            result = device_set(take->device, values, arguments->operand_count, &tables, true, NULL);
        }
        result = result == DEVICE_OK ? recording_read_set(&take->recording, take->device) : result;
        result = result == DEVICE_OK ? device_status(take->device, &take->recording.status) : result;
        code = result == DEVICE_OK ? EXIT_OK : linked_fail(take->device, result);
    }
    free(values);
    return code;
}

/* Steps a normal period, as far as the device has a parameter that says so. */
static double steps_per_period(struct take *take)
{
    const int index = device_find(take->device, DEVICE_PARAMS, "spp");
    char text[DEVICE_TEXT_MAX] = "";

    if (index >= 0) {
        device_format(device_row(take->device, DEVICE_PARAMS, (size_t)index), take->recording.set[index].value, text);
    }
    const double steps = strtod(text, NULL);
    return steps >= 1.0 ? steps : SPP_DEFAULT;
}

static bool read_length(struct take *take)
{
    const double step_s = (double)take->recording.status.step_s;
    double seconds = 0.0;

    take->step_s = take->recording.status.step_s;
    if ((arguments_text(take->arguments, "--steps") != NULL) ==
        (arguments_text(take->arguments, "--seconds") != NULL)) {
        fprintf(stderr, "squeal: how long? --steps or --seconds of the plant's time is wanted\n");
        return false;
    }
    if (!arguments_whole(take->arguments, "--steps", 1, UINT64_C(1000000000000), &take->recording.steps) ||
        !arguments_real(take->arguments, "--seconds", step_s, step_s * 1e12, &seconds)) {
        return false;
    }
    if (take->recording.steps == 0) {
        take->recording.steps = (uint64_t)(seconds / step_s + 0.5);
    }
    uint64_t every = (uint64_t)(steps_per_period(take) / SAMPLES_A_PERIOD);
    every = every > 0 ? every : 1;
    if (!arguments_whole(take->arguments, "--every", 1, 1000000000, &every)) {
        return false;
    }
    take->samples.every = (uint32_t)every;
    return true;
}

/* What is held from the start on, and the table of what comes later. */
static int read_inputs(struct take *take)
{
    struct input_demand demand = {0};
    const char *path = arguments_text(take->arguments, "--inputs");
    char problem[CSV_PROBLEM_MAX];

    if (!linked_read_demand(take->arguments, &demand)) {
        return EXIT_USAGE;
    }
    demand.step = 0;
    const bool is_held = demand.load != INPUT_LOAD_KEEP || demand.speed != INPUT_SPEED_KEEP;
    if (is_held && !recording_add_input(&take->recording, &demand)) {
        return fail_here("out of memory");
    }
    return path == NULL || recording_read_inputs(&take->recording, path, problem) ? EXIT_OK : fail_here(problem);
}

/* name.csv gives name.json and name.wav. */
static bool name_files(struct take *take)
{
    const char *out = arguments_need(take->arguments, "--out");
    const char *suffix = out != NULL ? strrchr(out, '.') : NULL;

    if (out == NULL) {
        return false;
    }
    if (suffix == NULL || strcmp(suffix, ".csv") != 0 || strlen(out) + 2 > PATH_SIZE) {
        fprintf(stderr, "squeal: --out %.80s: a name that ends in .csv is wanted\n", out);
        return false;
    }
    (void)snprintf(take->csv, PATH_SIZE, "%s", out);
    (void)snprintf(take->json, PATH_SIZE, "%.*s.json", (int)(suffix - out), out);
    (void)snprintf(take->wav, PATH_SIZE, "%.*s.wav", (int)(suffix - out), out);
    return true;
}

static void write_header(struct take *take)
{
    const struct device_identity *identity = device_identity(take->device);

    (void)fprintf(take->file, "# squeal record: version %s, build %s, board %s, core %s\n# set:", identity->version,
                  identity->build, identity->board, identity->core);
    for (size_t i = 0; i < take->recording.set_count; i++) {
        const struct device_row *row = device_row(take->device, DEVICE_PARAMS, i);
        char text[DEVICE_TEXT_MAX];
        device_format(row, take->recording.set[i].value, text);
        (void)fprintf(take->file, " %s=%s", row->symbol, text);
    }
    (void)fprintf(take->file, "\n# step_s %.9g, every %u, %zu inputs; %s has all of it\nstep,t[s]",
                  (double)take->step_s, take->samples.every, take->recording.input_count, take->json);
    for (size_t i = 0; i < take->samples.signal_count; i++) {
        const struct device_row *row = device_row(take->device, DEVICE_SIGNALS, (size_t)take->signals[i]);
        const bool is_ratio = linked_unit(row)[0] == '\0';
        (void)fprintf(take->file, is_ratio ? ",%s" : ",%s[%s]", row->symbol, row->unit);
    }
    (void)fputc('\n', take->file);
}

static void keep_for_sound(struct take *take, double t_s, double velocity)
{
    const size_t count = (size_t)take->samples.count;

    if (count == take->capacity) {
        const size_t capacity = 2 * take->capacity;
        double *t = realloc(take->t_s, capacity * sizeof *t);
        take->t_s = t != NULL ? t : take->t_s;
        double *v = t != NULL ? realloc(take->v, capacity * sizeof *v) : NULL;
        take->v = v != NULL ? v : take->v;
        take->is_too_large = v == NULL;
        take->capacity = v != NULL ? capacity : take->capacity;
    }
    if (!take->is_too_large) {
        take->t_s[count] = t_s;
        take->v[count] = velocity;
    }
}

static void take_sample(void *context, const struct device_sample *sample)
{
    struct take *take = context;
    char text[DEVICE_TEXT_MAX];

    (void)decimal_format_product(sample->step, take->step_s, DECIMAL_DIGITS_EXACT, text);
    (void)fprintf(take->file, "%" PRIu64 ",%s", sample->step, text);
    for (size_t i = 0; i < sample->count; i++) {
        linked_format_signal(device_row(take->device, DEVICE_SIGNALS, (size_t)sample->signal[i]), sample->value[i],
                             text);
        (void)fprintf(take->file, ",%s", text);
    }
    (void)fputc('\n', take->file);
    if (take->v != NULL && !take->is_too_large) {
        keep_for_sound(take, (double)sample->step * (double)take->step_s, sample->value[take->velocity]);
    }
    take->samples.count++;
    take->samples.missing += sample->missing;
}

/* The samples come in the order of the device's table, whatever the order in which they were asked for. */
static int compare_signals(const void *a, const void *b) { return *(const int *)a - *(const int *)b; }

static bool prepare_sound(struct take *take)
{
    const int velocity = device_find(take->device, DEVICE_SIGNALS, "xd");

    take->velocity = -1;
    for (size_t i = 0; i < take->samples.signal_count; i++) {
        take->velocity = take->signals[i] == velocity ? (int)i : take->velocity;
    }
    if (!arguments_flag(take->arguments, "--wav")) {
        return true;
    }
    if (take->velocity < 0) {
        fprintf(stderr, "squeal: --wav needs xd among the signals\n");
        return false;
    }
    take->capacity = 4096;
    take->t_s = malloc(take->capacity * sizeof *take->t_s);
    take->v = malloc(take->capacity * sizeof *take->v);
    return take->t_s != NULL && take->v != NULL;
}

static int play(struct take *take)
{
    struct recording *recording = &take->recording;

    device_on_sample(take->device, take_sample, take);
    enum device_result result =
        device_stream(take->device, take->signals, take->samples.signal_count, take->samples.every, NULL);
    result = result == DEVICE_OK ? recording_play(recording, take->device) : result;
    result = result == DEVICE_OK ? device_stream(take->device, NULL, 0, 0, NULL) : result;
    result = result == DEVICE_OK ? device_status(take->device, &recording->status) : result;
    return result == DEVICE_OK ? EXIT_OK : linked_fail(take->device, result);
}

/* Closes the files and says what is in them. */
static int finish(struct take *take)
{
    const struct recording *recording = &take->recording;
    const char *port = arguments_text(take->arguments, "--port");
    char problem[CSV_PROBLEM_MAX];

    const bool is_whole = csv_close(take->file, take->csv, problem);
    take->file = NULL;
    if (!is_whole ||
        !recording_write(recording, take->device, port != NULL ? port : "", &take->samples, take->json, problem)) {
        return fail_here(problem);
    }
    printf("%s: %" PRIu64 " samples, each %u steps, %" PRIu64 " missing\n%s: %" PRIu64 " steps, %.6g s, hash %08x\n",
           take->csv, take->samples.count, take->samples.every, take->samples.missing, take->json, recording->at,
           (double)recording->at * (double)take->step_s, recording->hash);
    if (take->v != NULL) {
        const double length_s = take->is_too_large ? 0.0
                                                   : wav_write(take->wav, take->t_s, take->v,
                                                               (size_t)take->samples.count, SOUND_LONGEST_S, problem);
        if (length_s <= 0.0) {
            return fail_here(take->is_too_large ? "out of memory for the sound" : problem);
        }
        printf("%s: the pad's velocity, %.3f s\n", take->wav, length_s);
    }
    if (recording->is_fault) {
        return fail_here("the plant left its domain: the record ends there");
    }
    return recording->was_cut ? fail_here("stopped before its end: the record is that of a shorter run") : EXIT_OK;
}

static int record(struct take *take)
{
    char problem[CSV_PROBLEM_MAX];
    int code = read_signals(take);

    code = code == EXIT_OK ? prepare_set(take) : code;
    code = code == EXIT_OK && (!read_length(take) || !prepare_sound(take)) ? EXIT_USAGE : code;
    code = code == EXIT_OK ? read_inputs(take) : code;
    if (code != EXIT_OK) {
        return code;
    }
    qsort(take->signals, take->samples.signal_count, sizeof take->signals[0], compare_signals);
    take->file = csv_create(take->csv, problem);
    if (take->file == NULL) {
        return fail_here(problem);
    }
    take->samples.path = take->csv;
    write_header(take);
    code = play(take);
    return code == EXIT_OK ? finish(take) : code;
}

int command_record(const struct arguments *arguments)
{
    struct take *take = calloc(1, sizeof *take);
    int code = EXIT_USAGE;

    if (take == NULL) {
        return fail_here("out of memory");
    }
    take->arguments = arguments;
    if (name_files(take)) {
        code = linked_open(arguments, &take->device);
        code = code == EXIT_OK ? record(take) : code;
    }
    if (take->file != NULL) {
        (void)fclose(take->file);
    }
    recording_free(&take->recording);
    device_close(take->device);
    free(take->t_s);
    free(take->v);
    free(take);
    return code;
}
