/* What a person reads of the story: a title, the device's own words, its verdict as a small table. */
#ifndef SQUEAL_TELL_H
#define SQUEAL_TELL_H

#include "squeal/story/story.h"

void tell_title(const struct story *story);

/* The heading of an act: the first line of the device's narration. */
void tell_act(const char *title);

/* Another line of it. */
void tell_words(const char *text);

/* A notice, such as a verdict that changed on the way. */
void tell_notice(const char *text);

/* The fields of a verdict, one a line. */
void tell_verdict(const char *fields);

/* What the map is about to try. */
void tell_map_start(const struct story *story);

/* What came of it. */
void tell_map(const struct story *story);

/* The files that were written. */
void tell_files(const struct story *story);

#endif
