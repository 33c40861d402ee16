#include "analysis/eigen.h"

#include "base/fmath.h"

struct eigen eigen_of(float damping, float stiffness)
{
    const float half = 0.5f * damping;
    const float inside = stiffness - half * half;

    if (inside > 0.0f) {
        return (struct eigen){0.0f - half, fmath_sqrt(inside), half / fmath_sqrt(stiffness)};
    }
    return (struct eigen){-half + fmath_sqrt(-inside), 0.0f,
                          stiffness > 0.0f ? half / fmath_sqrt(stiffness) : (damping < 0.0f ? -1.0f : 1.0f)};
}

float eigen_outer_speed(float friction, float slope, float damping)
{
    const float growth = -slope - damping;

    return growth > 0.0f ? 4.0f * friction / (FMATH_PI * growth) : fmath_from_bits(0x7f800000u);
}
