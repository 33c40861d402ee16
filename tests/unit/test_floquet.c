/* Growth of permanent slip and eigenvalues against thresholds measured with the reference solver. */
#include "analysis/floquet.h"

#include "analysis/eigen.h"
#include "base/fmath.h"
#include "plants.h"
#include "tap.h"
#include "tests.h"

/* N |alpha|/c at which slip begins to grow, by bisection. */
static float threshold(float damping, float stiffness, float share)
{
    float low = 0.0f, high = 2.0f;

    for (int i = 0; i < 24; i++) {
        const float middle = 0.5f * (low + high);
        const struct floquet_problem problem = {damping, -middle * damping, stiffness, share};

        if (floquet_rate(&problem) > 0.0f) {
            high = middle;
        } else {
            low = middle;
        }
    }
    return 0.5f * (low + high);
}

static void check_thresholds(void)
{
    tap_check_close(threshold(0.018f, 2.0f, 1.0f), 1.0f, 1e-3f, "N |alpha| = c away from the tongue");
    tap_check_close(threshold(0.018f, 0.25f, 1.0f), 0.667f, 1e-3f, "2/3 of it in the tongue at Z2 = 1/4");
    tap_check_close(threshold(0.018f, 0.25f, 0.0f), 1.0f, 1e-3f, "not without the normal oscillation");
    tap_check_close(threshold(1.0f, 0.5f, 1.0f), 0.81f, 0.01f, "0.81 at Z2 = 0.5 for C = 1");
    tap_check_close(threshold(1.0f, 0.2f, 1.0f), 0.69f, 0.045f, "0.655 to 0.73 over Z2 = 0.2 to 0.3 for C = 1");
    tap_check_close(threshold(1.0f, 0.3f, 1.0f), 0.69f, 0.045f, "at both ends");
}

static void check_closed_form(void)
{
    uint32_t seed = 5u;
    float largest = 0.0f;

    for (uint32_t i = 0u; i < plants_scaled(400u, 20u); i++) {
        const float damping = plants_random(&seed, 0.001f, 0.02f);
        const struct floquet_problem problem = {damping, -plants_random(&seed, 0.0f, 2.0f) * damping,
                                                plants_random(&seed, 0.05f, 6.0f), plants_random(&seed, 0.0f, 1.0f)};

        largest = fmath_max(largest, fmath_abs(floquet_rate(&problem) - floquet_rate_closed(&problem)));
    }
    tap_check(largest < 1e-4f, "the closed form");
    tap_check_close(floquet_rate(&(struct floquet_problem){0.018f, -0.03f, 2.0f, 0.0f}), 0.006f, 2e-6f,
                    "constant damping exactly");
}

static void check_eigen(void)
{
    struct eigen mode = eigen_of(-0.02f, 0.475f);

    tap_check_close(mode.real, 0.01f, 1e-7f, "negative damping grows by half of it");
    tap_check_close(mode.imaginary, 0.68912f, 1e-5f, "at the natural frequency");
    tap_check_close(mode.damping_ratio, -0.0145095f, 1e-6f, "damping ratio");
    mode = eigen_of(3.0f, 2.0f);
    tap_check(mode.imaginary == 0.0f && fmath_abs(mode.real + 1.0f) < 1e-6f, "overdamped: the slower one");
    mode = eigen_of(-1.0f, 0.0f);
    tap_check(mode.real == 1.0f && mode.damping_ratio == -1.0f, "without a spring");
    tap_check_close(eigen_outer_speed(0.3f, -0.02f, 0.01f), 38.197f, 1e-2f, "outer cycle: V* = 38.2");
    tap_check(!fmath_is_finite(eigen_outer_speed(0.3f, -0.01f, 0.02f)), "none where slip dies out");
}

void test_floquet(void)
{
    check_thresholds();
    check_closed_form();
    check_eigen();
}
