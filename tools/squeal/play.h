/* The conversation of the story: plays the acts on the device and collects what it says and streams. */
#ifndef SQUEAL_PLAY_H
#define SQUEAL_PLAY_H

#include "story.h"

/* Starts the firmware and plays the story's acts on it, printing the device's words as they come. Afterwards act_count
 * is the number of acts that were begun. */
void play_all(struct story *story);

/* Does the act end in a squeal that can be heard? */
bool play_is_audible(const struct act *act);

/* Does the disc slow down in the act? */
bool play_is_stop(const struct act *act);

/* Physical time that the act's last run covers, s. */
double play_length_s(const struct act *act);

#endif
