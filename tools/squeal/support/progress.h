/* How far a long task has come: a bar that is rewritten in place where someone watches, else a line for every tenth.
 * The bar goes to standard error, so that what is kept of standard output stays free of it. */
#ifndef SQUEAL_PROGRESS_H
#define SQUEAL_PROGRESS_H

#include <stdbool.h>
#include <stddef.h>

struct progress {
    size_t of, done;
    const char *what; /* plural, of what is counted */
    double start_s, shown_s;
    bool is_terminal;
};

/* Begins with nothing done of so many. */
void progress_start(struct progress *progress, size_t of, const char *what);

/* So many are done. May be called as often as one likes. */
void progress_show(struct progress *progress, size_t done);

/* Ends it, all done or not, and removes the bar. Returns the seconds since the start. */
double progress_end(struct progress *progress);

#endif
