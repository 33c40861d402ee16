/* Reads every parameter from the device. */
#include "squeal/paper/lab_model.h"

void lab_model(struct lab *lab, struct params *params, struct scale *scale)
{
    params_default(params);
    for (size_t i = 0; i < params_count; i++) {
        params_set(params, &params_table[i], (float)lab_get(lab, params_table[i].symbol));
    }
    if (scale_derive(params, NULL, scale).error != ERROR_OK) {
        lab_fail(lab, "the model cannot hold the set that the device has");
    }
}

struct analysis lab_analysis(struct lab *lab)
{
    struct params params;
    struct scale scale;
    struct analysis analysis;

    lab_model(lab, &params, &scale);
    analysis_make(&analysis, &params, &scale);
    return analysis;
}
