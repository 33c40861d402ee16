/* Command-line options. */
#include "squeal/support/arguments.h"

#include "base/assert.h"
#include "base/decimal.h"
#include "squeal/subcommands.h"
#include "squeal/support/fields.h"
#include "squeal/support/printable.h"

#include <stdio.h>
#include <string.h>

enum { SHOWN_SIZE = 96 };

static const char *shown(const char *text)
{
    static char out[SHOWN_SIZE];

    return printable_copy(out, sizeof out, text);
}

/* Takes one option at argv[i]. Returns how many words it took, 0 on a mistake. */
static int option_take(struct arguments *arguments, int i, int argc, char **argv)
{
    const char *word = argv[i];
    const size_t length = strcspn(word, "=");
    const struct option *option;
    size_t row = 0;

    while ((option = subcommands_option(arguments->subcommand, row)) != NULL &&
           (strlen(option->name) != length || strncmp(option->name, word, length) != 0)) {
        row++;
    }
    if (option == NULL) {
        fprintf(stderr, "squeal: %s has no option %s; squeal %s --help lists them\n", arguments->subcommand->name,
                shown(word), arguments->subcommand->name);
        return 0;
    }
    BASE_ASSERT(row < ARGUMENTS_OPTIONS_MAX);
    const bool has_value = word[length] == '=';
    if (option->value == NULL && has_value) {
        fprintf(stderr, "squeal: %s takes no value\n", option->name);
        return 0;
    }
    if (option->value != NULL && !has_value && (i + 1 >= argc || strcmp(argv[i + 1], "--") == 0)) {
        fprintf(stderr, "squeal: %s needs a value, %s\n", option->name, option->value);
        return 0;
    }
    arguments->options[row] = option->value == NULL ? "" : has_value ? word + length + 1 : argv[i + 1];
    return option->value == NULL || has_value ? 1 : 2;
}

bool arguments_read(struct arguments *arguments, const struct subcommand *subcommand, int argc, char **argv)
{
    int taken = 1;

    *arguments = (struct arguments){.subcommand = subcommand, .operands = argv};
    for (int i = 0; i < argc; i += taken) {
        taken = 1;
        if (strcmp(argv[i], "--") == 0) {
            arguments->firmware = argv + i + 1;
            break;
        }
        if (strcmp(argv[i], "--help") == 0 || strcmp(argv[i], "-h") == 0) {
            arguments->wants_help = true;
        } else if (argv[i][0] == '-' && argv[i][1] == '-') {
            taken = option_take(arguments, i, argc, argv);
            if (taken == 0) {
                return false;
            }
        } else {
            arguments->operands[arguments->operand_count++] = argv[i];
        }
    }
    if (arguments->wants_help || (strstr(subcommand->operands, "--") != NULL) == (arguments->firmware != NULL)) {
        return true;
    }
    fprintf(stderr,
            arguments->firmware == NULL ? "squeal: the firmware's command line is missing after --\n"
                                        : "squeal: %s starts no firmware, -- has no place here\n",
            subcommand->name);
    return false;
}

static size_t row_of(const struct arguments *arguments, const char *name)
{
    const struct option *option;
    size_t row = 0;

    while ((option = subcommands_option(arguments->subcommand, row)) != NULL && strcmp(option->name, name) != 0) {
        row++;
    }
    BASE_ASSERT(option != NULL);
    return row;
}

const char *arguments_text(const struct arguments *arguments, const char *name)
{
    return arguments->options[row_of(arguments, name)];
}

bool arguments_flag(const struct arguments *arguments, const char *name)
{
    return arguments_text(arguments, name) != NULL;
}

const char *arguments_need(const struct arguments *arguments, const char *name)
{
    const char *text = arguments_text(arguments, name);

    if (text == NULL) {
        fprintf(stderr, "squeal: %s is missing; squeal %s --help tells more\n", name, arguments->subcommand->name);
    }
    return text;
}

bool arguments_parse_whole(const char *name, const char *text, uint64_t low, uint64_t high, uint64_t *value)
{
    uint64_t parsed;

    if (!decimal_parse_u64(text, strlen(text), &parsed) || parsed < low || parsed > high) {
        fprintf(stderr, "squeal: %s %s: a whole number from %llu to %llu is wanted\n", name, shown(text),
                (unsigned long long)low, (unsigned long long)high);
        return false;
    }
    *value = parsed;
    return true;
}

bool arguments_whole(const struct arguments *arguments, const char *name, uint64_t low, uint64_t high, uint64_t *value)
{
    const char *text = arguments_text(arguments, name);

    return text == NULL || arguments_parse_whole(name, text, low, high, value);
}

bool arguments_real(const struct arguments *arguments, const char *name, double low, double high, double *value)
{
    const char *text = arguments_text(arguments, name);
    double parsed;

    if (text == NULL) {
        return true;
    }
    if (!fields_parse(text, &parsed) || !(parsed >= low && parsed <= high)) {
        fprintf(stderr, "squeal: %s %s: a number from %g to %g is wanted\n", name, shown(text), low, high);
        return false;
    }
    *value = parsed;
    return true;
}

bool arguments_has_operands(const struct arguments *arguments, size_t least, size_t most)
{
    if (arguments->operand_count >= least && arguments->operand_count <= most) {
        return true;
    }
    fprintf(stderr, "squeal: %s takes %s; squeal %s --help tells more\n", arguments->subcommand->name,
            most == 0 ? "options only" : arguments->subcommand->operands, arguments->subcommand->name);
    return false;
}
