/* A cubic Hermite polynomial on [0, 1] and the event searches that the step needs of it.
 * f(t) takes value0, slope0 at t = 0 and value1, slope1 at t = 1; slopes are per unit of t. [ANY, pure] */
#ifndef MODEL_HERMITE_F32_H
#define MODEL_HERMITE_F32_H

#include <stdbool.h>

struct hermite_f32 {
    float value0, slope0, square, cube; /* f = value0 + t (slope0 + t (square + t cube)) */
};

struct hermite_f32 hermite_f32_make(float value0, float slope0, float value1, float slope1);

/* First root in (0, upper], for f(0) > 0 >= f(upper): secant start, two safeguarded Newton passes. */
float hermite_f32_root(const struct hermite_f32 *f, float upper);

/* Root in (0, 1] of a curve that starts at f(0) = 0 with slope0 > 0 and ends below 0: the root at 0 is divided out. */
float hermite_f32_root_after_start(const struct hermite_f32 *f);

/* Place of the minimum inside (0, 1), for slope0 < 0 < slope1. */
float hermite_f32_minimum(const struct hermite_f32 *f);

static inline float hermite_f32_value(const struct hermite_f32 *f, float t)
{
    return f->value0 + t * (f->slope0 + t * (f->square + t * f->cube));
}

#endif
