/* The conversation of the story: plays the acts on the device and collects what it says and streams. */
#ifndef SQUEAL_PLAY_H
#define SQUEAL_PLAY_H

#include "squeal/story/story.h"

/* Starts the firmware, plays the story's acts on it and has it make the map, printing the device's words as they come.
 * Afterwards act_count is the number of acts that were begun. */
void play_all(struct story *story);

/* Sends one line that must be answered ok; what else comes is reported as a failure of the story. */
bool play_must(struct story *story, const char *line);

/* Does the act end in a squeal that can be heard? */
bool play_is_audible(const struct act *act);

/* Does the disc slow down in the act? */
bool play_is_stop(const struct act *act);

/* Physical time that the act's last run covers, s. */
double play_length_s(const struct act *act);

#endif
