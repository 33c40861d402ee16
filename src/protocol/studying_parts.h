/* What the console's studies share. Not for anybody else. */
#ifndef PROTOCOL_STUDYING_PARTS_H
#define PROTOCOL_STUDYING_PARTS_H

#include "protocol/studying.h"

/* The parameter of this name; NULL if there is none, and that has been answered. */
const struct params_info *studying_read_parameter(struct console *console, struct token word);

/* A number for a parameter, as set would read it. False if it is none, and that has been answered. */
bool studying_read_value(struct console *console, const struct params_info *info, struct token word, float *value);

/* A whole number in low .. high. False if it is none, and that has been answered. */
bool studying_read_count(struct console *console, const char *key, struct token word, uint32_t low, uint32_t high,
                         uint32_t *count);

/* Does one of the words that say how long to look stand here? */
bool studying_is_span(struct token word);

/* Reads what is left of the line: "transient <periods>", "window <periods>", "whole" in any order, into a span that
 * holds the defaults. False if something else is there, and that has been answered. */
bool studying_read_span(struct console *console, struct token word, struct trial_span *span);

/* Starts the task of a study, which is to be begun then; false if one is under way already, and that has been
 * answered. */
bool studying_start(struct console *console);

/* Fields " key=value": of the trial that is over or was refused, and of the tally. */
void studying_write_outcome(struct text *text, const struct study *study);
void studying_write_tally(struct text *text, const struct study_tally *tally);

/* Each writes the body line of a result, and what its answer says before the tally. */
void studying_write_point(struct console *console);
void studying_write_borders(struct console *console);
void studying_write_draw(struct console *console);
void studying_write_margin_answer(struct text *text, const struct study *study);
void studying_write_share(struct text *text, const struct study *study);

#endif
