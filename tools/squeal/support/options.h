/* Command-line options of a subcommand: --name value, or --name alone, then -- and the firmware's command line. */
#ifndef SQUEAL_OPTIONS_H
#define SQUEAL_OPTIONS_H

#include <stdbool.h>
#include <stddef.h>

enum { EXIT_OK = 0, EXIT_FAILED = 1, EXIT_USAGE = 2 };

struct option {
    const char *name;
    const char **text; /* takes a value; NULL for a flag */
    bool *flag;
    bool is_required;
};

/* Reads argv[0..argc) into the options' places. Returns the firmware's command line, ended by NULL; on NULL the mistake
 * has been printed and the caller returns EXIT_USAGE. */
char **options_read(const struct option *options, size_t count, int argc, char **argv);

/* Reads text as a whole number within low..high; prints the mistake and returns false otherwise. */
bool options_whole(const char *name, const char *text, long low, long high, long *value);

#endif
