/* Pictures made of formulas, to be drawn and compared. */
#ifndef SCENE_H
#define SCENE_H

#include "squeal/monitor/picture.h"

/* A brake that begins to squeal: growth, then a cycle that reaches the disc's speed. */
void scene_squeal(struct picture *picture);

/* A plant in a fault, with a refusal, losses and a gap in its samples. */
void scene_fault(struct picture *picture);

#endif
