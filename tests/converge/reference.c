/* The reference solver of tests/oracle, looked at in equal times. */
#include "walk.h"

#include <math.h>

#include "tests/oracle/orbit.h"

bool walk_reference(const struct walk_case *which, struct walk *walk)
{
    const struct plant plant = {.mass_kg = 0.3,
                                .damping_n_s_per_m = 0.01,
                                .disc_m_per_s = 1.0,
                                .friction_static_ratio = 0.3,
                                .friction_slope_s_per_m = which->slope_s_per_m,
                                .normal_n_per_m = 1.0,
                                .contact_n_per_m = 1.0,
                                .caliper_n_per_m = 1.0,
                                .load_n = which->load_n,
                                .friction_floor_ratio = -1e30};
    const double look_s = plant_period_s(&plant) / WALK_LOOKS;
    struct orbit orbit;
    int looks = 0;

    orbit_start(&orbit, &plant);
    while (looks < WALK_COUNT) {
        struct orbit_piece piece;
        const bool goes_on = orbit_advance(&orbit, WALK_COUNT * look_s, &piece);

        while (looks < WALK_COUNT && (looks + 1) * look_s <= (piece.start_s + piece.duration_s) * (1.0 + 1e-14)) {
            walk->x_m[looks] = polynomial_value(&piece.phase.x, (looks + 1) * look_s - piece.start_s);
            looks++;
        }
        if (!goes_on) {
            return looks == WALK_COUNT;
        }
    }
    return true;
}

double walk_error(const struct walk *walk, const struct walk *truth)
{
    double error = 0.0, size = 0.0;

    for (int i = 0; i < WALK_COUNT; i++) {
        const double distance = fabs(walk->x_m[i] - truth->x_m[i]);

        error = distance <= error ? error : distance; /* a NaN is an error too */
        size = fmax(size, fabs(truth->x_m[i]));
    }
    return error / size;
}
