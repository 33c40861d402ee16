/* Between the files of sim: the force and the speed that act in the step to come, but for the disc's surface. */
#ifndef SIM_SIM_PARTS_H
#define SIM_SIM_PARTS_H

#include "base/compiler.h"
#include "sim/sim.h"

/* A controller's, or the set's. */
BASE_INLINE float sim_load_f32(const struct sim *sim)
{
    return sim->input.holds_load ? sim->input.load : acting_value_f32(&sim->plan->load, &sim->load, sim->step);
}

BASE_INLINE float sim_speed_f32(const struct sim *sim)
{
    return sim->input.holds_speed ? sim->input.speed : acting_value_f32(&sim->plan->speed, &sim->speed, sim->step);
}

BASE_INLINE int32_t sim_load_q27(const struct sim *sim)
{
    return sim->input.holds_load ? sim->input.load_q27 : acting_value_q27(&sim->plan->load, &sim->load, sim->step);
}

BASE_INLINE int32_t sim_speed_q27(const struct sim *sim)
{
    return sim->input.holds_speed ? sim->input.speed_q27 : acting_value_q27(&sim->plan->speed, &sim->speed, sim->step);
}

#endif
