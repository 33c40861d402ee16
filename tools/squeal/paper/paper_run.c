/* Spreads the experiments over processes. */
#include "squeal/paper/lab.h"

#include "squeal/paper/record.h"
#include "squeal/support/children.h"
#include "squeal/support/clock.h"

#include <errno.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

struct job {
    pid_t pid; /* 0: free */
    size_t experiment;
    double start_s;
};

static bool job_start(struct job *job, size_t index, const struct paper_options *options, FILE *records[])
{
    records[index] = tmpfile();
    if (records[index] == NULL) {
        fprintf(stderr, "squeal: no file for a record: %s\n", strerror(errno));
        return false;
    }
    (void)fflush(NULL); /* or the process would print again what is still buffered */
    *job = (struct job){.experiment = index, .start_s = clock_now_s()};
    job->pid = children_fork(false);
    if (job->pid == 0) {
        lab_run(&paper_experiments[index], options, records[index]);
    }
    if (job->pid < 0) {
        fprintf(stderr, "squeal: fork: %s\n", strerror(errno));
    }
    return job->pid > 0;
}

/* An experiment tells its own failures, unless it was ended before it could. */
static void job_reap(struct job *job, FILE *records[])
{
    const int status = children_wait(job->pid);
    char problem[64];

    if (WIFSIGNALED(status)) {
        (void)snprintf(problem, sizeof problem, "its process was ended by signal %d", WTERMSIG(status));
        (void)fseek(records[job->experiment], 0, SEEK_END);
        record_write(records[job->experiment], RECORD_FAILURE, problem, NULL);
    }
    job->pid = 0;
    fprintf(stderr, "    %-24s %6.1f s\n", paper_experiments[job->experiment].id, clock_now_s() - job->start_s);
}

/* Waits until one of the jobs has ended, and frees it. Returns its place. */
static struct job *job_await(struct job *jobs, size_t count, FILE *records[])
{
    const struct timespec nap = {.tv_nsec = 10000000};

    for (;; (void)nanosleep(&nap, NULL)) {
        for (struct job *job = jobs; job < jobs + count; job++) {
            if (job->pid > 0 && children_has_ended(job->pid)) {
                job_reap(job, records);
                return job;
            }
        }
    }
}

static bool is_any_left(const struct job *jobs, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        if (jobs[i].pid > 0) {
            return true;
        }
    }
    return false;
}

bool paper_run(const struct paper_options *options, FILE *records[])
{
    struct job jobs[PAPER_JOBS_MAX] = {{0}};
    size_t busy = 0;
    bool is_well = true;

    for (size_t i = 0; i < paper_experiment_count && is_well; i++) {
        if (!paper_experiments[i].is_wanted) {
            continue;
        }
        struct job *job = busy < options->jobs ? &jobs[busy++] : job_await(jobs, busy, records);
        is_well = job_start(job, i, options, records);
    }
    while (is_any_left(jobs, busy)) {
        (void)job_await(jobs, busy, records);
    }
    return is_well;
}
