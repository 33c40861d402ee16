/* The words of a command line behind the subcommand: options of its rows in subcommands.def, --name value or
 * --name=value, operands between them, and behind -- the command line of a firmware. */
#ifndef SQUEAL_ARGUMENTS_H
#define SQUEAL_ARGUMENTS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct subcommand;

enum { ARGUMENTS_OPTIONS_MAX = 24 };

struct arguments {
    const struct subcommand *subcommand;
    char **operands;
    size_t operand_count;
    char **firmware; /* ended by NULL; NULL: no -- was there */
    bool wants_help;
    const char *options[ARGUMENTS_OPTIONS_MAX]; /* by row of the subcommand: the value, "" of a flag, NULL: not given */
};

/* Sorts argv[0..argc), which is reordered. False: the mistake has been printed, and the caller returns EXIT_USAGE, as
 * it does wherever one of the functions below says false. */
bool arguments_read(struct arguments *arguments, const struct subcommand *subcommand, int argc, char **argv);

/* An option's value, NULL if it was not given; whether a flag was given. The name must be one of the subcommand's. */
const char *arguments_text(const struct arguments *arguments, const char *name);
bool arguments_flag(const struct arguments *arguments, const char *name);

/* A number within low..high; *value stays as it was where the option was not given. */
bool arguments_whole(const struct arguments *arguments, const char *name, uint64_t low, uint64_t high, uint64_t *value);
bool arguments_real(const struct arguments *arguments, const char *name, double low, double high, double *value);

/* The same for a text of the given name. */
bool arguments_parse_whole(const char *name, const char *text, uint64_t low, uint64_t high, uint64_t *value);

/* Are there as many operands as that? */
bool arguments_has_operands(const struct arguments *arguments, size_t least, size_t most);

/* The option that must be given; NULL as false. */
const char *arguments_need(const struct arguments *arguments, const char *name);

#endif
