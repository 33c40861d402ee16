/* One plant with its load, its detector and its counters: what a tick advances. Everything lives in a struct that the
 * caller owns, so a program may run several side by side. The trajectory depends on the set and the step index
 * alone. */
#ifndef SIM_SIM_H
#define SIM_SIM_H

#include <stdbool.h>
#include <stdint.h>

#include "analysis/predictor.h"
#include "model/params.h"
#include "model/scale.h"
#include "model/step_f32.h"
#include "model/step_q27.h"
#include "sim/acting.h"
#include "sim/detector.h"
#include "sim/input.h"
#include "sim/measure.h"
#include "sim/sample.h"
#include "sim/texture.h"
#include "sim/watch.h"

/* A set with everything derived from it, made in main and handed to the interrupt as a whole. */
struct sim_plan {
    struct scale scale;
    uint8_t arithmetic; /* ARITH_F32 or ARITH_Q27: which of the pairs below is in use */
    struct step_f32_coeffs f32;
    struct step_q27_coeffs q27;
    struct texture texture;
    float load_limit; /* of a force held by a controller, under this texture */
    int32_t load_limit_q27;
    struct watch_config watch;
    struct detector_config detector;
    struct prediction prediction;
    bool has_state; /* load or speed */
    struct acting load, speed;
    struct params params; /* last, like the curves: what the interrupt reads lies near */
};

/* Checks a set and derives its plan. latched as in scale_derive(). *plan is undefined on a problem. [MAIN] */
struct params_problem sim_plan_make(struct sim_plan *plan, const struct params *params, const struct scale *latched);

/* Since reset. */
struct sim_counters {
    uint32_t events;      /* switches of regime */
    uint32_t caps;        /* steps in which one more was due than may be located */
    uint32_t saturations; /* steps whose output did not fit its numbers */
    uint32_t lifted;      /* steps with lost contact, y < 0 */
    uint32_t gap_held;    /* steps in which the gap was held at its limit */
    uint32_t lowered;     /* times that a new set lowered a held force to its limit */
    uint32_t inputs;      /* demands of a controller taken, */
    uint32_t inputs_late; /* those of them whose step was past, */
    uint32_t inputs_void; /* and those not taken because of the safe state */
};

enum sim_fault { SIM_FAULT_NONE, SIM_FAULT_DOMAIN };

struct sim {
    const struct sim_plan *plan;
    struct step_f32 f32; /* one of the two, as the plan says */
    struct step_q27 q27;
    struct acting_state load, speed; /* of what has one */
    struct input_state input;        /* of a controller, in place of the profiles */
    struct watch watch;              /* over the controller */
    float safe_load;                 /* force with which the safe state began */
    int32_t safe_load_q27;
    struct texture_angle angle; /* of the disc; counted from reset, while there is run-out */
    int32_t texture;            /* that acts on the load */
    struct detector detector;
    struct measure measure;
    struct sim_counters counters;
    uint64_t step;
    uint32_t hash;        /* of every state since reset, but the disc's angle: what that does is in y one step later */
    uint8_t fault;        /* enum sim_fault */
    bool is_usual;        /* the step to come is like the one before: sim.c, "The usual step" */
    uint32_t usual_speed; /* and what |v| stays within meanwhile */
    bool has_v10;         /* |v| has passed ten times the disc's speed: first time, in steps and 2^-15 steps */
    uint64_t v10_step;
    uint32_t v10_fraction_q15;
};

/* What the last step has come to. [ISR] */
static inline const struct plant_output *sim_output(const struct sim *sim)
{
    return sim->plan->arithmetic == ARITH_Q27 ? &sim->q27.output : &sim->f32.output;
}

/* Back to the initial state of the plan at step 0. The plan must outlive its use here. [ISR] */
void sim_reset(struct sim *sim, const struct sim_plan *plan);

/* A new set takes hold between two steps; state and units are kept. The plan before it must still be as it was.
 * [ISR] */
void sim_apply(struct sim *sim, const struct sim_plan *plan);

/* A controller's demand takes hold with the next step. In the safe state only one that starts does; any other is void,
 * and counted. [ISR] */
void sim_input(struct sim *sim, const struct input *input);

/* Asked before each step while a watch is on (sim->watch.state): how old is the controller's demand? In the safe state
 * it lowers the force. [ISR] */
void sim_watch(struct sim *sim, const struct watch_pace *pace);

/* One step: load, plant, domain check, detector, measurement, hash. In a fault it does nothing. Returns true when the
 * detector has a new verdict. [ISR] */
bool sim_step(struct sim *sim);

/* The same without the hash, for plants that nobody compares. [ANY] */
bool sim_step_unhashed(struct sim *sim);

/* Starts a measurement over the given number of steps from here. [ISR] */
void sim_measure(struct sim *sim, uint64_t steps);

/* All but the plan has been put back as it stood under this plan once. [ISR] */
void sim_resume(struct sim *sim, const struct sim_plan *plan);

/* The present state as a record for main. [ISR] */
void sim_sample(const struct sim *sim, struct sample *sample);

#endif
