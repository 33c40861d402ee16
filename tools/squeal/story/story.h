/* The subcommand demo: the device tells its story act by act; the tool prints it for a person and keeps the record. */
#ifndef SQUEAL_STORY_H
#define SQUEAL_STORY_H

#include <stdbool.h>

#include "squeal/console/session.h"
#include "squeal/story/map.h"
#include "squeal/story/record.h"

enum { STORY_FILES_MAX = 32, STORY_PATH_SIZE = 512 };

struct story {
    const char *board, *out;
    double limit_s; /* for one answer of the firmware */
    char **command;
    struct session session;
    struct record record;
    struct act acts[RECORD_ACTS];
    size_t act_count;
    struct map map;
    char id[SESSION_LINE_MAX];
    char emulator[128]; /* first line of its --version; empty if the firmware runs without one */
    bool has_failed;
    struct {
        char path[STORY_PATH_SIZE];
        char what[96];
    } files[STORY_FILES_MAX]; /* written, for the closing list */
    size_t file_count;
};

/* Prints one line about what went wrong and remembers that the run has failed. */
void story_fail(struct story *story, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* The path of a file in the folder of the run, for one call at a time. */
const char *story_path(const struct story *story, char path[STORY_PATH_SIZE], const char *name);

/* Adds a written file to the closing list. */
void story_wrote(struct story *story, const char *path, const char *what);

#endif
