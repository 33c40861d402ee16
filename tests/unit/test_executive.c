/* Orders, credit and reports, with this test as both the interrupt and main. */
#include "sim/executive.h"

#include "plants.h"
#include "tap.h"
#include "tests.h"

static struct executive executive;
static struct executive_report report;

static const struct executive_report *look(void)
{
    executive_report(&executive, &report);
    return &report;
}

static uint32_t hash_after(const char *assignments, uint32_t steps)
{
    plants_executive(&executive, assignments);
    executive_grant(&executive, steps);
    plants_spend(&executive);
    return executive.sim.hash;
}

static void check_init(void)
{
    executive_init(&executive, ARITH_F32);
    tap_check(!executive_has_order(&executive) && look()->now.step == 0u && look()->generation == 1u,
              "it starts with the defaults in force");
    tap_check(!executive_wants_tick(&executive) && executive_credit(&executive) == 0u, "without credit");
    plants_ticks(&executive, 5u);
    tap_check(executive.sim.step == 0u && executive.load.ticks == 5u, "so that ticks make no step");
    tap_check(executive_params(&executive)->load_n == 1.0f && executive_plan(&executive)->scale.load_n == 4.0f,
              "main knows the set and its plan");
}

static void check_orders(void)
{
    bool was_reset = true;

    plants_executive(&executive, "N0 1");
    executive_grant(&executive, 100u);
    plants_ticks(&executive, 10u);
    tap_check(plants_order(&executive, "N0 2", false, &was_reset) == ERROR_OK && !was_reset &&
                  executive_has_order(&executive),
              "an order waits");
    tap_check(executive.sim.f32.normal.n == 0.25f && executive_params(&executive)->load_n == 2.0f,
              "the plant has not seen it, main's next set starts from it");
    executive_tick(&executive, false);
    tap_check(!executive_has_order(&executive) && executive.sim.step == 10u && executive_credit(&executive) == 90u &&
                  look()->generation == 3u,
              "a trigger takes it without a step and reports");
    plants_ticks(&executive, 1u);
    tap_check(executive.sim.step == 11u && executive.sim.f32.normal.n == 0.5f, "the next step has it");
    tap_check(plants_order(&executive, "N0 2 spp 128", false, &was_reset) == ERROR_NEEDS_RESTART &&
                  !executive_has_order(&executive),
              "what needs a restart is refused where none may be");
    tap_check(plants_order(&executive, "N0 2 spp 128", true, &was_reset) == ERROR_OK && was_reset &&
                  executive_credit(&executive) == 0u,
              "else it resets and takes the credit");
    plants_ticks(&executive, 1u);
    tap_check(executive.sim.step == 0u && executive.sim.plan->scale.steps_per_period == 128u, "back to step 0");
    tap_check(plants_order(&executive, "N0 -1", true, &was_reset) == ERROR_OUT_OF_RANGE && !was_reset &&
                  plants_order(&executive, "N0 2 spp 128 kt 20", true, NULL) == ERROR_OUT_OF_SCALE &&
                  !executive_has_order(&executive) && executive_params(&executive)->stiffness_contact_n_per_m == 1.0f,
              "a set that is refused orders nothing");
}

/* The order takes the place of the plan before it, which must still be asked what acts. */
static void check_going_on(void)
{
    plants_executive(&executive, "N0 1 v0 1");
    executive_grant(&executive, 100u);
    plants_ticks(&executive, 10u);
    (void)plants_order(&executive, "N0 2", false, NULL);
    plants_ticks(&executive, 10u);
    (void)plants_order(&executive, "N0 1 lag 1e4 speed inertia J 1e6", false, NULL);
    plants_ticks(&executive, 10u);
    tap_check_close(executive.sim.f32.normal.n, 0.5f, 1e-3f,
                    "a lag that an order brings goes on from the force that acts");
    tap_check_close(executive.sim.f32.disc * executive.sim.plan->scale.speed_m_per_s, 1.0f, 1e-3f,
                    "an inertia from the speed");
}

static void check_credit(void)
{
    plants_executive(&executive, "N0 5");
    executive_grant(&executive, 10u);
    executive_grant(&executive, 5u);
    tap_check(executive_credit(&executive) == 15u && executive_wants_tick(&executive), "credit adds up");
    plants_ticks(&executive, 20u);
    tap_check(executive.sim.step == 15u && !executive_wants_tick(&executive) && look()->now.step == 15u,
              "and is used up to the last step, which is reported");
    executive_grant(&executive, 10u);
    plants_ticks(&executive, 4u);
    executive_stop(&executive);
    plants_ticks(&executive, 4u);
    tap_check(executive.sim.step == 19u && executive_credit(&executive) == 0u, "a stop takes the rest");
    executive_free_run(&executive);
    plants_ticks(&executive, 100u);
    tap_check(executive.sim.step == 119u && executive_wants_tick(&executive) && executive_credit(&executive) == 0u,
              "a free run needs none");
    executive_stop(&executive);
    executive_grant(&executive, 1u);
    plants_ticks(&executive, 5u);
    tap_check(executive.sim.step == 120u, "and leaves none");
    word_write(&executive.used, UINT32_MAX - 3u); /* as after a long run */
    word_write(&executive.granted, UINT32_MAX - 3u);
    executive_grant(&executive, 10u);
    plants_ticks(&executive, 20u);
    tap_check(executive.sim.step == 130u, "credit goes on across the wrap at 2^32");
    /* A stop that the interrupt cuts in two may find more used than granted. */
    word_write(&executive.used, word_read(&executive.granted) + 2u);
    tap_check(executive_credit(&executive) == 0u && !executive_wants_tick(&executive), "less than nothing is nothing");
    executive_grant(&executive, 5u);
    plants_ticks(&executive, 20u);
    tap_check(executive.sim.step == 135u, "and nothing is missing from the next grant");
}

/* The trajectory depends on the set and the step's index alone. */
static void check_hashes(void)
{
    const uint32_t steps = plants_scaled(5000u, 2000u);
    const uint32_t hash = hash_after("N0 5 substeps 1", steps);

    tap_check(hash_after("N0 5 substeps 7", steps) == hash && executive.sim.step == steps &&
                  hash_after("N0 5 substeps 64", steps) == hash && executive.sim.step == steps,
              "1, 7 and 64 steps a tick give the same bits, and no step too many");
    plants_executive(&executive, "N0 5");
    executive_free_run(&executive);
    plants_ticks(&executive, steps);
    tap_check(executive.sim.hash == hash, "so does a free run");
    plants_executive(&executive, "N0 5");
    executive_free_run(&executive);
    plants_ticks(&executive, steps / 3u);
    executive_stop(&executive);
    plants_ticks(&executive, 50u);
    executive_grant(&executive, steps - steps / 3u);
    plants_spend(&executive);
    tap_check(executive.sim.hash == hash, "and one that is stopped and goes on by credit");
    plants_executive(&executive, "N0 5");
    executive_grant(&executive, steps);
    plants_ticks(&executive, steps / 2u);
    tap_check(plants_order(&executive, "N0 20.1", false, NULL) == ERROR_OUT_OF_SCALE &&
                  plants_order(&executive, "N0 5 spp 32", false, NULL) == ERROR_NEEDS_RESTART,
              "a load over the latched scale is refused");
    executive_stream(&executive, 10u);
    plants_ticks(&executive, 1u);
    executive_measure(&executive, 10u);
    plants_spend(&executive);
    tap_check(executive.sim.hash == hash, "which changes no bit, as little as a stream and a measurement do");
    tap_check(hash_after("N0 5 alpha -0.003", steps) != hash, "another set does");
}

void test_executive(void)
{
    check_init();
    check_orders();
    check_going_on();
    check_credit();
    check_hashes();
}
