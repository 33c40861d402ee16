/* Event search on a cubic: few passes, always inside the bracket. */
#include "model/hermite_f32.h"

enum { NEWTON_PASSES = 2 };

float hermite_f32_root(const struct hermite_f32 *f, float upper)
{
    const float end = hermite_f32_value(f, upper);
    float low = 0.0f;
    float high = upper;
    float t = upper * (f->value0 / (f->value0 - end));

    for (int pass = 0; pass < NEWTON_PASSES; pass++) {
        const float value = hermite_f32_value(f, t);
        const float slope = f->slope0 + t * (2.0f * f->square + t * (3.0f * f->cube));
        float next = low;

        if (value < 0.0f) {
            high = t;
        } else {
            low = t;
        }
        if (slope < 0.0f || slope > 0.0f) {
            next = t - value / slope;
        }
        /* A root on the bracket's edge is a root: a strict test here would jump away after converging. */
        t = next >= low && next <= high ? next : low + (high - low) * 0.5f;
    }
    return t;
}

float hermite_f32_root_after_start(const struct hermite_f32 *f)
{
    const struct hermite_f32 divided = {f->slope0, f->square, f->cube, 0.0f};

    return hermite_f32_root(&divided, 1.0f);
}

float hermite_f32_minimum(const struct hermite_f32 *f)
{
    const struct hermite_f32 descent = {-f->slope0, -2.0f * f->square, -3.0f * f->cube, 0.0f};

    return hermite_f32_root(&descent, 1.0f);
}
