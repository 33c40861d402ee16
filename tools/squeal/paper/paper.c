/* The subcommand paper: options, the experiments, the page, and what is to be said of it. */
#include "squeal/paper/paper.h"

#include "squeal/commands/linked.h"
#include "squeal/paper/lab.h"
#include "squeal/paper/page.h"
#include "squeal/plot/figure.h"
#include "squeal/subcommands.h"
#include "squeal/support/arguments.h"
#include "squeal/support/clock.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#define LIMIT_MAX_S 86400.0

enum { LINE_SIZE = 1024 };

struct experiment paper_experiments[] = {
#define EXPERIMENT(id, title, function) {id, title, experiment_##function, false},
#include "squeal/paper/experiments.def"
#undef EXPERIMENT
};
const size_t paper_experiment_count = sizeof paper_experiments / sizeof paper_experiments[0];

const struct claim paper_claims[] = {
#define CLAIM(id, claim, paper) {id, claim, paper},
#include "squeal/paper/claims.def"
#undef CLAIM
};
const size_t paper_claim_count = sizeof paper_claims / sizeof paper_claims[0];

size_t paper_claim_find(const char *id)
{
    size_t place = 0;

    while (place < paper_claim_count && strcmp(paper_claims[place].id, id) != 0) {
        place++;
    }
    return place;
}

const char *paper_verdict_name(enum paper_verdict verdict)
{
    static const char *const names[] = {"holds", "in part", "refuted", "not judged"};

    return names[verdict <= PAPER_NOT_JUDGED ? verdict : PAPER_NOT_JUDGED];
}

/* --- Options ------------------------------------------------------------------------------------------------------ */

static const char *text_or(const struct arguments *arguments, const char *name, const char *standard)
{
    const char *text = arguments_text(arguments, name);

    return text != NULL ? text : standard;
}

/* Marks the experiments of "fig5,fig7", or all. False: the mistake has been printed. */
static bool want_experiments(const char *list)
{
    for (size_t i = 0; i < paper_experiment_count; i++) {
        paper_experiments[i].is_wanted = list == NULL;
    }
    for (const char *at = list; at != NULL && *at != '\0'; at += *at == ',' ? 1 : 0) {
        const size_t length = strcspn(at, ",");
        size_t i = 0;
        while (i < paper_experiment_count &&
               (strlen(paper_experiments[i].id) != length || strncmp(paper_experiments[i].id, at, length) != 0)) {
            i++;
        }
        if (i == paper_experiment_count) {
            fprintf(stderr, "squeal: --only: no experiment '%.*s'; there are", (int)length, at);
            for (size_t j = 0; j < paper_experiment_count; j++) {
                fprintf(stderr, " %s", paper_experiments[j].id);
            }
            fputc('\n', stderr);
            return false;
        }
        paper_experiments[i].is_wanted = true;
        at += length;
    }
    return true;
}

/* Can be opened as often as one likes: each time another firmware is started. */
static bool is_started_here(const char *port)
{
    return strcmp(port, "host") == 0 || strncmp(port, "qemu:", strlen("qemu:")) == 0;
}

static bool read_options(const struct arguments *arguments, struct paper_options *options)
{
    const char *port = text_or(arguments, "--port", getenv("SQUEAL_PORT"));

    options->port = port != NULL ? port : ""; /* that there is none is told when it is opened */
    options->method = text_or(arguments, "--method", "event");
    /* The naive method goes with all four states by RK4 only. */
    options->normal = text_or(arguments, "--normal", strcmp(options->method, "naive") == 0 ? "rk4" : "exact");
    options->arith = text_or(arguments, "--arith", "f32");
    options->spp = text_or(arguments, "--spp", "64");
    options->is_small = arguments_flag(arguments, "--small");
    options->is_part = arguments_text(arguments, "--only") != NULL;
    options->limit_s = 5.0;
    uint64_t jobs = is_started_here(options->port) ? 2 : 1;
    options->out = arguments_need(arguments, "--out");
    if (options->out == NULL || !arguments_has_operands(arguments, 0, 0) ||
        !arguments_whole(arguments, "--jobs", 1, PAPER_JOBS_MAX, &jobs) ||
        !arguments_real(arguments, "--limit", 0.1, LIMIT_MAX_S, &options->limit_s) ||
        !want_experiments(arguments_text(arguments, "--only"))) {
        return false;
    }
    if (jobs > 1 && !is_started_here(options->port)) {
        fprintf(stderr, "squeal: --jobs %u: there is but one device at %.80s\n", (unsigned)jobs, options->port);
        return false;
    }
    options->jobs = (unsigned)jobs;
    return true;
}

/* The command line as it would be typed. */
static void write_line(const struct arguments *arguments, char line[LINE_SIZE])
{
    const struct option *option;

    (void)snprintf(line, LINE_SIZE, "squeal paper");
    for (size_t i = 0; (option = subcommands_option(arguments->subcommand, i)) != NULL; i++) {
        const char *value = arguments->options[i];
        const size_t used = strlen(line);
        /* How many at a time changes nothing. */
        if (value != NULL && strcmp(option->name, "--jobs") != 0) {
            (void)snprintf(line + used, LINE_SIZE - used, value[0] != '\0' ? " %s %s" : " %s", option->name, value);
        }
    }
}

/* --- The course --------------------------------------------------------------------------------------------------- */

static int fail(const char *problem)
{
    (void)fflush(stdout);
    fprintf(stderr, "squeal: %s\n", problem);
    return EXIT_FAILED;
}

/* The folder is made, and shown to take files before anything has taken time. */
static bool prepare_folder(const char *out, char problem[CSV_PROBLEM_MAX])
{
    char path[PAPER_PATH_MAX];

    if (mkdir(out, 0777) != 0 && errno != EEXIST) {
        (void)snprintf(problem, CSV_PROBLEM_MAX, "%.160s: %s", out, strerror(errno));
        return false;
    }
    (void)snprintf(path, sizeof path, "%s/index.html", out);
    FILE *file = csv_create(path, problem);
    return file != NULL && csv_close(file, path, problem);
}

static void tell_off(const struct page *page)
{
    for (size_t i = 0; i < paper_experiment_count; i++) {
        for (const struct record_item *item = page->records[i].items;
             item < page->records[i].items + page->records[i].count; item++) {
            if (item->kind == RECORD_FAILURE) {
                printf("FAILED %s: %s\n", paper_experiments[i].id, item->field[0]);
            } else if (item->kind == RECORD_NUMBER && strcmp(item->field[6], "OFF") == 0) {
                printf("OFF %s: %s, %s: %s %s, reference %s, within %s\n", paper_experiments[i].id, item->field[0],
                       item->field[1], item->field[2], item->field[3], item->field[4], item->field[5]);
            }
        }
    }
}

static int tell(const struct page *page, double took_s)
{
    const struct page_score *score = &page->score;

    tell_off(page);
    printf("numbers   %zu of %zu agree with the reference\n", score->agree, score->agree + score->off);
    printf("claims    %zu hold, %zu in part, %zu refuted, %zu not judged\n", score->claims[PAPER_HOLDS],
           score->claims[PAPER_IN_PART], score->claims[PAPER_REFUTED], score->claims[PAPER_NOT_JUDGED]);
    printf("time      %.0f s\n%s/index.html\n", took_s, page->options->out);
    return score->off == 0 && score->failed == 0 && (page->options->is_part || score->claims[PAPER_NOT_JUDGED] == 0)
               ? EXIT_OK
               : EXIT_FAILED;
}

static int make_page(const struct paper_options *options, struct record *records, FILE *files[])
{
    char problem[CSV_PROBLEM_MAX] = "out of memory";
    struct page page = {.options = options, .records = records};
    const double start_s = clock_now_s();
    int code = EXIT_FAILED;

    page.claims = calloc(paper_claim_count + 1, sizeof *page.claims);
    bool is_well = page.claims != NULL && paper_run(options, files);
    for (size_t i = 0; i < paper_experiment_count && is_well; i++) {
        is_well = files[i] == NULL || record_read(&records[i], files[i]);
    }
    if (is_well) {
        page_gather(&page);
        is_well = page_write(&page, problem);
        code = is_well ? tell(&page, clock_now_s() - start_s) : fail(problem);
    }
    free(page.claims);
    return code;
}

static int run(const struct paper_options *options)
{
    struct record *records = calloc(paper_experiment_count, sizeof *records);
    FILE **files = calloc(paper_experiment_count, sizeof *files);
    int code = EXIT_FAILED;

    if (records != NULL && files != NULL) {
        code = make_page(options, records, files);
    }
    for (size_t i = 0; i < paper_experiment_count && records != NULL && files != NULL; i++) {
        record_free(&records[i]);
        if (files[i] != NULL) {
            (void)fclose(files[i]);
        }
    }
    free(records);
    free(files);
    return code;
}

static int run_with_reference(struct paper_options *options, const char *path)
{
    char problem[CSV_PROBLEM_MAX];
    struct csv reference;

    if (!csv_read(&reference, path, problem)) {
        return fail(problem);
    }
    options->reference = &reference;
    bool is_well = csv_column(&reference, "case") >= 0;
    (void)snprintf(problem, sizeof problem, "%.160s: no column case", path);
    is_well = is_well && prepare_folder(options->out, problem);
    const int code = is_well ? run(options) : fail(problem);
    csv_free(&reference);
    return code;
}

int command_paper(const struct arguments *arguments)
{
    char line[LINE_SIZE];
    struct paper_options options = {0};

    if (!read_options(arguments, &options)) {
        return EXIT_USAGE;
    }
    write_line(arguments, line);
    options.line = line;
    if (!figure_is_possible()) {
        return fail("the pictures need gnuplot; tools/setup tells how to get it");
    }
    /* Whoever is at the port is asked once before everything starts. */
    struct device *device;
    const int code = linked_open(arguments, &device);
    if (code != EXIT_OK) {
        return code;
    }
    device_close(device);
    return run_with_reference(&options, text_or(arguments, "--reference", "tests/golden/paper.csv"));
}
