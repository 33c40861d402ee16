/* Spreads the cases over several firmware processes. Each worker is a process with one session of its own. Two pipes
 * join them: a ticket that holds the number of the next case (who reads it owns that case and puts the next number
 * back), and the results, each written in one piece. */
#include "squeal/golden/golden.h"
#include "squeal/support/children.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* So many sessions lost in a row mean that the firmware, not the case, is broken. */
enum { LOSSES_MAX = 3 };

struct pipes {
    int ticket[2];
    int results[2];
};

static bool read_whole(int from, void *out, size_t size)
{
    size_t done = 0;

    while (done < size) {
        const ssize_t count = read(from, (char *)out + done, size - done);
        if (count > 0) {
            done += (size_t)count;
        } else if (count == 0 || errno != EINTR) {
            return false;
        }
    }
    return true;
}

/* The next case that nobody has, or one beyond the last. */
static size_t ticket_take(const struct pipes *pipes, size_t rows)
{
    size_t row = rows;

    if (!read_whole(pipes->ticket[0], &row, sizeof row)) {
        return rows;
    }
    const size_t next = row < rows ? row + 1 : rows;
    return write(pipes->ticket[1], &next, sizeof next) == (ssize_t)sizeof next ? row : rows;
}

static void result_lost(struct golden_result *result, size_t row, const char *reason)
{
    memset(result, 0, sizeof *result);
    result->row = row;
    (void)snprintf(result->reason, sizeof result->reason, "%s", reason);
    for (int column = 0; column < GOLDEN_COLUMNS; column++) {
        (void)strcpy(result->cells[column], column == GOLDEN_CLASS ? "lost" : "nan");
    }
}

/* The life of a worker. Every case that it takes gives exactly one result. */
static void work(const struct golden_plan *plan, const struct pipes *pipes)
{
    struct session session;
    enum session_result state = SESSION_LOST;
    int losses = 0;

    for (size_t row; losses < LOSSES_MAX && (row = ticket_take(pipes, plan->cases.rows)) < plan->cases.rows;) {
        struct golden_result result;
        if (state == SESSION_LOST) {
            state = session_open(&session, plan->command, NULL, NULL);
        }
        if (state == SESSION_LOST) {
            result_lost(&result, row, session.failure);
        } else {
            state = golden_row_run(&session, plan, row, &result);
        }
        losses = state == SESSION_LOST ? losses + 1 : 0;
        if (write(pipes->results[1], &result, sizeof result) != (ssize_t)sizeof result) {
            break; /* nobody is left to read it */
        }
    }
    session_close(&session);
}

static void results_collect(const struct golden_plan *plan, int from, struct golden_result *results)
{
    struct golden_result result;
    size_t done = 0;

    while (read_whole(from, &result, sizeof result)) {
        results[result.row] = result;
        done++;
        if (isatty(STDERR_FILENO)) {
            fprintf(stderr, "\r%zu of %zu cases%s", done, plan->cases.rows, done < plan->cases.rows ? "" : "\n");
        }
    }
}

void golden_jobs_run(const struct golden_plan *plan, struct golden_result *results)
{
    const size_t first = 0;
    struct pipes pipes;
    pid_t workers[16] = {0};

    for (size_t row = 0; row < plan->cases.rows; row++) {
        result_lost(&results[row], row, "not run, because the firmware was lost before");
    }
    if (pipe(pipes.ticket) != 0 || pipe(pipes.results) != 0 ||
        write(pipes.ticket[1], &first, sizeof first) != (ssize_t)sizeof first) {
        fprintf(stderr, "squeal: pipe: %s\n", strerror(errno));
        return;
    }
    (void)fflush(NULL); /* or every worker would print again what is still buffered */
    for (long job = 0; job < plan->jobs; job++) {
        workers[job] = children_fork(false);
        if (workers[job] == 0) {
            (void)close(pipes.results[0]);
            children_guard();
            work(plan, &pipes);
            _exit(0);
        }
    }
    (void)close(pipes.results[1]);
    results_collect(plan, pipes.results[0], results);
    (void)close(pipes.results[0]);
    (void)close(pipes.ticket[0]);
    (void)close(pipes.ticket[1]);
    for (long job = 0; job < plan->jobs; job++) {
        (void)children_wait(workers[job]);
    }
}
