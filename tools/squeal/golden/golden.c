/* The subcommand golden: options, the table that is written, the closing line. */
#include "squeal/golden/golden.h"

#include "squeal/exits.h"
#include "squeal/subcommands.h"
#include "squeal/support/arguments.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum { JOBS_MAX = 16, SPP_MAX = 1024, LIMIT_MAX_S = 86400, PATH_SIZE = 512 };

const char *const golden_names[GOLDEN_COLUMNS] = {
    "x_20",    "v_20",      "xmax_20", "xmin_20", "vmax_20",  "vmin_20", "stick_20",
    "x_100",   "v_100",     "xpp",     "stick",   "f_up",     "class",   "period",
    "verdict", "predicted", "t_v10",   "steps",   "overruns", "caps",    "saturations",
};

/* Without these a row says too little to be run. */
static const char *const needed[] = {"case", "m", "c", "v0", "mus", "alpha", "ke", "kt", "k", "N0"};

static bool has_columns(const struct golden_plan *plan, const char *path)
{
    for (size_t i = 0; i < sizeof needed / sizeof needed[0]; i++) {
        if (csv_column(&plan->cases, needed[i]) < 0) {
            fprintf(stderr, "squeal: %s: no column %s\n", path, needed[i]);
            return false;
        }
    }
    if (plan->is_asymptotic && (csv_column(&plan->cases, "ntrans") < 0 || csv_column(&plan->cases, "nwin") < 0)) {
        fprintf(stderr, "squeal: %s: --asymptotic needs the columns ntrans and nwin\n", path);
        return false;
    }
    return true;
}

/* Where the results go: into the file of that name, or, if it is no CSV file but a folder, into a file there that is
 * called like the table. A folder that does not exist is made. */
static const char *out_path(const char *out, const char *cases, char path[PATH_SIZE])
{
    const char *slash = strrchr(cases, '/');
    const char *suffix = strrchr(out, '.');
    struct stat status;
    const bool exists = stat(out, &status) == 0;

    if ((exists && !S_ISDIR(status.st_mode)) || (!exists && suffix != NULL && strcmp(suffix, ".csv") == 0)) {
        return out;
    }
    /* What is wrong with the folder shows when the file is created in it. */
    (void)mkdir(out, 0777);
    (void)snprintf(path, PATH_SIZE, "%s/%s", out, slash == NULL ? cases : slash + 1);
    return path;
}

static void results_write(const struct golden_plan *plan, const struct golden_result *results, FILE *file)
{
    const int name = csv_column(&plan->cases, "case");

    (void)fputs("case", file);
    for (int column = 0; column < GOLDEN_COLUMNS; column++) {
        (void)fprintf(file, ",%s", golden_names[column]);
    }
    for (size_t row = 0; row < plan->cases.rows; row++) {
        (void)fprintf(file, "\n%s", csv_cell(&plan->cases, row, name));
        for (int column = 0; column < GOLDEN_COLUMNS; column++) {
            (void)fprintf(file, ",%s", results[row].cells[column]);
        }
    }
    (void)fputc('\n', file);
}

/* The file is opened before the first case is run: hours of work are not lost to a wrong path. The closing line says
 * that it is written, too. */
static int plan_run(const struct golden_plan *plan, const char *path)
{
    char problem[CSV_PROBLEM_MAX] = "out of memory";
    struct golden_result *results = calloc(plan->cases.rows, sizeof *results);
    FILE *file = results == NULL ? NULL : csv_create(path, problem);
    struct golden_score score = {0};

    if (file != NULL) {
        golden_jobs_run(plan, results);
        score = golden_check(plan, results);
        results_write(plan, results, file);
    }
    free(results);
    if (file == NULL || !csv_close(file, path, problem)) {
        fprintf(stderr, "squeal: %s\n", problem);
        return EXIT_FAILED;
    }
    printf("%zu passed, %zu failed\n", score.passed, score.failed);
    return score.failed == 0 ? EXIT_OK : EXIT_FAILED;
}

static const char *text_or(const struct arguments *arguments, const char *name, const char *standard)
{
    const char *text = arguments_text(arguments, name);

    return text != NULL ? text : standard;
}

int command_golden(const struct arguments *arguments)
{
    struct golden_plan plan = {.command = arguments->firmware,
                               .spp = text_or(arguments, "--spp", "64"),
                               .normal = text_or(arguments, "--normal", "rk4"),
                               .method = text_or(arguments, "--method", "event"),
                               .arith = text_or(arguments, "--arith", "f32"),
                               .is_asymptotic = arguments_flag(arguments, "--asymptotic")};
    char problem[CSV_PROBLEM_MAX], path[PATH_SIZE];
    const char *cases = arguments_need(arguments, "--cases");
    const char *out = cases != NULL ? arguments_need(arguments, "--out") : NULL;
    uint64_t limit_s = 600, jobs = 2, spp = 0;

    if (out == NULL || !arguments_has_operands(arguments, 0, 0) ||
        !arguments_parse_whole("--spp", plan.spp, 1, SPP_MAX, &spp) ||
        !arguments_whole(arguments, "--jobs", 1, JOBS_MAX, &jobs) ||
        !arguments_whole(arguments, "--limit", 1, LIMIT_MAX_S, &limit_s)) {
        return EXIT_USAGE;
    }
    plan.jobs = (long)jobs;
    plan.steps_per_period = (long)spp;
    plan.limit_s = (double)limit_s;
    if (!csv_read(&plan.cases, cases, problem)) {
        fprintf(stderr, "squeal: %s\n", problem);
        return EXIT_FAILED;
    }
    int code = EXIT_FAILED;
    if (plan.cases.rows == 0) {
        fprintf(stderr, "squeal: %s: no rows\n", cases);
    } else if (has_columns(&plan, cases)) {
        code = plan_run(&plan, out_path(out, cases, path));
    }
    csv_free(&plan.cases);
    return code;
}
