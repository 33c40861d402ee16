/* A run on a device. */
#include "squeal/record/recording.h"

#include "base/decimal.h"
#include "squeal/support/children.h"
#include "squeal/support/clock.h"
#include "squeal/support/progress.h"

#include <stdlib.h>
#include <string.h>

#define PATIENCE_S 1.0 /* nobody wants a bar for less */

enum { PARTS = 200 /* of a run, between two looks at the bar and at Ctrl-C */ };

void recording_free(struct recording *recording)
{
    free(recording->set);
    free(recording->inputs);
    memset(recording, 0, sizeof *recording);
}

bool recording_add_input(struct recording *recording, const struct input_demand *demand)
{
    struct input_demand *longer = realloc(recording->inputs, (recording->input_count + 1) * sizeof *recording->inputs);

    if (longer == NULL) {
        return false;
    }
    recording->inputs = longer;
    longer[recording->input_count++] = *demand;
    return true;
}

/* A cell's kind: 0 empty, 1 the profile, 2 a number; -1 a mistake. A column that is missing is empty. */
static int read_cell(const struct csv *csv, size_t row, int column, float *value)
{
    const char *text = csv_cell(csv, row, column);

    if (text == NULL || text[0] == '\0') {
        return 0;
    }
    if (strcmp(text, "profile") == 0) {
        return 1;
    }
    return decimal_parse_f32(text, strlen(text), value) ? 2 : -1;
}

/* Of the two columns for the same thing at most one may be filled. The kind in the order of enum input_load and
 * input_speed. */
static int read_pair(const struct csv *csv, size_t row, const char *first, const char *second, float *value)
{
    float other = 0.0f;
    const int one = read_cell(csv, row, csv_column(csv, first), value);
    const int two = read_cell(csv, row, csv_column(csv, second), &other);

    if (one < 0 || two < 0 || (one != 0 && two != 0)) {
        return -1;
    }
    *value = two == 2 ? other : *value;
    return two == 2 ? INPUT_LOAD_PRESSURE : one + two;
}

static bool read_input(const struct csv *csv, size_t row, struct input_demand *demand)
{
    const char *step = csv_cell(csv, row, csv_column(csv, "step"));
    const int load = read_pair(csv, row, "N[N]", "p[Pa]", &demand->load_value);
    const int speed = read_pair(csv, row, "v0[m/s]", "vehicle[m/s]", &demand->speed_value);

    demand->load = (enum input_load)load;
    demand->speed = (enum input_speed)speed;
    return load >= 0 && speed >= 0 && decimal_parse_u64(step, strlen(step), &demand->step);
}

static bool read_inputs(struct recording *recording, const struct csv *csv, const char *path,
                        char problem[CSV_PROBLEM_MAX])
{
    if (csv_column(csv, "step") < 0) {
        (void)snprintf(problem, CSV_PROBLEM_MAX, "%s: no column step", path);
        return false;
    }
    for (size_t row = 0; row < csv->rows; row++) {
        struct input_demand demand = {0};
        const uint64_t before = recording->input_count > 0 ? recording->inputs[recording->input_count - 1].step : 0;
        if (!read_input(csv, row, &demand) || demand.step < before || !recording_add_input(recording, &demand)) {
            (void)snprintf(
                problem, CSV_PROBLEM_MAX,
                "%s:%zu: a step not before the last one, and one number or profile for each of force and speed, "
                "are wanted",
                path, csv->lines[row]);
            return false;
        }
    }
    return true;
}

bool recording_read_inputs(struct recording *recording, const char *path, char problem[CSV_PROBLEM_MAX])
{
    struct csv csv;

    if (!csv_read(&csv, path, problem)) {
        return false;
    }
    const bool is_good = read_inputs(recording, &csv, path, problem);
    csv_free(&csv);
    return is_good;
}

enum device_result recording_read_set(struct recording *recording, struct device *device)
{
    const size_t count = device_count(device, DEVICE_PARAMS);
    enum device_result result = count > 0 ? DEVICE_OK : DEVICE_LOST;

    recording->set = calloc(count + 1, sizeof *recording->set);
    if (recording->set == NULL) {
        return DEVICE_LOST;
    }
    for (size_t i = 0; i < count && result == DEVICE_OK; i++) {
        recording->set[i].index = (int)i;
        result = device_get(device, (int)i, &recording->set[i].value);
    }
    recording->set_count = count;
    for (int i = 0; i < PARAMS_TABLES && result == DEVICE_OK; i++) {
        result = device_get_table(device, (enum params_table_index)i, &recording->tables[i]);
    }
    return result;
}

enum device_result recording_load(const struct recording *recording, struct device *device)
{
    const struct device_tables tables = {
        {&recording->tables[PARAMS_TABLE_LOAD], &recording->tables[PARAMS_TABLE_SPEED]}};
    uint64_t step;
    enum device_result result = device_reset(device, &step);

    return result == DEVICE_OK ? device_set(device, recording->set, recording->set_count, &tables, true, NULL) : result;
}

/* Where the run next takes an input, or ends. */
static uint64_t next_stop(const struct recording *recording, size_t taken)
{
    const uint64_t step = taken < recording->input_count ? recording->inputs[taken].step : recording->steps;

    return step < recording->steps ? step : recording->steps;
}

static bool is_over(const struct recording *recording, const struct master_state *state)
{
    return state->step >= recording->steps || (state->flags & (LINK_IS_FAULT | LINK_WAS_CUT)) != 0 ||
           children_is_interrupted();
}

/* All inputs that are due, in one demand: a later one of the same step outdoes what it names. */
static bool take_inputs(const struct recording *recording, size_t *taken, uint64_t step, struct input_demand *demand)
{
    const size_t before = *taken;

    *demand = (struct input_demand){.load = INPUT_LOAD_KEEP, .speed = INPUT_SPEED_KEEP};
    for (; *taken < recording->input_count && recording->inputs[*taken].step <= step; (*taken)++) {
        const struct input_demand *input = &recording->inputs[*taken];
        if (input->load != INPUT_LOAD_KEEP) {
            demand->load = input->load;
            demand->load_value = input->load_value;
        }
        if (input->speed != INPUT_SPEED_KEEP) {
            demand->speed = input->speed;
            demand->speed_value = input->speed_value;
        }
    }
    return *taken > before;
}

enum device_result recording_play(struct recording *recording, struct device *device)
{
    struct master_state state = {0};
    struct progress progress;
    enum device_result result = DEVICE_OK;
    size_t taken = 0;

    progress_start(&progress, (size_t)recording->steps, "steps");
    children_hold_interrupt(true);
    while (result == DEVICE_OK && !is_over(recording, &state)) {
        struct input_demand demand;
        const bool is_held = take_inputs(recording, &taken, state.step, &demand);
        const uint64_t left = next_stop(recording, taken) - state.step;
        const uint64_t part = recording->steps / PARTS + 1;
        result = device_step(device, left < part ? left : part, is_held ? &demand : NULL, &state);
        if (clock_now_s() - progress.start_s > PATIENCE_S) {
            progress_show(&progress, (size_t)state.step);
        }
    }
    children_hold_interrupt(false);
    (void)progress_end(&progress);
    recording->at = state.step;
    recording->hash = state.hash;
    recording->is_fault = (state.flags & LINK_IS_FAULT) != 0;
    recording->was_cut = state.step < recording->steps && !recording->is_fault;
    return result;
}
