/* squeal: the host's side of the firmware. It only talks to the console; what a brake does is computed on the device.
 */
#include "squeal/golden/golden.h"
#include "squeal/story/story.h"
#include "squeal/support/children.h"
#include "squeal/support/options.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

static const struct {
    const char *name;
    int (*run)(int argc, char **argv);
} subcommands[] = {{"golden", golden_main}, {"demo", story_main}};

static const char help[] = "usage: squeal golden --cases IN.csv --out OUT [options] -- FIRMWARE...\n"
                           "       squeal demo --board NAME --out DIRECTORY [options] -- FIRMWARE...\n"
                           "\n"
                           "FIRMWARE... is the command line that starts a firmware with its console on standard\n"
                           "input and output: a host build, or an emulator with its image.\n"
                           "\n"
                           "golden  runs every case of a table and compares it with the table's reference columns\n"
                           "  --out OUT        a CSV file, or a folder for one that is called like the table\n"
                           "  --spp N          model steps per normal period (64)\n"
                           "  --normal M       exact or rk4 (rk4)\n"
                           "  --method M       event or naive, which goes with rk4 only (event)\n"
                           "  --arith A        number format of the plant (f32)\n"
                           "  --asymptotic     also run to the attractor; compares size, frequency and verdict\n"
                           "  --jobs J         firmware processes at a time (2)\n"
                           "  --limit S        seconds that one answer may take (600)\n"
                           "\n"
                           "demo    has the device tell its story; writes samples, pictures, sound and a record\n"
                           "  --board NAME     name of the board, for the record\n"
                           "  --acts LIST      acts to run, such as 2 or 1,3,5 (1,2,3,4,5)\n"
                           "  --points N       points of the map along each axis; 0 for no map (20)\n"
                           "  --limit S        seconds that one answer may take (600)\n"
                           "\n"
                           "examples:\n"
                           "  squeal golden --cases tests/golden/paper.csv --out paper.csv -- build/host/squeal\n"
                           "  squeal demo --board host --out build/host/run -- build/host/squeal\n"
                           "\n"
                           "exit codes: 0 all went well, 1 something failed or differed, 2 the command line is wrong\n";

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

int main(int argc, char **argv)
{
    if (argc == 2 && (strcmp(argv[1], "--help") == 0 || strcmp(argv[1], "-h") == 0 || strcmp(argv[1], "help") == 0)) {
        (void)fputs(help, stdout);
        return output_check(EXIT_OK);
    }
    children_guard();
    for (size_t i = 0; argc >= 2 && i < sizeof subcommands / sizeof subcommands[0]; i++) {
        if (strcmp(argv[1], subcommands[i].name) == 0) {
            return output_check(subcommands[i].run(argc - 2, argv + 2));
        }
    }
    fprintf(stderr,
            argc < 2 ? "squeal: which subcommand? --help lists them%s\n"
                     : "squeal: no subcommand '%s'; --help lists them\n",
            argc < 2 ? "" : argv[1]);
    return EXIT_USAGE;
}
