/* The table, its help, and what the shell may complete. */
#include "squeal/subcommands.h"

#include "model/params.h"
#include "model/presets.h"
#include "squeal/exits.h"
#include "squeal/port/boards.h"
#include "squeal/port/port.h"
#include "squeal/support/arguments.h"

#include <stdio.h>
#include <string.h>

enum { PORTS_SIZE = 1024 };

/* The rows in their order. An option or example belongs to the subcommand above it. */
static const struct row {
    enum { ROW_SUBCOMMAND, ROW_OPTION, ROW_EXAMPLE } kind;
    const char *name;
    struct option option;
} rows[] = {
#define SUBCOMMAND(name, operands, help) {ROW_SUBCOMMAND, #name, {0}},
#define LINKED                                                                \
    OPTION("--port", "PORT", "where the device is; SQUEAL_PORT unless given") \
    OPTION("--limit", "S", "seconds that one answer may take (5)")
#define OPTION(name, value, help) {ROW_OPTION, name, {name, value, help}},
#define EXAMPLE(text) {ROW_EXAMPLE, text, {0}},
#include "squeal/subcommands.def"
#undef SUBCOMMAND
#undef LINKED
#undef OPTION
#undef EXAMPLE
};

const struct subcommand subcommands[] = {
#define SUBCOMMAND(name, operands, help) {#name, operands, help, command_##name},
#define LINKED
#define OPTION(name, value, help)
#define EXAMPLE(text)
#include "squeal/subcommands.def"
#undef SUBCOMMAND
#undef LINKED
#undef OPTION
#undef EXAMPLE
};
const size_t subcommands_count = sizeof subcommands / sizeof subcommands[0];

static const char exits[] = "exit codes: 0 all went well, 1 something failed or differs, 2 the command line is wrong,\n"
                            "  3 trouble with the port, 4 the device refused\n";

const struct subcommand *subcommands_find(const char *name)
{
    for (size_t i = 0; i < subcommands_count; i++) {
        if (strcmp(subcommands[i].name, name) == 0) {
            return &subcommands[i];
        }
    }
    return NULL;
}

/* The index-th row of that kind below the subcommand, or NULL. */
static const struct row *row_of(const struct subcommand *subcommand, int kind, size_t index)
{
    const struct row *row = rows;

    while (row->kind != ROW_SUBCOMMAND || strcmp(row->name, subcommand->name) != 0) {
        row++;
    }
    for (row++; row < rows + sizeof rows / sizeof rows[0] && row->kind != ROW_SUBCOMMAND; row++) {
        if ((int)row->kind == kind && index-- == 0) {
            return row;
        }
    }
    return NULL;
}

const struct option *subcommands_option(const struct subcommand *subcommand, size_t index)
{
    const struct row *row = row_of(subcommand, ROW_OPTION, index);

    return row != NULL ? &row->option : NULL;
}

const struct option *subcommands_find_option(const struct subcommand *subcommand, const char *name)
{
    const struct option *option;

    for (size_t i = 0; (option = subcommands_option(subcommand, i)) != NULL; i++) {
        if (strcmp(option->name, name) == 0) {
            return option;
        }
    }
    return NULL;
}

void subcommands_help(void)
{
    static const char *const shown[] = {"get", "record", "replay", "demo"}; /* examples of these */

    printf("usage: squeal SUBCOMMAND ... [--port PORT]\n\n");
    for (size_t i = 0; i < subcommands_count; i++) {
        printf("  %-10s %s\n", subcommands[i].name, subcommands[i].help);
    }
    printf("\nports:\n%s\nsqueal SUBCOMMAND --help tells more\n\nexamples:\n", port_help);
    for (size_t i = 0; i < sizeof shown / sizeof shown[0]; i++) {
        printf("  %s\n", row_of(subcommands_find(shown[i]), ROW_EXAMPLE, 0)->name);
    }
    printf("\n%s", exits);
}

void subcommands_help_one(const struct subcommand *subcommand)
{
    const struct option *option;
    const struct row *row;
    char both[64];

    printf("usage: squeal %s%s%s [OPTIONS]\n%s\n", subcommand->name, subcommand->operands[0] != '\0' ? " " : "",
           subcommand->operands, subcommand->help);
    for (size_t i = 0; (option = subcommands_option(subcommand, i)) != NULL; i++) {
        (void)snprintf(both, sizeof both, "%s%s%s", option->name, option->value != NULL ? " " : "",
                       option->value != NULL ? option->value : "");
        printf("%s  %-18s %s\n", i == 0 ? "\noptions:\n" : "", both, option->help);
    }
    if (subcommands_find_option(subcommand, "--port") != NULL) {
        printf("\nports:\n%s", port_help);
    }
    for (size_t i = 0; (row = row_of(subcommand, ROW_EXAMPLE, i)) != NULL; i++) {
        printf("%s  %s\n", i == 0 ? "\nexamples:\n" : "", row->name);
    }
    printf("\n%s", exits);
}

/* Names that an operand may be, as far as this program knows them without asking a device. */
static void operand_words(const struct subcommand *subcommand)
{
    const bool is_assignment = strstr(subcommand->operands, "NAME=VALUE") != NULL;

    for (size_t i = 0; strcmp(subcommand->operands, "[NAME]") == 0 && i < presets_count; i++) {
        printf("%s\n", presets_table[i].name);
    }
    for (size_t i = 0; (is_assignment || strcmp(subcommand->operands, "NAME...") == 0) && i < params_count; i++) {
        printf("%s%s\n", params_table[i].symbol, is_assignment ? "=" : "");
    }
}

int command_words(const struct arguments *arguments)
{
    const char *first = arguments->operand_count > 0 ? arguments->operands[0] : "";
    const struct subcommand *subcommand = subcommands_find(first);
    const struct option *option;
    char ports[PORTS_SIZE];

    if (strcmp(first, "port") == 0) {
        boards_ports(ports, sizeof ports);
        printf("pty unix: tcp:%s\n", ports);
        return EXIT_OK;
    }
    for (size_t i = 0; subcommand == NULL && i < subcommands_count; i++) {
        printf("%s\n", subcommands[i].name);
    }
    for (size_t i = 0; subcommand != NULL && (option = subcommands_option(subcommand, i)) != NULL; i++) {
        printf("%s\n", option->name);
    }
    if (subcommand != NULL) {
        operand_words(subcommand);
    }
    printf("--help\n");
    return EXIT_OK;
}
