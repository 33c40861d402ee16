/* The set in force, in the host's own copy of the model: for what is said of it without integration. */
#ifndef SQUEAL_LAB_MODEL_H
#define SQUEAL_LAB_MODEL_H

#include "analysis/analysis.h"
#include "squeal/paper/lab.h"

/* Ends the experiment if the model cannot hold the set. */
void lab_model(struct lab *lab, struct params *params, struct scale *scale);

struct analysis lab_analysis(struct lab *lab);

#endif
