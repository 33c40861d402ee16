/* The firmware's plant, by its own interface. */
#include "walk.h"

#include <stdio.h>
#include <stdlib.h>

#include "model/presets.h"
#include "sim/sim.h"

bool walk_firmware(const struct walk_case *which, const char *arith, const char *normal, const char *method,
                   long steps_per_period, struct walk *walk)
{
    static struct sim_plan plan;
    static struct sim sim;
    const struct params_info *info;
    struct params params;
    char assignments[200];
    const char *bad;
    size_t bad_length;

    params_default(&params);
    (void)snprintf(assignments, sizeof assignments, "N0 %.9g alpha %.9g arith %s normal %s method %s spp %ld",
                   which->load_n, which->slope_s_per_m, arith, normal, method, steps_per_period);
    if (presets_assign(&params, assignments, &info, &bad, &bad_length) != ERROR_OK ||
        sim_plan_make(&plan, &params, NULL).error != ERROR_OK) {
        return false;
    }
    sim_reset(&sim, &plan);
    for (int look = 0; look < WALK_COUNT; look++) {
        struct sample sample;

        for (long i = 0; i < steps_per_period / WALK_LOOKS; i++) {
            (void)sim_step_unhashed(&sim);
        }
        sim_sample(&sim, &sample);
        walk->x_m[look] = (double)(sample_displacement(&sample, &plan.scale) * plan.scale.length_m);
    }
    return true;
}
