/* The set: list, get, set, preset. */
#include "squeal/commands/linked.h"

#include "squeal/record/table_file.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool row_holds(const struct device_row *row, const char *text, bool in_help)
{
    return text == NULL || strstr(in_help ? row->help : row->symbol, text) != NULL;
}

/* Lines of a table. Those whose symbol holds the text or, if there are none, those whose help does. */
static int list_rows(struct device *device, enum device_table table, const char *text)
{
    const size_t count = device_count(device, table);
    size_t found = 0;

    for (int in_help = 0; in_help < 2 && found == 0; in_help++) {
        for (size_t i = 0; i < count; i++) {
            const struct device_row *row = device_row(device, table, i);
            char value[DEVICE_TEXT_MAX], low[DEVICE_TEXT_MAX], high[DEVICE_TEXT_MAX];
            float now;
            if (!row_holds(row, text, in_help != 0)) {
                continue;
            }
            found++;
            if (table != DEVICE_PARAMS) {
                printf("%-17s %s%s%s\n", row->symbol, row->help, linked_unit(row)[0] != '\0' ? "," : "",
                       linked_unit(row));
                continue;
            }
            const enum device_result result = device_get(device, (int)i, &now);
            if (result != DEVICE_OK) {
                return linked_fail(device, result);
            }
            device_format(row, now, value);
            device_format(row, row->low, low);
            device_format(row, row->high, high);
            printf("%s = %s%s [%s%s%s] %s  %s\n", row->symbol, value, linked_unit(row),
                   row->kind == LINK_CHOICE ? row->unit : low, row->kind == LINK_CHOICE ? "" : " .. ",
                   row->kind == LINK_CHOICE ? "" : high, row->change == LINK_LIVE ? "live" : "restart", row->help);
        }
    }
    if (device_is_lost(device)) {
        return linked_fail(device, DEVICE_LOST);
    }
    if (found == 0) {
        fprintf(stderr, "squeal: nothing in the list holds the text\n");
    }
    return found > 0 ? EXIT_OK : EXIT_FAILED;
}

int command_list(const struct arguments *arguments)
{
    struct device *device = NULL;

    if (!arguments_has_operands(arguments, 0, 1)) {
        return EXIT_USAGE;
    }
    int code = linked_open(arguments, &device);
    if (code == EXIT_OK) {
        code = list_rows(device, arguments_flag(arguments, "--signals") ? DEVICE_SIGNALS : DEVICE_PARAMS,
                         arguments->operand_count > 0 ? arguments->operands[0] : NULL);
    }
    device_close(device);
    return code;
}

/* Prints one value; the table's row tells how. */
static int get_one(struct device *device, const char *name, bool is_signal, bool is_bare)
{
    const enum device_table table = is_signal ? DEVICE_SIGNALS : DEVICE_PARAMS;
    const int index = device_find(device, table, name);
    char text[DEVICE_TEXT_MAX];
    float value = 0.0f;
    double now = 0.0;

    if (index < 0) {
        return linked_fail_name(device);
    }
    const struct device_row *row = device_row(device, table, (size_t)index);
    const enum device_result result = is_signal ? device_look(device, index, &now) : device_get(device, index, &value);
    if (result != DEVICE_OK) {
        return linked_fail(device, result);
    }
    if (is_signal) {
        linked_format_signal(row, now, text);
    } else {
        device_format(row, value, text);
    }
    if (is_bare) {
        printf("%s\n", text);
    } else {
        printf("%s = %s%s\n", row->symbol, text, linked_unit(row));
    }
    return EXIT_OK;
}

int command_get(const struct arguments *arguments)
{
    struct device *device = NULL;

    if (!arguments_has_operands(arguments, 1, SIZE_MAX)) {
        return EXIT_USAGE;
    }
    int code = linked_open(arguments, &device);
    for (size_t i = 0; i < arguments->operand_count && code == EXIT_OK; i++) {
        code = get_one(device, arguments->operands[i], arguments_flag(arguments, "--now"),
                       arguments_flag(arguments, "--bare"));
    }
    device_close(device);
    return code;
}

static void tell_commit(const struct device_commit *commit)
{
    printf("in force as generation %u, %s\n", commit->generation,
           commit->was_reset ? "back at step 0" : "the plant goes on");
}

static int set_all(const struct arguments *arguments, struct device *device, struct device_value *values)
{
    const size_t count = arguments->operand_count;
    struct device_commit commit;
    const int code = linked_read_values(device, arguments->operands, count, values);

    if (code != EXIT_OK) {
        return code;
    }
    const enum device_result result =
        device_set(device, values, count, NULL, !arguments_flag(arguments, "--live"), &commit);
    if (result != DEVICE_OK) {
        return linked_fail(device, result);
    }
    tell_commit(&commit);
    return EXIT_OK;
}

int command_set(const struct arguments *arguments)
{
    struct device_value *values = calloc(arguments->operand_count + 1, sizeof *values);
    struct device *device = NULL;
    int code = EXIT_USAGE;

    if (values != NULL && arguments_has_operands(arguments, 1, SIZE_MAX)) {
        code = linked_open(arguments, &device);
        code = code == EXIT_OK ? set_all(arguments, device, values) : code;
    }
    free(values);
    device_close(device);
    return code;
}

/* Prints a table as a file would hold it, or puts a file's into force. */
static int table_of(const struct arguments *arguments, struct device *device, enum params_table_index index)
{
    struct params_points table;
    struct device_tables tables = {{NULL}};
    struct device_commit commit;
    char problem[CSV_PROBLEM_MAX];

    if (arguments->operand_count == 1) {
        const enum device_result result = device_get_table(device, index, &table);
        if (result == DEVICE_OK) {
            table_file_write(stdout, index, &table);
        }
        return result == DEVICE_OK ? EXIT_OK : linked_fail(device, result);
    }
    if (!table_file_read(arguments->operands[1], index, &table, problem)) {
        (void)fflush(stdout);
        fprintf(stderr, "squeal: %s\n", problem);
        return EXIT_FAILED;
    }
    tables.table[index] = &table;
    const enum device_result result = device_set(device, NULL, 0, &tables, true, &commit);
    if (result != DEVICE_OK) {
        return linked_fail(device, result);
    }
    tell_commit(&commit);
    return EXIT_OK;
}

int command_table(const struct arguments *arguments)
{
    enum params_table_index index = PARAMS_TABLE_LOAD;
    struct device *device = NULL;

    if (!arguments_has_operands(arguments, 1, 2)) {
        return EXIT_USAGE;
    }
    if (!table_file_find(arguments->operands[0], &index)) {
        fprintf(stderr, "squeal: table %.40s: load or speed is wanted\n", arguments->operands[0]);
        return EXIT_USAGE;
    }
    int code = linked_open(arguments, &device);
    code = code == EXIT_OK ? table_of(arguments, device, index) : code;
    device_close(device);
    return code;
}

static int load_preset(struct device *device, const char *name)
{
    struct device_commit commit;
    const int index = device_find(device, DEVICE_PRESETS, name);

    if (index < 0) {
        return linked_fail_name(device);
    }
    const enum device_result result = device_preset(device, index, &commit);
    if (result != DEVICE_OK) {
        return linked_fail(device, result);
    }
    tell_commit(&commit);
    return EXIT_OK;
}

int command_preset(const struct arguments *arguments)
{
    struct device *device = NULL;

    if (!arguments_has_operands(arguments, 0, 1)) {
        return EXIT_USAGE;
    }
    int code = linked_open(arguments, &device);
    if (code == EXIT_OK) {
        code = arguments->operand_count > 0 ? load_preset(device, arguments->operands[0])
                                            : list_rows(device, DEVICE_PRESETS, NULL);
    }
    device_close(device);
    return code;
}
