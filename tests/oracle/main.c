/* oracle: the truth about a table of cases.
 *   oracle --cases in.csv --out out.csv [--jobs n] [--horizon periods] [--naive steps-per-period] [--progress seconds]
 * Row i is worked out by process i mod n; their lines come back through pipes, in order. */
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "cases.h"
#include "naive.h"

enum { JOBS_MAX = 64 };

struct options {
    const char *cases, *out;
    long jobs, horizon, naive; /* naive: steps a period, 0 = the series */
    long progress;             /* seconds between two lines about it on stderr, 0 = none */
};

static bool parse(int count, char **word, struct options *options)
{
    *options = (struct options){.jobs = 1, .horizon = LONG_MAX};
    for (int i = 1; i < count; i += 2) {
        const char *value = i + 1 < count ? word[i + 1] : NULL;

        if (value == NULL) {
            return false;
        }
        if (strcmp(word[i], "--cases") == 0) {
            options->cases = value;
        } else if (strcmp(word[i], "--out") == 0) {
            options->out = value;
        } else if (strcmp(word[i], "--jobs") == 0) {
            options->jobs = strtol(value, NULL, 10);
        } else if (strcmp(word[i], "--horizon") == 0) {
            options->horizon = strtol(value, NULL, 10);
        } else if (strcmp(word[i], "--naive") == 0) {
            options->naive = strtol(value, NULL, 10);
        } else if (strcmp(word[i], "--progress") == 0) {
            options->progress = strtol(value, NULL, 10);
        } else {
            return false;
        }
    }
    return options->cases != NULL && options->out != NULL && options->jobs >= 1 && options->jobs <= JOBS_MAX &&
           options->horizon >= 1 && options->naive >= 0 && options->progress >= 0;
}

/* Works out the rows of one job and writes them; with jobs = 1 these are all. */
static int work(const struct options *options, long job, FILE *out)
{
    struct cases_header header;
    struct cases_row row;
    struct result result;
    const char *problem;
    FILE *file = fopen(options->cases, "r");

    if (file == NULL) {
        fprintf(stderr, "oracle: cannot read %s\n", options->cases);
        return 1;
    }
    problem = cases_read_header(file, &header);
    if (problem != NULL) {
        fprintf(stderr, "oracle: %s: column missing: %s\n", options->cases, problem);
        fclose(file);
        return 1;
    }
    for (long i = 0; (problem = cases_read_row(file, &header, &row)) == NULL; i++) {
        if (i % options->jobs != job) {
            continue;
        }
        if (options->naive > 0) {
            naive_solve(&row.plant, options->naive, &result);
        } else if (!solve_case(&row.plant, row.span, options->horizon, &result)) {
            problem = "out of memory";
            break;
        }
        cases_write_row(out, &header, &row, &result);
        fflush(out);
    }
    fclose(file);
    if (*problem != '\0') {
        fprintf(stderr, "oracle: %s: case %s: %s\n", options->cases, row.cell[0], problem);
        return 1;
    }
    return 0;
}

/* Starts one process for a job; its lines come out of the returned stream. */
static FILE *start(const struct options *options, long job)
{
    int end[2];
    pid_t child;

    if (pipe(end) != 0) {
        return NULL;
    }
    fflush(NULL);
    child = fork();
    if (child == 0) {
        FILE *out = fdopen(end[1], "w");
        int status = 1;

        close(end[0]);
        if (out != NULL) {
            status = work(options, job, out);
            fclose(out);
        }
        _exit(status);
    }
    close(end[1]);
    return child > 0 ? fdopen(end[0], "r") : NULL;
}

static long count_rows(const char *path)
{
    FILE *file = fopen(path, "r");
    long lines = 0;
    int character;

    while (file != NULL && (character = getc(file)) != EOF) {
        lines += character == '\n';
    }
    if (file != NULL) {
        fclose(file);
    }
    return lines - 1;
}

/* One line of each job in turn, until one has no more. */
static void merge(const struct options *options, FILE **job, FILE *out)
{
    static char line[CASES_LINE_SIZE];
    const long rows = count_rows(options->cases);
    const time_t begin = time(NULL);
    time_t last = begin;

    for (long i = 0; fgets(line, sizeof line, job[i % options->jobs]) != NULL; i++) {
        const time_t now = time(NULL);

        fputs(line, out);
        fflush(out);
        if (options->progress > 0 && now - last >= options->progress) {
            fprintf(stderr, "oracle: %ld of %ld, %.1f min left\n", i + 1, rows,
                    (double)(now - begin) / 60.0 * (double)(rows - i - 1) / (double)(i + 1));
            last = now;
        }
    }
}

static int work_in_processes(const struct options *options, FILE *out)
{
    FILE *job[JOBS_MAX];
    int failures = 0;
    int status;

    for (long i = 0; i < options->jobs; i++) {
        job[i] = start(options, i);
        if (job[i] == NULL) {
            fprintf(stderr, "oracle: cannot start a process\n");
            return 1;
        }
    }
    merge(options, job, out);
    for (long i = 0; i < options->jobs; i++) {
        fclose(job[i]);
    }
    while (wait(&status) > 0) {
        failures += !WIFEXITED(status) || WEXITSTATUS(status) != 0;
    }
    return failures > 0;
}

int main(int count, char **word)
{
    struct options options;
    FILE *out;
    int status;

    if (!parse(count, word, &options)) {
        fprintf(stderr, "use: oracle --cases in.csv --out out.csv [--jobs n] [--horizon periods] "
                        "[--naive steps-per-period] [--progress seconds]\n");
        return 2;
    }
    out = fopen(options.out, "w");
    if (out == NULL) {
        fprintf(stderr, "oracle: cannot write %s\n", options.out);
        return 1;
    }
    cases_write_header(out);
    status = options.jobs == 1 && options.progress == 0 ? work(&options, 0, out) : work_in_processes(&options, out);
    if (fclose(out) != 0) {
        fprintf(stderr, "oracle: cannot write %s\n", options.out);
        return 1;
    }
    return status;
}
