/* A controller's demands: in which units, from which step, and what becomes of those that come too late, too many, too
 * large. */
#include "sim/input.h"

#include "base/fmath.h"
#include "bench.h"
#include "plants.h"
#include "tap.h"
#include "tests.h"

static struct executive executive;

static struct input derive(const struct input_demand *demand, bool *is_clamped)
{
    struct sim_plan plan;
    struct input input;
    const struct params params = plants_preset("brake", "rough 0 runout 0");

    plants_plan(&plan, &params);
    *is_clamped = input_derive(&input, demand, &plan.params, &plan.scale);
    return input;
}

static void check_units(void)
{
    const struct input_demand direct = {INPUT_LOAD_FORCE, INPUT_SPEED_DISC, 3000.0f, 0.5f, 7u, false};
    const struct input_demand engineer = {INPUT_LOAD_PRESSURE, INPUT_SPEED_VEHICLE, 1e6f, 3.1f, 7u, false};
    const struct input_demand large = {INPUT_LOAD_FORCE, INPUT_SPEED_DISC, 13000.0f, -2.5f, 7u, false};
    const struct input_demand negative = {INPUT_LOAD_FORCE, INPUT_SPEED_KEEP, -1.0f, 0.0f, 7u, false};
    bool is_clamped;
    struct input input = derive(&direct, &is_clamped);

    tap_check(input.load == 0.25f && input.load_q27 == 1 << 25 && input.speed == 0.25f && input.speed_q27 == 1 << 25 &&
                  !is_clamped,
              "force and disc speed, in either arithmetic");
    input = derive(&engineer, &is_clamped);
    tap_check_close(input.load * 12000.0f, 2290.0f, 1e-3f, "pressure times the piston's area");
    tap_check_close(input.speed * 2.0f, 3.1f * 0.11f / 0.31f, 1e-6f, "vehicle speed by the radii");
    input = derive(&large, &is_clamped);
    tap_check(input.load == 1.0f && input.speed == -1.0f && is_clamped,
              "what the scale does not hold is held at the limit");
    input = derive(&negative, &is_clamped);
    tap_check(input.load == 0.0f && is_clamped && !input.sets_speed, "a pad is not pulled");
}

static bool demand(float newton, uint64_t step)
{
    const struct input_demand wanted = {.load = INPUT_LOAD_FORCE, .load_value = newton, .step = step};

    return executive_input(&executive, &wanted, NULL) == ERROR_OK;
}

static void run(uint32_t steps)
{
    executive_grant(&executive, steps);
    plants_spend(&executive);
}

static float load_newton(void) { return executive.sim.f32.normal.n * executive_plan(&executive)->scale.load_n; }

static void check_steps(void)
{
    plants_executive(&executive, "N0 2 N_max 8");
    tap_check(demand(4.0f, 10u) && demand(3.0f, 5u), "demands in any order");
    run(5u);
    tap_check_close(load_newton(), 2.0f, 0.0f, "the profile acts until the first");
    run(1u);
    tap_check_close(load_newton(), 3.0f, 0.0f, "step 5 has it");
    run(4u);
    tap_check_close(load_newton(), 3.0f, 0.0f, "it is held");
    run(1u);
    tap_check_close(load_newton(), 4.0f, 0.0f, "until the next");
    tap_check(demand(5.0f, 3u) && demand(6.0f, INPUT_NOW), "one that is late, one for now");
    run(1u);
    tap_check_close(load_newton(), 6.0f, 0.0f, "are taken at once, in the order in which they came");
    tap_check(executive.sim.counters.inputs == 4u && executive.sim.counters.inputs_late == 1u, "and counted");
    (void)demand(7.0f, 1000u);
    (void)plants_order(&executive, "N0 2 N_max 8 spp 128", true, NULL);
    plants_ticks(&executive, 1u);
    run(1200u);
    tap_check_close(load_newton(), 2.0f, 0.0f, "a reset voids what waits, and the profile acts again");
}

static void check_full(void)
{
    uint32_t taken = 0u;

    plants_executive(&executive, "N0 2 N_max 8");
    while (taken < 100u && demand(3.0f, 1000u)) {
        taken++;
        if (taken % 3u == 0u) {
            run(1u);
        }
    }
    tap_check(taken == INPUT_QUEUE_MAX && executive.inputs_refused == 1u, "as many as can wait, the next is refused");
    tap_check(demand(5.0f, INPUT_NOW), "but not one for now");
    run(1u);
    tap_check_close(load_newton(), 5.0f, 0.0f, "which is taken at once");
    run(1100u);
    tap_check(executive.sim.counters.inputs == taken + 1u && executive.sim.counters.inputs_late == 0u,
              "none of all is lost");
    tap_check(demand(6.0f, 5000u) && demand(7.0f, 5000u), "two for the same step");
    run(5000u - (uint32_t)executive.sim.step + 1u);
    tap_check_close(load_newton(), 7.0f, 0.0f, "the later one holds");
}

static void check_reset(void)
{
    plants_executive(&executive, "N0 2 N_max 8");
    (void)demand(3.0f, 1u);
    run(3u);
    (void)demand(4.0f, 1u);
    run(1u);
    tap_check(executive.sim.counters.inputs_late == 1u, "one late");
    (void)demand(5.0f, 50u);
    run(1u);
    (void)demand(6.0f, INPUT_NOW);
    (void)plants_order(&executive, "N0 2 N_max 8 spp 128", true, NULL);
    executive_tick(&executive, false);
    tap_check(executive.sim.counters.inputs_late == 0u && executive.sim.counters.inputs == 0u &&
                  executive.inputs_waiting.count == 0u,
              "a reset begins the count anew");
    run(100u);
    tap_check_close(load_newton(), 2.0f, 0.0f, "and voids what waited and what was on its way");
    (void)demand(7.0f, INPUT_NOW);
    (void)plants_order(&executive, "N0 3 N_max 8 spp 128", false, NULL);
    run(1u);
    tap_check_close(load_newton(), 7.0f, 0.0f, "a live change voids nothing");
    (void)plants_order(&executive, "N0 3 N_max 8 spp 128 rough 0.1 runout 0.5", false, NULL);
    run(1u);
    tap_check(executive.sim.input.load * 8.0f < 4.8f && executive.sim.counters.lowered == 1u,
              "but lowers a force that a new surface would lift beyond the scale");
}

/* A sine of the load explains no motion while a controller holds the load. */
static void check_share(void)
{
    plants_executive(&executive, "N0 2 N1 1 load sine fN 0.2 N_max 8");
    tap_check(executive.sim.detector.config.load_response > 0, "a sine explains motion");
    (void)demand(2.0f, INPUT_NOW);
    run(1u);
    tap_check(executive.sim.detector.config.load_response == 0, "a held load has none");
    (void)plants_order(&executive, "N0 2 N1 1 load sine fN 0.2 N_max 8 c 0.02", false, NULL);
    run(1u);
    tap_check(executive.sim.detector.config.load_response == 0, "after a new set either");
}

/* The same demands at the same steps, with other ticks and grants. */
static uint32_t hash_with(uint32_t substeps, uint32_t grant, const char *arithmetic)
{
    struct params params = plants_preset("brake", arithmetic);

    executive_init(&executive, ARITH_F32);
    params.steps_per_tick = (float)substeps;
    (void)executive_reset(&executive, &params);
    (void)executive_tick(&executive, false);
    for (uint32_t i = 0u; i < 8u; i++) {
        (void)demand(1000.0f + 250.0f * (float)i, 100u + 333u * i);
    }
    while (executive.sim.step < 4000u) {
        run(grant < 4000u - (uint32_t)executive.sim.step ? grant : 4000u - (uint32_t)executive.sim.step);
    }
    return executive.sim.hash;
}

static void check_bits(void)
{
    tap_check(hash_with(1u, 4000u, "") == hash_with(7u, 97u, "") && hash_with(1u, 4000u, "") == hash_with(64u, 1u, ""),
              "neither ticks nor grants change a bit");
    tap_check(hash_with(1u, 4000u, "arith q27") == hash_with(64u, 97u, "arith q27"), "in fixed point either");
}

static void check_console(void)
{
    bench_open();
    (void)bench_say("preset brake\r");
    tap_check_text(bench_say("input N 2500 v0 0.2 at 10\r"), "ok input clamped=no", "by hand");
    tap_check_text(bench_say("input pressure 1e8\r"), "ok input clamped=yes", "a limit is told");
    (void)bench_say("step 100\r");
    tap_check(bench_holds(bench_say("status\r"), " inputs=2 inputs_late=0 inputs_clamped=1 inputs_refused=0 "),
              "and counted");
    tap_check(bench_holds(bench_say("verdict\r"), " predicted=squeal predicted_growth_per_s=4") ||
                  bench_holds(bench.last, " predicted=squeal predicted_growth_per_s=5"),
              "the closed form is asked about what is held");
    tap_check_text(bench_say("input profile\r"), "ok input clamped=no", "back to the profiles");
    tap_check(bench_starts(bench_say("input\r"), "error usage input ") &&
                  bench_starts(bench_say("input N\r"), "error usage") &&
                  bench_starts(bench_say("input N 1 pressure 2\r"), "error usage") &&
                  bench_starts(bench_say("input at 3\r"), "error usage") &&
                  bench_starts(bench_say("input N 1 at\r"), "error usage"),
              "what does not fit is refused");
    tap_check(bench_starts(bench_say("input N x\r"), "error bad-number x: ") &&
                  bench_starts(bench_say("input N 1 at 0\r"), "error out-of-range at=0: 1 .. 4294967295"),
              "with the reason");
}

void test_input(void)
{
    check_units();
    check_steps();
    check_full();
    check_reset();
    check_share();
    check_bits();
    check_console();
}
