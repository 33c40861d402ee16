/* What the studies share. Not for anybody else. */
#ifndef PROTOCOL_STUDY_PARTS_H
#define PROTOCOL_STUDY_PARTS_H

#include "protocol/console_parts.h"
#include "protocol/study.h"

/* The parameter of this name; NULL if there is none, and that has been answered. */
const struct params_info *study_read_parameter(struct console *console, struct token word);

/* A number for a parameter, as set would read it. False if it is none, and that has been answered. */
bool study_read_value(struct console *console, const struct params_info *info, struct token word, float *value);

/* A whole number in low .. high. False if it is none, and that has been answered. */
bool study_read_count(struct console *console, const char *key, struct token word, uint32_t low, uint32_t high,
                      uint32_t *count);

/* Does one of the words that say how long to look stand here? */
bool study_is_span(struct token word);

/* Reads what is left of the line: "transient <periods>", "window <periods>", "whole" in any order, into
 * a span that holds the defaults. False if something else
 * is there, and that has been answered. */
bool study_read_span(struct console *console, struct token word, struct trial_span *span);

/* Begins the task with nothing tried yet. */
void study_start(struct console *console, enum console_task task);

/* Goes on with the trial of a set, one slice; true when it is over. *problem tells why it could not be begun. */
bool study_try(struct study *study, const struct params *params, struct params_problem *problem);

/* Fields " key=value": of a trial that is over or was refused, and of the tally. */
void study_write_outcome(struct text *text, const struct trial *trial, const struct params_problem *problem);
void study_write_tally(struct text *text, const struct study_tally *tally);

#endif
