/* Processes and pipes. */
#include "jobs.h"

#include <stdio.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum { REPORT_S = 10 };

static int work(const struct jobs *jobs, size_t first, FILE *out)
{
    unsigned char *record = calloc(1, jobs->record_size);
    bool is_good = record != NULL;

    for (size_t row = first; is_good && row < jobs->rows; row += (size_t)jobs->processes) {
        jobs->work(jobs->context, row, record);
        is_good = fwrite(record, jobs->record_size, 1, out) == 1 && fflush(out) == 0;
    }
    free(record);
    return is_good ? 0 : 1;
}

/* Starts a process; its records come out of the returned stream. */
static FILE *start(const struct jobs *jobs, size_t first)
{
    int end[2];
    pid_t child;

    if (pipe(end) != 0) {
        return NULL;
    }
    (void)fflush(NULL);
    child = fork();
    if (child == 0) {
        FILE *out = fdopen(end[1], "wb");

        (void)close(end[0]);
        _exit(out == NULL ? 1 : work(jobs, first, out));
    }
    (void)close(end[1]);
    return child > 0 ? fdopen(end[0], "rb") : NULL;
}

/* How far it is, and how long it will take if the rows that are left are like those that are done. */
static void report(const struct jobs *jobs, size_t done, time_t begin, time_t *last)
{
    const time_t now = time(NULL);

    if (now - *last >= REPORT_S) {
        const double left_s = (double)(now - begin) / (double)done * (double)(jobs->rows - done);

        *last = now;
        (void)fprintf(stderr, "%s: %zu of %zu, %.1f min left\n", jobs->title, done, jobs->rows, left_s / 60.0);
    }
}

static bool collect(const struct jobs *jobs, FILE *const *pipes, unsigned char *records)
{
    const time_t begin = time(NULL);
    time_t last = begin;

    for (size_t row = 0; row < jobs->rows; row++) {
        FILE *from = pipes[row % (size_t)jobs->processes];

        if (fread(records + row * jobs->record_size, jobs->record_size, 1, from) != 1) {
            return false;
        }
        report(jobs, row + 1, begin, &last);
    }
    return true;
}

bool jobs_run(const struct jobs *jobs, void *records)
{
    FILE *pipes[JOBS_MAX] = {NULL};
    bool is_good = true;

    for (long i = 0; is_good && i < jobs->processes; i++) {
        pipes[i] = start(jobs, (size_t)i);
        is_good = pipes[i] != NULL;
    }
    is_good = is_good && collect(jobs, pipes, records);
    for (long i = 0; i < jobs->processes && pipes[i] != NULL; i++) {
        (void)fclose(pipes[i]);
    }
    while (wait(NULL) > 0) {
    }
    return is_good;
}
