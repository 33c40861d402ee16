/* A cubic Hermite polynomial on [0, 1] and the event searches that the step needs of it.
 * f(t) takes value0, slope0 at t = 0 and value1, slope1 at t = 1; slopes are per unit of t. [ANY, pure] */
#ifndef MODEL_HERMITE_F32_H
#define MODEL_HERMITE_F32_H

#include <stdbool.h>

#include "base/compiler.h"
#include "base/fmath.h"

struct hermite_f32 {
    float value0, slope0, square, cube; /* f = value0 + t (slope0 + t (square + t cube)) */
};

BASE_INLINE struct hermite_f32 hermite_f32_make(float value0, float slope0, float value1, float slope1)
{
    const float rise = value1 - value0;

    return (struct hermite_f32){value0, slope0, 3.0f * rise - 2.0f * slope0 - slope1, slope0 + slope1 - 2.0f * rise};
}

/* One pass of Newton from t; *slope is the curve's at t. */
BASE_INLINE float hermite_f32_newton(const struct hermite_f32 *f, float t, float *slope)
{
    const float top = t * f->cube;
    const float upper = f->square + top;
    const float lower = f->slope0 + t * upper;

    *slope = lower + t * (upper + top);
    return t - (f->value0 + t * lower) / *slope;
}

/* Root in (0, 1) of a curve that crosses 0 once and plainly, from either side: secant start, two Newton passes. value1
 * is f(1). Returns false where that does not serve; hermite_f32_root() may. */
BASE_INLINE bool hermite_f32_crossing(const struct hermite_f32 *f, float value1, float *place)
{
    const float start = f->value0 / (f->value0 - value1);
    float slope1;
    float slope2;
    const float near = hermite_f32_newton(f, start, &slope1);
    const float root = hermite_f32_newton(f, near, &slope2);
    const uint32_t from = fmath_bits(f->value0);
    const uint32_t is_towards = (fmath_bits(slope1) ^ from) & (fmath_bits(slope2) ^ from);
    const uint32_t is_beyond = fmath_bits(near) | fmath_bits(1.0f - near);

    *place = root;
    return f->value0 * value1 < 0.0f && (int32_t)(is_towards & ~is_beyond) < 0 && root >= 0.0f && root <= 1.0f;
}

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
