/* run.json: everything that is needed to repeat the run and to judge it. */
#ifndef SQUEAL_REPORT_H
#define SQUEAL_REPORT_H

#include "squeal/story/story.h"

/* Writes run.json into the folder of the run. */
void report_write(struct story *story);

#endif
