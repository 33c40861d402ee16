/* Lost contact: pulled at as printed, without pull, and lifted off, which conserves energy at take-off and landing. */
#include "base/fmath.h"
#include "model/step_f32.h"
#include "plants.h"
#include "tap.h"
#include "tests.h"

/* wn = 1 rad/s; the model's units of load and normal displacement are 10 N and 10 m. */
#define UNIT_SET "m 1 ke 1 kt 0.5 k 0.5 N_max 10 v_max 10 "

static struct plant plant;
static const struct step_f32 *const pad = &plant.sim.f32;

/* From 4 N to 1 N where the pad is pressed deepest: y then swings from 7 below to 9 above, in units of the last
 * load. */
static void check_contact(void)
{
    static struct plant other;
    bool is_same = true;
    bool is_free = true;
    bool pulls = false;
    bool flies = true;
    float last_w;

    plants_start(&plant, "N0 4 N1 1 load step t1 1.7206 normal exact");
    plants_start(&other, "N0 4 N1 1 load step t1 1.7206 normal exact contact no_pull");
    for (uint32_t i = 0u; i < 640u; i++) {
        plants_run_steps(&plant, 1u);
        plants_run_steps(&other, 1u);
        is_same = is_same && pad->normal.y == other.sim.f32.normal.y;
        if (pad->normal.y < 0.0f) {
            pulls = pulls || (pad->mode == PLANT_SLIP_PLUS && step_f32_friction(pad, &plant.plan.f32) < -0.01f);
            is_free = is_free && fmath_abs(step_f32_friction(&other.sim.f32, &other.plan.f32)) < 1e-6f &&
                      other.sim.f32.mode != PLANT_STICK;
        }
    }
    tap_check(pulls && plant.sim.counters.lifted > 100u, "bilateral contact pulls, as printed");
    tap_check(is_same && is_free, "without pull y is the same and friction ends with contact");
    plants_start(&other, "N0 4 N1 1 load step t1 1.7206 normal exact contact lift");
    for (uint32_t i = 0u; i < 640u; i++) {
        const bool was_lifted = other.sim.f32.normal.is_lifted;

        last_w = other.sim.f32.normal.w;
        plants_run_steps(&other, 1u);
        if (was_lifted && other.sim.f32.normal.is_lifted) {
            const float rise = other.sim.f32.normal.n * other.plan.scale.step;

            flies = flies && fmath_abs(other.sim.f32.normal.w - last_w - rise) < 1e-6f;
        }
    }
    tap_check(flies && other.sim.counters.lifted > 100u, "a pad that lifts off flies under the load alone");
}

static float energy(const struct normal_f32 *normal)
{
    const float spring = normal->y > 0.0f ? normal->y * normal->y : 0.0f;

    return 0.5f * (normal->w * normal->w + spring) - normal->n * normal->y;
}

/* Swings three times its static displacement, so it leaves the disc in every cycle. */
static void check_lift(const char *assignments, float tolerance)
{
    const struct normal_f32 *normal = &plant.sim.f32.normal;
    float worst = 0.0f;
    float start;
    uint32_t takeoffs = 0u;
    bool was_lifted = false;
    bool is_told = true;

    plants_start(&plant, assignments);
    start = energy(normal);
    for (uint32_t i = 0u; i < 20u * 64u; i++) {
        plants_run_steps(&plant, 1u);
        worst = fmath_max(worst, fmath_abs(energy(normal) - start));
        takeoffs += normal->is_lifted && !was_lifted ? 1u : 0u;
        was_lifted = normal->is_lifted;
        is_told = is_told && normal->is_lifted == (normal->y < 0.0f) &&
                  (normal->y >= 0.0f || plant_notes(sim_output(&plant.sim)).is_lifted);
    }
    tap_check(takeoffs >= 10u && is_told, "a pad that swings far lifts off and lands again and again");
    tap_check_close(worst / 0.045f, 0.0f, tolerance, "located at y = 0, which conserves energy");
}

static void check_gap(void)
{
    float least = 0.0f;
    bool is_told = false;
    bool is_back = false;

    plants_start(&plant, UNIT_SET "N0 1 y0 100 normal exact contact lift");
    for (uint32_t i = 0u; i < 2000u; i++) {
        plants_run_steps(&plant, 1u);
        least = fmath_min(least, plant.sim.f32.normal.y);
        is_told = is_told || plant_notes(sim_output(&plant.sim)).is_gap_held;
        is_back = is_back || (is_told && plant.sim.f32.normal.y > 0.0f);
    }
    tap_check(least == -PLANT_GAP_MAX && is_told && plant.sim.counters.gap_held > 0u, "a gap is held at its limit");
    tap_check(is_back && plant.sim.fault == SIM_FAULT_NONE, "and the pad comes back from there");
}

void test_contact(void)
{
    check_contact();
    check_lift(UNIT_SET "N0 1 y0 3 normal exact contact lift", 1e-5f);
    check_lift(UNIT_SET "N0 1 y0 3 contact lift", 1e-4f);
    check_lift(UNIT_SET "N0 1 y0 3 v0 0.02 normal exact contact lift", 1e-5f);
    check_gap();
}
