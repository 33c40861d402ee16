/* squeal: the host's side of the firmware. What a brake does is computed on the device. */
#include "squeal/exits.h"
#include "squeal/subcommands.h"
#include "squeal/support/arguments.h"
#include "squeal/support/children.h"
#include "squeal/support/printable.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

enum { SHOWN_SIZE = 96 };

/* What was printed counts only if it arrived; a full disk behind standard output is a failure too. */
static int output_check(int code)
{
    errno = 0;
    if (fflush(stdout) != 0 || ferror(stdout) != 0) {
        fprintf(stderr, "squeal: standard output: %s\n", strerror(errno != 0 ? errno : EIO));
        return code == EXIT_OK ? EXIT_FAILED : code;
    }
    return code;
}

static bool is_help(const char *word)
{
    return strcmp(word, "--help") == 0 || strcmp(word, "-h") == 0 || strcmp(word, "help") == 0;
}

int main(int argc, char **argv)
{
    struct arguments arguments;
    char shown[SHOWN_SIZE];

    if (argc < 2) {
        fprintf(stderr, "squeal: which subcommand? --help lists them\n");
        return EXIT_USAGE;
    }
    if (is_help(argv[1])) {
        subcommands_help();
        return output_check(EXIT_OK);
    }
    const struct subcommand *subcommand = subcommands_find(argv[1]);
    if (subcommand == NULL) {
        fprintf(stderr, "squeal: no subcommand '%s'; --help lists them\n",
                printable_copy(shown, sizeof shown, argv[1]));
        return EXIT_USAGE;
    }
    if (!arguments_read(&arguments, subcommand, argc - 2, argv + 2)) {
        return EXIT_USAGE;
    }
    if (arguments.wants_help) {
        subcommands_help_one(subcommand);
        return output_check(EXIT_OK);
    }
    children_guard();
    return output_check(subcommand->run(&arguments));
}
