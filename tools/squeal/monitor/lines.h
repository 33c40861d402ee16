/* The picture in one line, for pipes and files. */
#ifndef SQUEAL_LINES_H
#define SQUEAL_LINES_H

#include <stdbool.h>
#include <stdio.h>

#include "squeal/monitor/picture.h"

/* Prints it, in ASCII. False if nobody takes it. */
bool lines_print(FILE *out, const struct picture *picture);

#endif
