/* The samples that the device streams. */
#include "squeal/story/record.h"

#include "squeal/support/fields.h"

#include <ctype.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>

enum { COLUMN_STEP, COLUMN_T, COLUMN_X, COLUMN_XD, COLUMN_VR = 8, COLUMN_PROPENSITY = 10, COLUMNS };

static void complain(struct record *record, const char *what, const char *text)
{
    if (record->problem[0] == '\0') {
        (void)snprintf(record->problem, sizeof record->problem, "%.110s: %.110s", what, text);
    }
}

bool record_open(struct record *record, const char *path)
{
    memset(record, 0, sizeof *record);
    (void)snprintf(record->path, sizeof record->path, "%s", path);
    record->file = csv_create(path, record->problem);
    if (record->file == NULL) {
        return false;
    }
    (void)fputs("act," RECORD_HEADER "\n", record->file);
    return true;
}

void record_header(struct record *record, const char *text)
{
    text += strspn(text, " ");
    if (strcmp(text, RECORD_HEADER) != 0) {
        complain(record, "the stream has other columns than " RECORD_HEADER, text);
    }
}

bool record_propensity(const char *text, enum detector_propensity *propensity)
{
    static const char *const names[] = {"unknown", "quiet", "watch", "squeal"};

    for (int i = 0; i < (int)(sizeof names / sizeof names[0]); i++) {
        if (strcmp(text, names[i]) == 0 || (isdigit((unsigned char)text[0]) && atoi(text) == i)) {
            *propensity = (enum detector_propensity)i;
            return true;
        }
    }
    return false;
}

/* Cuts the line at its commas and reads what is kept. False if it has not the columns asked for, or not numbers in
 * them. */
static bool sample_read(const char *text, struct act_sample *sample)
{
    char copy[512];
    char *cells[COLUMNS];
    double vr = 0.0;
    char *cell = copy;

    if (strlen(text) >= sizeof copy) {
        return false;
    }
    (void)strcpy(copy, text);
    for (int i = 0; i < COLUMNS; i++) {
        if (cell == NULL) {
            return false;
        }
        cells[i] = cell;
        cell = strchr(cell, ',');
        if (cell != NULL) {
            *cell++ = '\0';
        }
    }
    if (cell != NULL || !fields_parse(cells[COLUMN_STEP], &sample->step) ||
        !fields_parse(cells[COLUMN_T], &sample->t_s) || !fields_parse(cells[COLUMN_X], &sample->x_m) ||
        !fields_parse(cells[COLUMN_XD], &sample->xd_m_per_s) || !fields_parse(cells[COLUMN_VR], &vr)) {
        return false;
    }
    sample->disc_m_per_s = vr + sample->xd_m_per_s;
    return record_propensity(cells[COLUMN_PROPENSITY], &sample->propensity);
}

static bool sample_keep(struct act *act, const struct act_sample *sample)
{
    if (act->count == act->capacity) {
        const size_t capacity = act->capacity == 0 ? 4096 : 2 * act->capacity;
        struct act_sample *samples = realloc(act->samples, capacity * sizeof *samples);
        if (samples == NULL) {
            return false;
        }
        act->samples = samples;
        act->capacity = capacity;
    }
    act->samples[act->count++] = *sample;
    return true;
}

void record_sample(struct record *record, const char *text)
{
    struct act *act = record->act;
    struct act_sample sample;

    if (act == NULL) {
        return;
    }
    if (!sample_read(text, &sample)) {
        complain(record, "a sample that cannot be read", text);
        return;
    }
    if (fprintf(record->file, "%d,%s\n", act->number, text) < 0) {
        complain(record, record->path, strerror(errno));
    }
    if (act->count > 0) {
        const double steps = sample.step - act->samples[act->count - 1].step;
        if (steps > 0.0) {
            act->missing += steps / act->every - 1.0;
        } else {
            act->start = act->count; /* a reset, not a gap */
        }
    }
    if (!sample_keep(act, &sample)) {
        complain(record, "out of memory after sample", text);
    }
}

bool record_close(struct record *record)
{
    char problem[CSV_PROBLEM_MAX];

    if (record->file != NULL && !csv_close(record->file, record->path, problem)) {
        (void)snprintf(record->problem, sizeof record->problem, "%s", problem);
    }
    record->file = NULL;
    return record->problem[0] == '\0';
}
