/* What a controller asks of the brake while it runs: a force and a disc speed held from a given step on, in place of
 * the set's profiles. Main turns a demand, in the units of a brake engineer, into an input in the model's; the
 * interrupt takes it at its step and nowhere else, so the trajectory is a function of the demands and their steps
 * alone. */
#ifndef SIM_INPUT_H
#define SIM_INPUT_H

#include <stdbool.h>
#include <stdint.h>

#include "model/params.h"
#include "model/scale.h"

/* Where the brake force comes from. */
enum input_load {
    INPUT_LOAD_KEEP,    /* from where it came before */
    INPUT_LOAD_PROFILE, /* the set's profile */
    INPUT_LOAD_FORCE,   /* N */
    INPUT_LOAD_PRESSURE /* Pa, times the piston's area A_p */
};

/* Where the disc's speed comes from. */
enum input_speed {
    INPUT_SPEED_KEEP,
    INPUT_SPEED_PROFILE,
    INPUT_SPEED_DISC,   /* m/s at the pad */
    INPUT_SPEED_VEHICLE /* m/s, times R/R_tyre */
};

enum {
    INPUT_NOW = 0,
    INPUT_QUEUE_MAX = 32 /* that wait for their step */
};

struct input_demand {
    enum input_load load;
    enum input_speed speed;
    float load_value, speed_value; /* in the unit of their kind; meaningless for KEEP and PROFILE */
    uint64_t step;                 /* index of the first step that it is held over; INPUT_NOW: of the next one */
    bool starts;                   /* leaves the safe state, in which any other demand is refused */
};

/* The same for the interrupt; values in the model's units, in either arithmetic. */
struct input {
    uint64_t step;
    uint8_t epoch; /* of the reset that it belongs to: a reset voids it */
    bool starts, sets_load, sets_speed;
    bool holds_load, holds_speed; /* meaningful if it sets them; false: back to the profile */
    float load, speed;
    int32_t load_q27, speed_q27;
};

/* Derives an input. A force below 0 or beyond N_max, a speed beyond what the scale holds, are held at the limit: true
 * then. Values must be finite. [MAIN] */
bool input_derive(struct input *input, const struct input_demand *demand, const struct params *params,
                  const struct scale *scale);

/* What is in force now. [ISR] */
struct input_state {
    bool holds_load, holds_speed;
    float load, speed;
    int32_t load_q27, speed_q27;
};

/* [ISR] */
void input_take(struct input_state *state, const struct input *input);

/* Inputs in the order of their steps; of those for the same step, in the order in which they came. */
struct input_queue {
    uint32_t count;
    struct input waiting[INPUT_QUEUE_MAX];
};

/* Puts one in its place; the caller looks for room first. [ISR] */
void input_queue_put(struct input_queue *queue, const struct input *input);

/* Takes out the first if its step is reached; false if none is due. [ISR] */
bool input_queue_take(struct input_queue *queue, uint64_t step, struct input *input);

#endif
