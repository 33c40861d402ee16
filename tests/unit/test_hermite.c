/* Event search on a cubic: known roots, roots at the bracket's edge, the root at the start divided out, minima. */
#include "model/hermite_f32.h"

#include "base/fmath.h"
#include "plants.h"
#include "tap.h"
#include "tests.h"

/* a + b t + c t^2 + d t^3 by its ends, as the step does it. */
static struct hermite_f32 cubic(float a, float b, float c, float d)
{
    return hermite_f32_make(a, b, a + b + c + d, b + 2.0f * c + 3.0f * d);
}

static void check_make(void)
{
    const struct hermite_f32 f = cubic(1.0f, -2.0f, 0.5f, 0.25f);

    tap_check_close(f.square, 0.5f, 1e-6f, "the ends give the square's coefficient");
    tap_check_close(f.cube, 0.25f, 1e-6f, "and the cube's");
    tap_check_close(hermite_f32_value(&f, 0.5f), 0.15625f, 1e-6f, "and the value in between");
}

/* (root - t)(1 + lean t + bend t^2), a curve with one root and as bent as a step's speed of slip may be. */
static struct hermite_f32 with_root(float root, float lean, float bend)
{
    return cubic(root, root * lean - 1.0f, root * bend - lean, -bend);
}

static void check_roots(void)
{
    uint32_t state = 99u;
    float worst_straight = 0.0f;
    float worst_bent = 0.0f;
    bool are_inside = true;
    struct hermite_f32 f = cubic(0.3f, -1.0f, 0.0f, 0.0f);

    tap_check_close(hermite_f32_root(&f, 1.0f), 0.3f, 1e-7f, "a straight line's root, where Newton stands still");
    f = with_root(1.0f, 0.3f, 0.1f);
    tap_check_close(hermite_f32_root(&f, 1.0f), 1.0f, 1e-6f, "a root at the end of the bracket");
    f = cubic(1e-30f, -1.0f, 0.1f, 0.0f);
    tap_check_close(hermite_f32_root(&f, 1.0f), 0.0f, 1e-6f, "a root at its start");
    f = with_root(0.45f, 0.2f, -0.1f);
    tap_check_close(hermite_f32_root(&f, 0.5f), 0.45f, 1e-5f, "a bracket that ends before 1");
    for (uint32_t i = 0u; i < plants_scaled(20000u, 1000u); i++) {
        const float root = plants_random(&state, 0.001f, 1.0f);
        const struct hermite_f32 straight =
            with_root(root, plants_random(&state, -0.2f, 0.2f), plants_random(&state, -0.1f, 0.1f));
        const struct hermite_f32 bent =
            with_root(root, plants_random(&state, -0.4f, 0.4f), plants_random(&state, -0.2f, 0.2f));
        const struct hermite_f32 wild =
            hermite_f32_make(plants_random(&state, 1e-6f, 1.0f), plants_random(&state, -20.0f, 20.0f),
                             plants_random(&state, -1.0f, -1e-6f), plants_random(&state, -20.0f, 20.0f));
        const float place = hermite_f32_root(&wild, 1.0f);

        worst_straight = fmath_max(worst_straight, fmath_abs(hermite_f32_root(&straight, 1.0f) - root));
        worst_bent = fmath_max(worst_bent, fmath_abs(hermite_f32_root(&bent, 1.0f) - root));
        are_inside = are_inside && place >= 0.0f && place <= 1.0f;
    }
    tap_check_close(worst_straight, 0.0f, 5e-6f, "curves as a step meets them, to rounding");
    tap_check_close(worst_bent, 0.0f, 5e-3f, "strongly bent ones nearly");
    tap_check(are_inside, "and no curve leads outside its bracket");
}

static void check_after_start(void)
{
    uint32_t state = 7u;
    float worst = 0.0f;

    for (uint32_t i = 0u; i < plants_scaled(5000u, 500u); i++) {
        const float root = plants_random(&state, 0.05f, 1.0f);
        const float lean = plants_random(&state, -0.2f, 0.2f);
        const struct hermite_f32 f = cubic(0.0f, root, root * lean - 1.0f, -lean); /* t (root - t)(1 + lean t) */

        worst = fmath_max(worst, fmath_abs(hermite_f32_root_after_start(&f) - root));
    }
    tap_check_close(worst, 0.0f, 2e-6f, "a root at the start is divided out and the next one found");
}

static void check_minimum(void)
{
    uint32_t state = 8u;
    float worst = 0.0f;

    for (uint32_t i = 0u; i < plants_scaled(5000u, 500u); i++) {
        const float place = plants_random(&state, 0.01f, 0.99f);
        const float cube = plants_random(&state, -0.15f, 0.15f);
        /* f' = 2 (t - place) + 3 cube (t^2 - place^2) */
        const struct hermite_f32 f = cubic(1.0f, -2.0f * place - 3.0f * cube * place * place, 1.0f, cube);

        worst = fmath_max(worst, fmath_abs(hermite_f32_minimum(&f) - place));
    }
    tap_check_close(worst, 0.0f, 1e-4f, "the place of a minimum");
}

void test_hermite(void)
{
    check_make();
    check_roots();
    check_after_start();
    check_minimum();
}
