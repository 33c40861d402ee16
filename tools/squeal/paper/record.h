/* The record of an experiment: what it found, line by line, from its process to the page. */
#ifndef SQUEAL_PAPER_RECORD_H
#define SQUEAL_PAPER_RECORD_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

/* RECORD(kind, fields...) and what its fields mean, all of them text. */
enum record_kind {
    RECORD_DEVICE,  /* board and build */
    RECORD_NOTE,    /* paragraph */
    RECORD_FIGURE,  /* name, caption */
    RECORD_DATA,    /* name */
    RECORD_NUMBER,  /* subject, quantity, measured, unit, reference, tolerance, "agrees", "OFF" or "" */
    RECORD_CLAIM,   /* place in claims.def, verdict as a number, figure, measured */
    RECORD_FAILURE, /* problem */
    RECORD_KINDS
};

enum { RECORD_FIELDS_MAX = 7 };

struct record_item {
    enum record_kind kind;
    char *field[RECORD_FIELDS_MAX]; /* "" where there are fewer */
};

struct record {
    char *text;
    struct record_item *items;
    size_t count;
};

/* Writes an item; its fields are ended by NULL. */
void record_write(FILE *file, enum record_kind kind, ...);

/* Reads what was written, from the start; false out of memory. */
bool record_read(struct record *record, FILE *file);
void record_free(struct record *record);

#endif
