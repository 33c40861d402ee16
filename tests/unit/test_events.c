/* Switches of regime inside a step: the end of stick, crossing, and a peak that only grazes the disc's speed. */
#include "model/step_f32.h"

#include "base/fmath.h"
#include "model/sine.h"
#include "plants.h"
#include "tap.h"
#include "tests.h"

static struct plant plant;
static const struct step_f32 *const pad = &plant.sim.f32;

static float larger_error(float worst, float actual, float expected)
{
    return fmath_max(worst, fmath_abs(actual - expected));
}

/* Under the swinging load of the paper: at the end of stick mu P is what the springs need. */
static void check_exit(void)
{
    const struct scale *scale = &plant.plan.scale;
    float worst = 0.0f;
    uint32_t exits = 0u;

    plants_start(&plant, "N0 5 normal exact");
    for (uint32_t i = 0u; i < 64u * 40u; i++) {
        const float x = pad->x;
        const bool stuck = pad->mode == PLANT_STICK;

        plants_run_steps(&plant, 1u);
        if (stuck && pad->mode != PLANT_STICK && plant_notes(sim_output(&plant.sim)).events == 1u) {
            const float part = (float)plant_notes(sim_output(&plant.sim)).stick / (float)PLANT_SHARE_ONE;
            const uint32_t phase = (i << 26) + (uint32_t)(part * 67108864.0f);
            const float force = 0.25f * (1.0f - fmath_sine_turns(phase + (1u << 30)));
            const float need = scale->damping * pad->disc + scale->stiffness * (x + part * scale->step * pad->disc);

            worst = larger_error(worst, scale->friction * force, fmath_abs(need));
            exits++;
        }
    }
    tap_check(exits >= 30u, "the swinging load ends stick once a period");
    tap_check_close(worst / (scale->friction * 0.25f), 0.0f, 1e-4f, "where mu P is what the springs need");
}

/* tests/golden: fig5_N5, which sticks and crosses; x after 20 periods from a solver of order 22. */
static void check_crossing(void)
{
    uint32_t crossings = 0u;
    bool is_fair = true;

    plants_start(&plant, "N0 5 normal exact spp 64");
    for (uint32_t i = 0u; i < 20u * 64u; i++) {
        const int8_t before = pad->mode;
        struct plant_notes notes;

        plants_run_steps(&plant, 1u);
        notes = plant_notes(sim_output(&plant.sim));
        is_fair = is_fair && pad->mode * (pad->disc - pad->v) >= 0.0f;
        if (before == PLANT_SLIP_PLUS && pad->mode == PLANT_SLIP_MINUS) {
            crossings++;
            is_fair = is_fair && notes.events == 1u && notes.stick == 0u && notes.slip_minus > 0u;
        }
    }
    tap_check(crossings >= 15u && is_fair, "a pad that friction cannot hold crosses, and the mode is the sign of vr");
    tap_check_close(plants_x_m(&plant), 0.230829189f, 1e-4f, "64 steps a period, of a swing of 2 m");
    plants_start(&plant, "N0 5 normal exact spp 128");
    plants_run_periods(&plant, 20u);
    tap_check_close(plants_x_m(&plant), 0.230829189f, 1e-5f, "128 steps are at least ten times as good");
    plants_start(&plant, "N0 5 normal exact spp 128 method naive normal rk4");
    plants_run_periods(&plant, 20u);
    tap_check(fmath_abs(plants_x_m(&plant) - 0.230829189f) > 1e-3f, "RK4 on the raw sign is not");
}

/* Without load the pad swings freely, v = V cos(2 t): here it overtakes the disc in the middle of one step and falls
 * back. */
static void check_graze(void)
{
    const float ratio = 0.997f; /* of the disc's speed to the peak's: above for 2 acos(0.997)/2 = 0.0774785 */
    struct plant_notes notes;
    float peak;

    plants_start(&plant, "N0 0 N_max 4 v0 1 c 0 kt 2 k 2");
    peak = pad->disc / ratio;
    plant.sim.f32.x = -0.5f * peak * sine_f32(16u);
    plant.sim.f32.v = peak * sine_cosine_f32(16u);
    plants_run_steps(&plant, 1u);
    notes = plant_notes(sim_output(&plant.sim));
    tap_check(notes.events == 2u && pad->mode == PLANT_SLIP_PLUS && notes.stick == 0u,
              "a peak inside a step is found from both sides");
    tap_check_close((float)notes.slip_minus / (float)PLANT_SHARE_ONE, 0.0774785f / 0.09817477f, 5e-3f,
                    "for as long as it lasts");
    tap_check_close(pad->v / peak, sine_cosine_f32(16u), 3e-5f, "which does not change the swing");
    plants_start(&plant, "N0 0 N_max 4 v0 1 c 0 kt 2 k 2");
    plant.sim.f32.x = -1.0f;
    plant.sim.f32.v = pad->disc;
    plants_run_steps(&plant, 1u);
    notes = plant_notes(sim_output(&plant.sim));
    tap_check(notes.events == 1u && notes.slip_minus == PLANT_SHARE_ONE && pad->mode == PLANT_SLIP_MINUS,
              "a pad at the disc's speed that is pulled on crosses at once");
}

/* A pad that bounces on a stopped disc switches more often in a few steps than is followed. */
static void check_cap(const char *assignments)
{
    uint32_t capped = 0u;
    uint32_t full = 0u;
    bool is_fair = true;

    plants_start(&plant, assignments);
    for (uint32_t i = 0u; i < 8000u; i++) {
        struct plant_notes notes;

        plants_run_steps(&plant, 1u);
        notes = plant_notes(sim_output(&plant.sim));
        full += notes.events == PLANT_EVENTS_MAX ? 1u : 0u;
        capped += notes.is_capped ? 1u : 0u;
        is_fair = is_fair && notes.events <= PLANT_EVENTS_MAX && notes.stick <= PLANT_SHARE_ONE &&
                  (!notes.is_capped || notes.events == PLANT_EVENTS_MAX);
    }
    tap_check(is_fair && capped > 0u, "no step has more than three switches, and a fourth is told");
    tap_check(full > capped, "three alone are not");
    tap_check(plant.sim.counters.caps == capped && plant.sim.fault == SIM_FAULT_NONE, "such steps are counted");
}

void test_events(void)
{
    check_exit();
    check_crossing();
    check_graze();
    check_cap("spp 16 contact lift kt 0.25 k 0.25 y0 2.5 v0 0 x0 0.3");
    check_cap("spp 16 contact lift kt 0.25 k 0.25 y0 2.5 v0 0 x0 0.3 arith q27");
}
