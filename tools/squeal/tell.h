/* What a person reads of the story: a title, the device's own words, its verdict as a small table. */
#ifndef SQUEAL_TELL_H
#define SQUEAL_TELL_H

#include "story.h"

void tell_title(const struct story *story);

/* One line of the device's narration, or of its notices. */
void tell_words(const char *text);

/* The fields of a verdict, one a line. */
void tell_verdict(const char *fields);

/* The files that were written. */
void tell_files(const struct story *story);

#endif
