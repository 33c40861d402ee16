/* The table of subcommands. */
#ifndef SQUEAL_SUBCOMMANDS_H
#define SQUEAL_SUBCOMMANDS_H

#include <stdbool.h>
#include <stddef.h>

struct arguments;

/* One for each row of subcommands.def. Returns an exit code (exits.h). */
#define SUBCOMMAND(name, operands, help) int command_##name(const struct arguments *arguments);
#define LINKED
#define OPTION(name, value, help)
#define EXAMPLE(text)
#include "squeal/subcommands.def"
#undef SUBCOMMAND
#undef LINKED
#undef OPTION
#undef EXAMPLE

struct option {
    const char *name;
    const char *value; /* what follows it, for a help text; NULL: a flag */
    const char *help;
};

struct subcommand {
    const char *name, *operands, *help;
    int (*run)(const struct arguments *arguments);
};

extern const struct subcommand subcommands[];
extern const size_t subcommands_count;

/* NULL if none has this name. */
const struct subcommand *subcommands_find(const char *name);

/* The options of a subcommand, those of LINKED among them; NULL beyond the last. */
const struct option *subcommands_option(const struct subcommand *subcommand, size_t index);

/* The option of that name, or NULL. */
const struct option *subcommands_find_option(const struct subcommand *subcommand, const char *name);

/* Help texts on standard output: of all, or of one. */
void subcommands_help(void);
void subcommands_help_one(const struct subcommand *subcommand);

#endif
