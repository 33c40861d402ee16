/* merit: how good is the detector on cases that nobody has looked at?
 *   merit cases --count n --seed n --out cases.csv
 *   merit check --truth truth.csv --disagree out.csv --arith "f32 q27" --jobs n
 * The first draws the cases, the oracle works out their truth, the second runs the firmware's own code on them, prints
 * the table and writes down each row on which the two disagree. Exit code 1 if a figure is not what it must be. */
#include <stdlib.h>
#include <string.h>

#include "base/assert.h"
#include "jobs.h"
#include "table.h"

struct options {
    const char *out, *truth, *disagree, *arith;
    long count, jobs;
    unsigned long long seed;
};

struct check {
    struct csv cases;
    struct truth *truth;
    struct run *run;
    struct judgement *judgement;
    int arith; /* at work */
};

static const char *const arith_names[] = {[ARITH_F32] = "f32", [ARITH_Q27] = "q27"};

void base_assert_failed(const char *file, unsigned line)
{
    (void)fprintf(stderr, "merit: %s:%u: assertion failed\n", file, line);
    exit(3);
}

static int complain(const char *what, const char *detail)
{
    (void)fprintf(stderr, "merit: %s%s\n", what, detail);
    return 2;
}

static bool parse(int count, char **word, struct options *options)
{
    *options = (struct options){.arith = "f32 q27", .jobs = 1};
    for (int i = 2; i < count; i += 2) {
        const char *value = i + 1 < count ? word[i + 1] : NULL;

        if (value == NULL) {
            return false;
        }
        if (strcmp(word[i], "--count") == 0) {
            options->count = strtol(value, NULL, 10);
        } else if (strcmp(word[i], "--seed") == 0) {
            options->seed = strtoull(value, NULL, 10);
        } else if (strcmp(word[i], "--out") == 0) {
            options->out = value;
        } else if (strcmp(word[i], "--truth") == 0) {
            options->truth = value;
        } else if (strcmp(word[i], "--disagree") == 0) {
            options->disagree = value;
        } else if (strcmp(word[i], "--arith") == 0) {
            options->arith = value;
        } else if (strcmp(word[i], "--jobs") == 0) {
            options->jobs = strtol(value, NULL, 10);
        } else {
            return false;
        }
    }
    return options->jobs >= 1 && options->jobs <= JOBS_MAX;
}

static int make_cases(const struct options *options)
{
    char problem[CSV_PROBLEM_MAX];
    FILE *file = csv_create(options->out, problem);
    long refused;

    if (file == NULL) {
        return complain(problem, "");
    }
    refused = draw_table(file, options->count, options->seed);
    if (!csv_close(file, options->out, problem)) {
        return complain(problem, "");
    }
    printf("%ld random cases of seed %llu; %ld sets that the firmware refuses were drawn again\n", options->count,
           options->seed, refused);
    return 0;
}

static void work(const void *context, size_t row, void *record)
{
    const struct check *check = context;
    const struct set set = set_of_row(&check->cases, row);

    *(struct run *)record = run_row(&set, check->arith);
}

/* Appends the rows on which this arithmetic disagrees, with all their columns. */
static void write_disagreements(const struct check *check, FILE *file)
{
    for (size_t row = 0; row < check->cases.rows; row++) {
        const struct run *run = &check->run[row];

        for (int fault = 0; fault < JUDGE_FAULTS; fault++) {
            if (!check->judgement[row].has[fault]) {
                continue;
            }
            for (size_t column = 0; column < check->cases.columns; column++) {
                (void)fprintf(file, "%s,", csv_cell(&check->cases, row, (int)column));
            }
            (void)fprintf(file, "%s,%s,%s,%s,%u,%s\n", judge_fault_names[fault], arith_names[check->arith],
                          detector_propensity_name(run->propensity), detector_class_name(run->motion), run->period,
                          predictor_verdict_name((enum predictor_verdict)run->predicted));
        }
    }
}

static void write_header(const struct check *check, FILE *file)
{
    for (size_t column = 0; column < check->cases.columns; column++) {
        (void)fprintf(file, "%s,", check->cases.cells[column]);
    }
    (void)fputs("why,arithmetic,verdict,called,called_p,predicted\n", file);
}

/* Runs all rows in one arithmetic. */
static int check_arith(struct check *check, const struct options *options, FILE *file)
{
    const char *name = arith_names[check->arith];
    const struct jobs jobs = {name, options->jobs, check->cases.rows, sizeof *check->run, work, check};
    const struct table table = {name, &check->cases, check->truth, check->run, check->judgement};

    if (!jobs_run(&jobs, check->run)) {
        return complain("a process failed", "");
    }
    for (size_t row = 0; row < check->cases.rows; row++) {
        check->judgement[row] = judge_row(&check->truth[row], &check->run[row]);
    }
    write_disagreements(check, file);
    return table_print(&table) ? 0 : 1;
}

static int check_all(struct check *check, const struct options *options, FILE *file)
{
    char problem[CSV_PROBLEM_MAX];
    int status = 0;

    for (size_t row = 0; row < check->cases.rows; row++) {
        if (!truth_of_row(&check->cases, row, &check->truth[row], problem)) {
            return complain(problem, "");
        }
    }
    table_print_truth(check->truth, check->cases.rows);
    write_header(check, file);
    for (check->arith = ARITH_F32; check->arith <= ARITH_Q27; check->arith++) {
        if (strstr(options->arith, arith_names[check->arith]) != NULL) {
            const int result = check_arith(check, options, file);

            status = result > status ? result : status;
        }
    }
    return status;
}

static int check_cases(const struct options *options)
{
    char problem[CSV_PROBLEM_MAX];
    struct check check;
    FILE *file;
    int status = 2;

    if (!csv_read(&check.cases, options->truth, problem)) {
        return complain(problem, "");
    }
    check.truth = calloc(check.cases.rows, sizeof *check.truth);
    check.run = calloc(check.cases.rows, sizeof *check.run);
    check.judgement = calloc(check.cases.rows, sizeof *check.judgement);
    file = csv_create(options->disagree, problem);
    if (check.truth == NULL || check.run == NULL || check.judgement == NULL || file == NULL) {
        return complain(file == NULL ? problem : "out of memory", "");
    }
    status = check_all(&check, options, file);
    if (!csv_close(file, options->disagree, problem)) {
        status = complain(problem, "");
    }
    free(check.truth);
    free(check.run);
    free(check.judgement);
    csv_free(&check.cases);
    return status;
}

int main(int count, char **word)
{
    struct options options;

    if (parse(count, word, &options) && count > 1) {
        if (strcmp(word[1], "cases") == 0 && options.out != NULL && options.count > 0) {
            return make_cases(&options);
        }
        if (strcmp(word[1], "check") == 0 && options.truth != NULL && options.disagree != NULL) {
            return check_cases(&options);
        }
    }
    (void)fputs("use: merit cases --count n --seed n --out cases.csv\n"
                "     merit check --truth truth.csv --disagree out.csv [--arith \"f32 q27\"] [--jobs n]\n",
                stderr);
    return 2;
}
