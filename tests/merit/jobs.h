/* Rows over several processes: row i is worked out by process i mod n, the records come back through pipes in order. */
#ifndef MERIT_JOBS_H
#define MERIT_JOBS_H

#include <stdbool.h>
#include <stddef.h>

enum { JOBS_MAX = 64 };

struct jobs {
    const char *title; /* of the progress that is shown on stderr now and then */
    long processes;
    size_t rows;
    size_t record_size; /* bytes */
    void (*work)(const void *context, size_t row, void *record);
    const void *context;
};

/* Fills records, one for each row. Returns false if a process could not be started or ended early. */
bool jobs_run(const struct jobs *jobs, void *records);

#endif
