/* A run as JSON, and back. */
#include "squeal/record/recording.h"

#include "base/decimal.h"
#include "squeal/support/json.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

enum { VERSION = 1, WORD_SIZE = 32 };

static const char *const load_names[] = {"keep", "profile", "force_n", "pressure_pa"};
static const char *const speed_names[] = {"keep", "profile", "disc_m_per_s", "vehicle_m_per_s"};

static void value_write(FILE *file, const char *text) { json_write_value(file, text, strlen(text)); }

static void set_write(FILE *file, const struct recording *recording, struct device *device)
{
    char text[DEVICE_TEXT_MAX];

    for (size_t i = 0; i < recording->set_count; i++) {
        const struct device_row *row = device_row(device, DEVICE_PARAMS, (size_t)recording->set[i].index);
        (void)fputs(i > 0 ? ", " : "", file);
        json_write_string(file, row->symbol);
        (void)fputs(": ", file);
        device_format(row, recording->set[i].value, text);
        value_write(file, text);
    }
}

static void table_write(FILE *file, const char *name, const struct params_points *table)
{
    char time[DECIMAL_SIZE_MAX], value[DECIMAL_SIZE_MAX];

    (void)fprintf(file, "\"%s\": [", name);
    for (uint32_t i = 0; i < table->count; i++) {
        (void)decimal_format_shortest(table->points[i].time_s, time);
        (void)decimal_format_shortest(table->points[i].value, value);
        (void)fprintf(file, "%s[%s, %s]", i > 0 ? ", " : "", time, value);
    }
    (void)fputc(']', file);
}

static void held_write(FILE *file, const char *name, float value)
{
    char text[DECIMAL_SIZE_MAX];

    (void)decimal_format_shortest(value, text);
    (void)fprintf(file, ", \"%s\": %s", name, text);
}

static void inputs_write(FILE *file, const struct recording *recording)
{
    for (size_t i = 0; i < recording->input_count; i++) {
        const struct input_demand *input = &recording->inputs[i];
        (void)fprintf(file, "%s\n    {\"step\": %" PRIu64, i > 0 ? "," : "", input->step);
        if (input->load != INPUT_LOAD_KEEP) {
            held_write(file, load_names[input->load], input->load_value);
        }
        if (input->speed != INPUT_SPEED_KEEP) {
            held_write(file, speed_names[input->speed], input->speed_value);
        }
        (void)fputc('}', file);
    }
}

static void device_write(FILE *file, struct device *device)
{
    const struct device_identity *identity = device_identity(device);

    (void)fputs("{\"version\": ", file);
    json_write_string(file, identity->version);
    (void)fputs(", \"build\": ", file);
    json_write_string(file, identity->build);
    (void)fputs(", \"board\": ", file);
    json_write_string(file, identity->board);
    (void)fputs(", \"core\": ", file);
    json_write_string(file, identity->core);
    (void)fprintf(file,
                  ", \"emulated\": %s,\n    \"link\": \"%u.%u\", \"parameter_table\": %u, \"signal_table\": %u, "
                  "\"command_table\": %u}",
                  identity->is_emulated ? "true" : "false", identity->major, identity->minor, identity->params_version,
                  identity->signals_version, identity->commands_version);
}

static void samples_write(FILE *file, struct device *device, const struct recording_samples *samples)
{
    if (samples->path == NULL) {
        (void)fputs("null", file);
        return;
    }
    (void)fputs("{\"file\": ", file);
    json_write_string(file, samples->path);
    (void)fprintf(file, ", \"every\": %u, \"count\": %" PRIu64 ", \"missing\": %" PRIu64 ", \"signals\": [",
                  samples->every, samples->count, samples->missing);
    for (size_t i = 0; i < samples->signal_count; i++) {
        (void)fputs(i > 0 ? ", " : "", file);
        json_write_string(file, device_row(device, DEVICE_SIGNALS, (size_t)samples->signals[i])->symbol);
    }
    (void)fputs("]}", file);
}

static void counters_write(FILE *file, const struct device_status *status)
{
    (void)fprintf(
        file,
        "{\"events\": %u, \"caps\": %u, \"saturations\": %u, \"lifted\": %u, \"gap_held\": %u, \"ticks\": %u, "
        "\"overruns\": %u, \"shed\": %u,\n    \"inputs\": %u, \"inputs_late\": %u, \"inputs_clamped\": %u}",
        status->events, status->caps, status->saturations, status->lifted, status->gap_held, status->ticks,
        status->overruns, status->shed, status->inputs, status->inputs_late, status->inputs_clamped);
}

bool recording_write(const struct recording *recording, struct device *device, const char *port,
                     const struct recording_samples *samples, const char *path, char problem[CSV_PROBLEM_MAX])
{
    FILE *file = csv_create(path, problem);
    char step_s[DECIMAL_SIZE_MAX], t_s[DECIMAL_SIZE_MAX];

    if (file == NULL) {
        return false;
    }
    (void)decimal_format_f32(recording->status.step_s, DECIMAL_DIGITS_EXACT, step_s);
    (void)decimal_format_product(recording->at, recording->status.step_s, DECIMAL_DIGITS_EXACT, t_s);
    (void)fprintf(file, "{\n  \"squeal_record\": %d,\n  \"port\": ", VERSION);
    json_write_string(file, port);
    (void)fputs(",\n  \"device\": ", file);
    device_write(file, device);
    (void)fprintf(file, ",\n  \"set_crc\": \"%08x\",\n  \"set\": {", recording->status.set_crc);
    set_write(file, recording, device);
    (void)fputs("},\n  \"tables\": {", file);
    table_write(file, "load", &recording->tables[PARAMS_TABLE_LOAD]);
    (void)fputs(", ", file);
    table_write(file, "speed", &recording->tables[PARAMS_TABLE_SPEED]);
    (void)fputs("},\n  \"inputs\": [", file);
    inputs_write(file, recording);
    (void)fprintf(file,
                  "],\n  \"steps\": %" PRIu64 ", \"step_s\": %s, \"t_s\": %s,\n  \"hash\": \"%08x\", \"fault\": %s,\n"
                  "  \"counters\": ",
                  recording->at, step_s, t_s, recording->hash, recording->is_fault ? "true" : "false");
    counters_write(file, &recording->status);
    (void)fputs(",\n  \"samples\": ", file);
    samples_write(file, device, samples);
    (void)fputs("\n}\n", file);
    return csv_close(file, path, problem);
}

static bool fail(char problem[CSV_PROBLEM_MAX], const char *path, const char *what)
{
    (void)snprintf(problem, CSV_PROBLEM_MAX, "%.100s: %.140s", path, what);
    return false;
}

/* Every parameter of the device by its name; a newer device has some more, which stay as they are by default. */
static bool set_read(struct recording *recording, struct device *device, const char *set, const char *path,
                     char problem[CSV_PROBLEM_MAX])
{
    const size_t count = device_count(device, DEVICE_PARAMS);
    size_t found = 0;

    recording->set = calloc(count + 1, sizeof *recording->set);
    recording->set_count = recording->set != NULL ? count : 0;
    for (size_t i = 0; i < recording->set_count; i++) {
        const struct device_row *row = device_row(device, DEVICE_PARAMS, i);
        char text[DEVICE_TEXT_MAX];
        recording->set[i] = (struct device_value){(int)i, row->standard};
        if (json_text(json_member(set, row->symbol), text, sizeof text)) {
            found++;
            if (!device_parse(device, i, text, &recording->set[i].value)) {
                return fail(problem, path, device_problem(device));
            }
        }
    }
    return found == json_count(set) && found > 0 ? true
                                                 : fail(problem, path, "its set has a parameter that the device lacks");
}

/* Which of the kinds the input names, and its value. */
static int held_read(const char *input, const char *const names[4], float *value)
{
    char text[WORD_SIZE];

    for (int kind = 1; kind < 4; kind++) {
        if (json_text(json_member(input, names[kind]), text, sizeof text)) {
            return decimal_parse_f32(text, strlen(text), value) ? kind : -1;
        }
    }
    return 0;
}

/* A record without tables is that of a set without them. */
static bool table_read(struct params_points *table, const char *points)
{
    const size_t count = json_count(points);
    char time[WORD_SIZE], value[WORD_SIZE];

    for (size_t i = 0; i < count && count <= PARAMS_POINTS_MAX; i++) {
        const char *point = json_element(points, i);
        if (!json_text(json_element(point, 0), time, sizeof time) ||
            !json_text(json_element(point, 1), value, sizeof value) ||
            !decimal_parse_f32(time, strlen(time), &table->points[i].time_s) ||
            !decimal_parse_f32(value, strlen(value), &table->points[i].value)) {
            return false;
        }
        table->count++;
    }
    return table->count == count;
}

static bool whole_read(const char *value, uint64_t *out)
{
    char text[WORD_SIZE];

    return json_text(value, text, sizeof text) && decimal_parse_u64(text, strlen(text), out);
}

static bool inputs_read(struct recording *recording, const char *inputs)
{
    const char *input;

    for (size_t i = 0; (input = json_element(inputs, i)) != NULL; i++) {
        struct input_demand demand = {0};
        const int load = held_read(input, load_names, &demand.load_value);
        const int speed = held_read(input, speed_names, &demand.speed_value);
        demand.load = (enum input_load)load;
        demand.speed = (enum input_speed)speed;
        if (load < 0 || speed < 0 || !whole_read(json_member(input, "step"), &demand.step) ||
            !recording_add_input(recording, &demand)) {
            return false;
        }
    }
    return true;
}

static bool hash_read(const char *value, uint32_t *hash)
{
    char text[WORD_SIZE], *end;

    if (!json_text(value, text, sizeof text) || strlen(text) != 8) {
        return false;
    }
    *hash = (uint32_t)strtoul(text, &end, 16);
    return *end == '\0';
}

static bool read_all(struct recording *recording, struct device *device, const char *json, const char *path,
                     char problem[CSV_PROBLEM_MAX])
{
    uint64_t version = 0;

    if (!whole_read(json_member(json, "squeal_record"), &version)) {
        return fail(problem, path, "no record of a run");
    }
    if (version != VERSION) {
        return fail(problem, path, "a record of another version of this tool");
    }
    if (!whole_read(json_member(json, "steps"), &recording->steps) || recording->steps == 0 ||
        !hash_read(json_member(json, "hash"), &recording->hash) ||
        !inputs_read(recording, json_member(json, "inputs")) ||
        !table_read(&recording->tables[PARAMS_TABLE_LOAD], json_member(json_member(json, "tables"), "load")) ||
        !table_read(&recording->tables[PARAMS_TABLE_SPEED], json_member(json_member(json, "tables"), "speed"))) {
        return fail(problem, path, "steps, hash, inputs or tables are missing or damaged");
    }
    return set_read(recording, device, json_member(json, "set"), path, problem);
}

bool recording_read(struct recording *recording, struct device *device, const char *path, char problem[CSV_PROBLEM_MAX])
{
    char *json = json_read(path, problem);

    memset(recording, 0, sizeof *recording);
    if (json == NULL) {
        return false;
    }
    const bool is_good = read_all(recording, device, json, path, problem);
    free(json);
    if (!is_good) {
        recording_free(recording);
    }
    return is_good;
}
