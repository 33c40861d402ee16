/* Event search on a cubic in integers: the roots that the float twin finds, whatever the unit of the values. */
#include "model/hermite_q27.h"

#include "base/fmath.h"
#include "plants.h"
#include "tap.h"
#include "tests.h"

#define PLACE (1.0f / 1073741824.0f)

/* a + b t + c t^2 + d t^3 by its ends, in a unit of 2^-bits. */
static struct hermite_q27 cubic(float a, float b, float c, float d, int bits)
{
    return hermite_q27_make_wide(fixed_times_float(1, a, bits), fixed_times_float(1, b, bits),
                                 fixed_times_float(1, a + b + c + d, bits),
                                 fixed_times_float(1, b + 2.0f * c + 3.0f * d, bits));
}

/* (root - t)(1 + lean t + bend t^2) */
static struct hermite_q27 with_root(float root, float lean, float bend, int bits)
{
    return cubic(root, root * lean - 1.0f, root * bend - lean, -bend, bits);
}

static float root_of(const struct hermite_q27 *f, float upper)
{
    return (float)hermite_q27_root(f, fixed_from_float(upper, 30)) * PLACE;
}

static void check_roots(void)
{
    static const int units[] = {20, 27, 44, 55};
    uint32_t state = 99u;
    float worst = 0.0f;
    bool are_inside = true;
    struct hermite_q27 f = cubic(0.3f, -1.0f, 0.0f, 0.0f, 27);

    tap_check_close(root_of(&f, 1.0f), 0.3f, 1e-7f, "a straight line's root, where Newton stands still");
    f = with_root(1.0f, 0.3f, 0.1f, 27);
    tap_check_close(root_of(&f, 1.0f), 1.0f, 1e-6f, "a root at the end of the bracket");
    f = hermite_q27_make_wide(1, -(INT64_C(1) << 50), -(INT64_C(1) << 50), -(INT64_C(1) << 50));
    tap_check_close(root_of(&f, 1.0f), 0.0f, 1e-6f, "a root at its start, lost in the unit of the others");
    f = with_root(0.45f, 0.2f, -0.1f, 27);
    tap_check_close(root_of(&f, 0.5f), 0.45f, 1e-5f, "a bracket that ends before 1");
    f = hermite_q27_make_wide(0, 0, 0, 0);
    tap_check(hermite_q27_root(&f, HERMITE_Q27_ONE) >= 0, "nothing at all is no reason to divide by 0");
    for (uint32_t i = 0u; i < plants_scaled(20000u, 1000u); i++) {
        const float root = plants_random(&state, 0.001f, 1.0f);
        const float lean = plants_random(&state, -0.2f, 0.2f);
        const float bend = plants_random(&state, -0.1f, 0.1f);
        const struct hermite_q27 straight = with_root(root, lean, bend, units[i % 4u]);
        const struct hermite_q27 wild = hermite_q27_make_wide(
            1 + (int64_t)tap_random(&state), (int64_t)tap_random(&state) * 30 - (INT64_C(15) << 32),
            -1 - (int64_t)tap_random(&state), (int64_t)tap_random(&state) * 30 - (INT64_C(15) << 32));
        const int32_t place = hermite_q27_root(&wild, HERMITE_Q27_ONE);

        worst = fmath_max(worst, fmath_abs(root_of(&straight, 1.0f) - root));
        are_inside = are_inside && place >= 0 && place <= HERMITE_Q27_ONE;
    }
    tap_check_close(worst, 0.0f, 5e-6f, "curves as a step meets them, in any unit");
    tap_check(are_inside, "no root leaves the bracket, however wild the curve");
}

static void check_others(void)
{
    uint32_t state = 8u;
    float worst_root = 0.0f;
    float worst_minimum = 0.0f;

    for (uint32_t i = 0u; i < plants_scaled(5000u, 500u); i++) {
        const float root = plants_random(&state, 0.05f, 1.0f);
        const float lean = plants_random(&state, -0.2f, 0.2f);
        const struct hermite_q27 start = cubic(0.0f, root, root * lean - 1.0f, -lean, 27);
        const float place = plants_random(&state, 0.01f, 0.99f);
        const float cube = plants_random(&state, -0.15f, 0.15f);
        const struct hermite_q27 dip = cubic(1.0f, -2.0f * place - 3.0f * cube * place * place, 1.0f, cube, 27);

        worst_root = fmath_max(worst_root, fmath_abs((float)hermite_q27_root_after_start(&start) * PLACE - root));
        worst_minimum = fmath_max(worst_minimum, fmath_abs((float)hermite_q27_minimum(&dip) * PLACE - place));
    }
    tap_check_close(worst_root, 0.0f, 3e-6f, "a root at the start is divided out and the next one found");
    tap_check_close(worst_minimum, 0.0f, 1e-4f, "the place of a minimum");
}

void test_hermite_q27(void)
{
    check_roots();
    check_others();
}
