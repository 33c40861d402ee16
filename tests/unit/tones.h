/* A detector on its bench: motions made of tones, beside a normal oscillation, with stick and crossing as wanted. */
#ifndef TONES_H
#define TONES_H

#include "sim/detector.h"

#define TONES_ONE 134217728.0f /* of Q4.27 */

enum {
    TONES_SPP = 64,
    TONES_TURN = 1 << 26,     /* the normal frequency, in 2^-32 turns a step */
    TONES_TURN_OWN = 94906266 /* sqrt 2 of it, the pad's own frequency for Z2 = 2 */
};

struct tone {
    float size; /* of v */
    uint32_t turn;
    float growth; /* a step */
};

struct tones {
    struct detector detector;
    struct detector_config config;
    struct tone tones[2];
    float normal, disc;
    float carried;                     /* added to v alone, as by a disc that is stuck to */
    uint32_t stick_steps, minus_steps; /* of each period, spent sticking and in slip against vr > 0 */
    uint32_t step, news;
};

/* Q4.27 of a value. */
int32_t tones_q27(float value);

/* The present output. */
struct plant_output tones_output(const struct tones *bench);

/* Starts with a disc of 0.5, Z2 = 2 and a gain of 1: the normal oscillation explains as much speed as it has itself. */
void tones_start(struct tones *bench, float normal, struct tone first, struct tone second);

/* Another Z2, which weighs x against v; the detector starts again. */
void tones_set_spring(struct tones *bench, float stiffness);

/* Runs until the given number of frames since the start has been judged. */
const struct detector_verdict *tones_run_to(struct tones *bench, uint32_t frames);

/* Does the verdict say just this? If not, notes what it says. */
bool tones_say(const struct detector_verdict *verdict, uint8_t propensity, uint8_t motion, uint8_t period);

/* Motion of the pad at the normal frequency, and none. */
extern const struct tone tones_forced, tones_none;

#endif
