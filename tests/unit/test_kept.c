/* What the plant and the detector keep between steps follows from the rest of their state: beside a twin that makes all
 * of it anew before every step, a run stays the same whatever changes on the way. */
#include "base/assert.h"
#include "base/mem.h"
#include "plants.h"
#include "sim/snapshot.h"
#include "tap.h"
#include "tests.h"

static struct sim_plan plans[2];
static struct sim sim, twin;
static struct input_queue none;
static uint8_t image[SNAPSHOT_SIZE];

/* Each alone changes the usual step, or the motion of y; the last ones take it back. */
static const char *const changes[] = {"mu_s 0.5",
                                      "N0 0.2",
                                      "v0 -0.4",
                                      "alpha -0.02",
                                      "mu_floor 0.2",
                                      "kt 0.3",
                                      "c 0.2",
                                      "N0 1.5",
                                      "load sine N0 1 N1 0.8 fN 0.2",
                                      "speed inertia v0 0.7 J 5",
                                      "rough 0.05 runout 0.2",
                                      "load constant N0 0.5 rough 0 runout 0 lag 3",
                                      "mu_floor -1e30 lag 0",
                                      "speed ramp v0 1 v1 -1 tv1 0 tv2 400",
                                      "load pulses N1 0 rise 1 hold 2 fall 1 every 9",
                                      "load constant N0 1 speed constant v0 0.8 c 0.01 alpha -0.002"};

static void renew(void)
{
    twin.is_usual = false;
    detector_empty_bands(&twin.detector);
    if (twin.plan->arithmetic == ARITH_Q27) {
        step_q27_adopt(&twin.q27, &twin.plan->q27);
    } else {
        step_f32_adopt(&twin.f32, &twin.plan->f32);
    }
}

/* Put back from an image, where nothing is left of what was kept. */
static void put_back(void)
{
    const struct sim_plan *plan = twin.plan;

    snapshot_take(image, &twin, &none);
    memset(&twin, 0xa5, sizeof twin);
    snapshot_restore(image, &twin, &none);
    sim_resume(&twin, plan);
}

/* The same change of both. */
static void change(struct params *params, const char *assignments, struct sim_plan *plan)
{
    plants_assign(params, assignments);
    BASE_ASSERT(sim_plan_make(plan, params, &sim.plan->scale).error == ERROR_OK);
    sim_apply(&sim, plan);
    sim_apply(&twin, plan);
}

static bool are_same(void)
{
    return sim.hash == twin.hash && memcmp(&sim.counters, &twin.counters, sizeof sim.counters) == 0 &&
           sim.detector.verdict.variance == twin.detector.verdict.variance &&
           sim.detector.verdict.stick == twin.detector.verdict.stick &&
           sim.detector.verdict.motion == twin.detector.verdict.motion;
}

static void check_twin(const char *assignments)
{
    struct params params = plants_params(assignments);
    uint32_t dice = 5u;
    bool same = true;

    plants_plan(&plans[0], &params);
    sim_reset(&sim, &plans[0]);
    sim_reset(&twin, &plans[0]);
    for (uint32_t place = plants_scaled(600u, 40u); place > 0u; place--) {
        for (uint32_t steps = 1u + tap_random(&dice) % 97u; steps > 0u; steps--) {
            renew();
            same = sim_step(&sim) == sim_step(&twin) && same;
        }
        same = same && are_same() && sim.fault == SIM_FAULT_NONE;
        if (!same) {
            break;
        }
        put_back();
        change(&params, changes[tap_random(&dice) % (sizeof changes / sizeof changes[0])],
               &plans[sim.plan == &plans[0] ? 1 : 0]);
    }
    tap_check(same && sim.counters.events > 10u, assignments);
}

/* Contact is lost, and the friction with it, where y < 0: no usual way serves there. */
static void check_lifted(const char *assignments)
{
    static struct plant plant;
    uint32_t below = 0u;

    plants_start(&plant, assignments);
    for (uint32_t i = 0u; i < 1000u; i++) {
        (void)sim_step(&plant.sim);
        below += plant.sim.f32.normal.y < 0.0f ? 1u : 0u;
    }
    tap_check(below > 100u && plant.sim.counters.lifted >= below, assignments);
}

void test_kept(void)
{
    check_twin("normal exact contact no_pull y0 1.5 N_max 4");
    check_twin("normal exact x0 0.3 N_max 4");
    check_twin("cn 0.05 normal exact yd0 2 N_max 4 spp 32");
    check_twin("contact no_pull y0 2.5 N_max 4");
    check_twin("contact lift normal exact y0 1.5 N_max 4");
    check_twin("arith q27 normal exact contact no_pull y0 1.5 N_max 4");
    check_twin("arith q27 contact no_pull y0 2.5 N_max 4");
    check_twin("arith q27 normal exact x0 0.3 N_max 4 spp 128");
    check_lifted("normal exact contact no_pull y0 2.5");
    check_lifted("normal exact contact no_pull load step N0 1 N1 0.3 t1 1.7");
}
