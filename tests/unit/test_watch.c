/* A controller falls silent: when that counts as stale, when as too long, what becomes of the force and the verdict,
 * and what leads back; the same to the bit however the steps are cut. */
#include "sim/watch.h"

#include "base/fmath.h"
#include "plants.h"
#include "tap.h"
#include "tests.h"

static struct executive executive;

/* Limits in steps: a half keeps clear of how a product rounds. */
static void open_with(struct params params, float stale, float safe, float ramp)
{
    struct sim_plan plan;

    plants_plan(&plan, &params);
    params.stale_s = stale * plan.scale.step_s;
    params.safe_s = safe * plan.scale.step_s;
    params.ramp_s = ramp * plan.scale.step_s;
    executive_init(&executive, ARITH_F32);
    (void)executive_reset(&executive, &params);
    executive_tick(&executive, false);
}

static void open_stale(const char *assignments, float stale, float safe, float ramp)
{
    open_with(plants_params(assignments), stale, safe, ramp);
}

static enum error demand(float newton, uint64_t step)
{
    const struct input_demand wanted = {.load = INPUT_LOAD_FORCE, .load_value = newton, .step = step};

    return executive_input(&executive, &wanted, NULL);
}

static enum error ask_speed(float m_per_s)
{
    const struct input_demand wanted = {.speed = INPUT_SPEED_DISC, .speed_value = m_per_s};

    return executive_input(&executive, &wanted, NULL);
}

static enum error start_with(float newton)
{
    const struct input_demand wanted = {.load = INPUT_LOAD_FORCE, .load_value = newton, .starts = true};

    return executive_input(&executive, &wanted, NULL);
}

static void run(uint32_t steps)
{
    executive_grant(&executive, steps);
    plants_spend(&executive);
}

static struct sample now(void)
{
    struct executive_report report;

    executive_report(&executive, &report);
    return report.now;
}

static float load_newton(void)
{
    const struct sim *sim = &executive.sim;
    const float load = (int)executive_params(&executive)->arithmetic == ARITH_F32
                           ? sim->f32.normal.n
                           : (float)sim->q27.normal.n / 134217728.0f;

    return load * executive_plan(&executive)->scale.load_n;
}

static bool stands(uint8_t state, float newton) { return now().watch == state && load_newton() == newton; }

static void check_states(void)
{
    open_stale("N0 2 N_max 8", 9.5f, 19.5f, 3.5f);
    run(50u);
    tap_check(stands(WATCH_OFF, 2.0f), "before the first demand nobody is watched");
    (void)demand(4.0f, INPUT_NOW);
    run(10u);
    tap_check(stands(WATCH_FRESH, 4.0f), "ten steps on a demand are fresh");
    run(1u);
    tap_check(stands(WATCH_STALE, 4.0f), "the eleventh is stale, and holds the force");
    (void)demand(4.0f, INPUT_NOW);
    run(10u);
    tap_check(stands(WATCH_FRESH, 4.0f), "a demand makes it fresh again, for as long");
    run(10u);
    tap_check(stands(WATCH_STALE, 4.0f), "stale until too long");
    run(1u);
    tap_check(now().watch == WATCH_SAFE && load_newton() < 4.0f && load_newton() > 2.8f, "then the force goes down");
    run(2u);
    tap_check_close(load_newton(), 4.0f * (1.0f - 3.0f / 3.5f), 1e-5f, "at a constant rate");
    run(1u);
    tap_check(stands(WATCH_SAFE, 0.0f), "to nothing, in its time");
    run(100u);
    tap_check(stands(WATCH_SAFE, 0.0f) && executive.sim.step == 185u, "and the plant goes on");
    tap_check(executive.sim.watch.stales == 2u && executive.sim.watch.safes == 1u, "all of it counted");
}

static void go_safe(const char *assignments)
{
    open_stale(assignments, 4.5f, 8.5f, 7.5f);
    (void)demand(4.0f, INPUT_NOW);
    run(12u);
}

static void check_return(void)
{
    float newton;

    go_safe("N0 2 N_max 8");
    newton = load_newton();
    tap_check(now().watch == WATCH_SAFE && newton > 1.0f && newton < 3.0f, "half way down");
    tap_check(demand(4.0f, INPUT_NOW) == ERROR_SAFE_STATE && demand(4.0f, 100u) == ERROR_SAFE_STATE &&
                  ask_speed(0.5f) == ERROR_SAFE_STATE && executive.inputs_refused == 3u,
              "no demand leads back");
    run(1u);
    tap_check(load_newton() < newton, "nor stops it");
    newton = load_newton();
    tap_check(executive_free_run(&executive) == ERROR_OK && executive_has_order(&executive), "a run does, by an order");
    executive_tick(&executive, false);
    tap_check(now().watch == WATCH_FRESH, "so that main can wait for it");
    executive_tick(&executive, true);
    tap_check(stands(WATCH_FRESH, newton), "fresh, with the force that is left held");
    executive_stop(&executive);
    tap_check(demand(3.0f, INPUT_NOW) == ERROR_OK, "and takes demands");
    run(1u);
    tap_check(stands(WATCH_FRESH, 3.0f), "again");
    run(10u);
    newton = load_newton();
    tap_check(now().watch == WATCH_SAFE && newton > 1.0f && newton < 3.0f,
              "it may be lost again, and half way down again");
    run(30u);
    tap_check(stands(WATCH_SAFE, 0.0f) && executive.sim.watch.safes == 2u, "to nothing");
    tap_check(start_with(5.0f) == ERROR_OK, "a demand that starts");
    run(1u);
    tap_check(stands(WATCH_FRESH, 5.0f), "leads back by itself");
    run(30u);
    (void)plants_order(&executive, "N0 2 N_max 8 spp 128", true, NULL);
    executive_tick(&executive, false);
    run(1u);
    tap_check(stands(WATCH_OFF, 2.0f) && executive.sim.watch.safes == 0u, "and so does a reset, to the profiles");
}

/* A demand that main handed over in the very moment in which the plant became safe. */
static void hand_over_late(float newton, uint64_t step)
{
    const struct input_demand wanted = {.load = INPUT_LOAD_FORCE, .load_value = newton, .step = step};
    struct input input;

    (void)input_derive(&input, &wanted, executive_params(&executive), &executive_plan(&executive)->scale);
    input.epoch = executive.in_force.epoch;
    (void)ring_push(&executive.inputs, &input);
}

/* Demands that were on their way when the plant went safe. */
static void check_voided(void)
{
    const struct input_demand start = {.starts = true};

    open_stale("N0 2 N_max 8", 4.5f, 8.5f, 0.0f);
    (void)demand(4.0f, INPUT_NOW);
    (void)demand(6.0f, 30u);
    (void)demand(7.0f, 200u);
    run(8u);
    executive_grant(&executive, 60u);
    executive_tick(&executive, true);
    (void)demand(5.0f, 40u); /* main has not seen yet that it is too late */
    plants_spend(&executive);
    tap_check(stands(WATCH_SAFE, 0.0f) && executive.sim.counters.inputs == 1u &&
                  executive.sim.counters.inputs_void + executive.inputs_refused == 3u,
              "what waits when the plant becomes safe is void, and so is what comes then");
    hand_over_late(7.0f, INPUT_NOW);
    run(1u);
    tap_check(stands(WATCH_SAFE, 0.0f) && executive.sim.counters.inputs == 1u, "even in that moment");
    hand_over_late(7.0f, 75u);
    (void)start_with(1.0f);
    run(1u);
    tap_check(stands(WATCH_FRESH, 1.0f) && executive.inputs_waiting.count == 0u && demand(3.0f, 100u) == ERROR_OK,
              "only what comes after the start");
    run(6u);
    tap_check(stands(WATCH_STALE, 1.0f), "counts");
    (void)executive_input(&executive, &start, NULL);
    run(1u);
    tap_check(stands(WATCH_STALE, 1.0f), "a start without a demand is none, and no sign of life either");
    open_stale("N0 2 N_max 8", 4.5f, 8.5f, 0.0f);
    for (uint64_t at = 1u; at < 25u; at++) {
        (void)demand(4.0f, 4u * at);
    }
    run(100u);
    tap_check(now().watch == WATCH_FRESH && executive.sim.watch.stales == 0u,
              "demands ahead of time are a sign of life when they are due");
    run(2u);
    tap_check(now().watch == WATCH_STALE, "and not before");
}

static void check_ways_out(void)
{
    const struct input_demand back = {.load = INPUT_LOAD_PROFILE, .speed = INPUT_SPEED_PROFILE};

    open_stale("N0 2 N_max 8", 4.5f, 8.5f, 0.0f);
    (void)demand(4.0f, INPUT_NOW);
    (void)executive_input(&executive, &back, NULL);
    run(100u);
    tap_check(stands(WATCH_OFF, 2.0f), "given back to the profiles, nobody is watched");
    (void)ask_speed(0.5f);
    run(5u);
    tap_check(stands(WATCH_FRESH, 2.0f), "a speed alone is watched too");
    run(9u);
    tap_check(stands(WATCH_SAFE, 0.0f) && executive.sim.f32.disc == executive.sim.input.speed,
              "the profile's force then goes to nothing, the speed stays");
    (void)plants_order(&executive, "N0 3 N_max 8", false, NULL);
    run(10u);
    tap_check(stands(WATCH_SAFE, 0.0f), "a set without limits leads not back");
    open_stale("N0 2 N_max 8", 0.0f, 0.0f, 0.0f);
    (void)demand(4.0f, INPUT_NOW);
    run(plants_scaled(100000u, 2000u));
    tap_check(stands(WATCH_OFF, 4.0f), "without limits nobody is watched");
    (void)plants_order(&executive, "N0 2 N_max 8 stale 1000", false, NULL);
    run(1u);
    tap_check(now().watch == WATCH_FRESH && executive.sim.watch.silence < WATCH_SILENCE_MAX / 2u,
              "a set with limits begins the watch");
    (void)plants_order(&executive, "N0 2 N_max 8", false, NULL);
    run(1u);
    tap_check(now().watch == WATCH_OFF, "and one without ends it");
    open_stale("N0 2 N_max 8", 4.5f, 0.0f, 0.0f);
    (void)demand(4.0f, INPUT_NOW);
    run(plants_scaled(100000u, 2000u));
    tap_check(stands(WATCH_STALE, 4.0f) && executive.sim.watch.safes == 0u, "stale alone holds for ever");
    open_stale("N0 2 N_max 8", 0.0f, 4.5f, 0.0f);
    (void)demand(4.0f, INPUT_NOW);
    run(6u);
    tap_check(stands(WATCH_SAFE, 0.0f) && executive.sim.watch.stales == 0u, "safe alone comes at once");
    tap_check(plants_order(&executive, "N0 2 N_max 8 stale 2 safe 1", false, NULL) == ERROR_OUT_OF_RANGE &&
                  plants_order(&executive, "N0 2 N_max 8 stale 2 safe 2", false, NULL) == ERROR_OK,
              "safe does not come before stale");
}

/* Steps until the propensity is known, from the present one; 0 if it takes too many. */
static uint32_t steps_to_verdict(uint32_t most)
{
    for (uint32_t i = 1u; i <= most; i++) {
        (void)demand(0.5f, INPUT_NOW);
        run(1u);
        if (now().propensity != PROPENSITY_UNKNOWN) {
            return i;
        }
    }
    return 0u;
}

static void check_verdict(void)
{
    enum { WINDOW = 64 * DETECTOR_FRAME_PERIODS * DETECTOR_WINDOW_FRAMES };
    bool is_unknown = true;
    uint32_t full;

    open_stale("N0 0.5", 100.5f, 600.5f, 0.0f);
    full = steps_to_verdict(2u * WINDOW);
    tap_check(full > WINDOW && full < WINDOW + 10u && now().propensity == PROPENSITY_QUIET,
              "with a demand each step the verdict takes a window");
    run(100u);
    tap_check(now().propensity == PROPENSITY_QUIET, "fresh, it stays");
    for (unsigned i = 0u; i < plants_scaled(100u, 30u); i++) {
        run(100u);
        is_unknown = is_unknown && now().propensity == PROPENSITY_UNKNOWN;
    }
    tap_check(is_unknown && now().watch == WATCH_SAFE && executive.sim.watch.stales == 1u,
              "stale and safe nothing is known, however long it lasts");
    (void)start_with(0.5f);
    tap_check(steps_to_verdict(2u * WINDOW) == full, "fresh again it takes a whole window");
    run(200u);
    tap_check(now().watch == WATCH_STALE && now().propensity == PROPENSITY_UNKNOWN, "silent again, unknown again");
    tap_check(steps_to_verdict(2u * WINDOW) == full, "and so on");
}

/* --- The same bits ------------------------------------------------------------------------------------------------ */

struct trace {
    uint32_t hash;
    uint64_t step;
    uint8_t state;
    uint32_t stales, safes;
    float newton;
};

/* Demands, silences and starts over 3000 steps of a brake; the grants cut into pieces. */
static struct trace trace_of(float arith, float substeps, uint32_t piece)
{
    static const struct {
        uint32_t step;
        float newton;
        bool starts;
    } script[] = {{100u, 2000.0f, false}, {140u, 2500.0f, false}, {260u, 1500.0f, false},
                  {700u, 1000.0f, true},  {720u, 2700.0f, false}, {1900u, 2800.0f, true}};
    struct params params = plants_preset("brake", "");
    uint32_t at = 0u;

    params.arithmetic = arith;
    params.steps_per_tick = substeps;
    open_with(params, 77.3f, 170.7f, 333.3f);
    for (unsigned i = 0u; i <= sizeof script / sizeof script[0]; i++) {
        const uint32_t until = i < sizeof script / sizeof script[0] ? script[i].step : 3000u;

        for (uint32_t count; at < until; at += count) {
            count = piece < until - at ? piece : until - at;
            run(count);
        }
        if (until < 3000u) {
            (void)(script[i].starts ? start_with(script[i].newton) : demand(script[i].newton, INPUT_NOW));
        }
    }
    return (struct trace){executive.sim.hash,         executive.sim.step,        now().watch,
                          executive.sim.watch.stales, executive.sim.watch.safes, load_newton()};
}

static bool are_same(const struct trace *a, const struct trace *b)
{
    return a->hash == b->hash && a->step == b->step && a->state == b->state && a->stales == b->stales &&
           a->safes == b->safes && a->newton == b->newton;
}

static void check_bits(float arith)
{
    static const struct {
        float substeps;
        uint32_t piece;
    } cuts[] = {{7.0f, 3000u}, {64.0f, 3000u}, {1.0f, 1u}, {64.0f, 13u}, {7.0f, 50u}};
    const struct trace truth = trace_of(arith, 1.0f, 3000u);
    bool ok = true;

    tap_check(truth.step == 3000u && truth.state == WATCH_SAFE && truth.stales == 4u && truth.safes == 3u &&
                  truth.newton == 0.0f,
              "a run with four silences");
    for (unsigned i = 0u; i < sizeof cuts / sizeof cuts[0]; i++) {
        const struct trace seen = trace_of(arith, cuts[i].substeps, cuts[i].piece);

        ok = ok && are_same(&seen, &truth);
    }
    tap_check(ok, "for 1, 7 and 64 steps a tick and any cut of the grants the same bits");
}

/* The ramp falls by the same amount each step but for rounding, never rises, and ends. */
static void check_ramp(float arith)
{
    struct params params = plants_params("N0 2 N_max 8 v_max 4");
    float last = 5.0f;
    bool is_straight = true;
    uint32_t steps = 0u;

    params.arithmetic = arith;
    open_with(params, 0.0f, 4.5f, 700.0f);
    (void)demand(5.0f, INPUT_NOW);
    run(5u);
    for (; steps < 1000u && load_newton() > 0.0f; steps++) {
        run(1u);
        is_straight = is_straight && fmath_abs(last - load_newton() - 5.0f / 700.0f) < 1e-5f;
        last = load_newton();
    }
    tap_check(is_straight && steps == 700u, "a straight line down, that ends in its time");
}

/* --- Free run: the wall's time ------------------------------------------------------------------------------------ */

static void tick_free(uint32_t count)
{
    for (; count > 0u; count--) {
        executive_tick(&executive, true);
    }
}

static void check_free_run(void)
{
    plants_executive(&executive, "N0 2 N_max 8 tick 100 substeps 7 stale 0.0995 safe 0.1995 ramp 0.0995");
    (void)demand(4.0f, INPUT_NOW);
    (void)executive_free_run(&executive);
    tick_free(10u);
    tap_check(executive.sim.watch.state == WATCH_FRESH && executive.sim.step == 70u, "0.1 s of ticks");
    tick_free(1u);
    tap_check(executive.sim.watch.state == WATCH_STALE, "is what it may be silent");
    tick_free(9u);
    tap_check(executive.sim.watch.state == WATCH_STALE && load_newton() == 4.0f, "0.2 s");
    tick_free(1u);
    tap_check(executive.sim.watch.state == WATCH_SAFE && now().watch == WATCH_SAFE,
              "is too long, and main knows at once");
    tick_free(10u);
    tap_check(load_newton() == 0.0f && executive.sim.step == 217u, "the ramp goes by the wall's time too");
    plants_executive(&executive, "N0 2 N_max 8 tick 100 substeps 7 stale 0.0995 safe 0.1995");
    (void)demand(4.0f, INPUT_NOW);
    run(10000u);
    tap_check(now().watch == WATCH_SAFE, "locked it is the plant's time");
}

/* Ticks that are late or shed make no steps, but the time is gone. */
static void check_overrun(void)
{
    plants_executive(&executive, "N0 2 N_max 8 tick 100 substeps 7 stale 0.0995");
    executive_begin_rate(&executive, 1000u);
    (void)demand(4.0f, INPUT_NOW);
    (void)executive_free_run(&executive);
    tick_free(1u);
    (void)executive_book(&executive, 3500u, 1000u, true);
    tick_free(4u); /* shed */
    tap_check(executive.load.shed == 4u && executive.sim.step == 7u, "a tick of 3.5 periods");
    tick_free(4u);
    tap_check(executive.sim.watch.state == WATCH_STALE && executive.sim.step == 35u, "counts for what it took");
}

void test_watch(void)
{
    check_states();
    check_return();
    check_voided();
    check_ways_out();
    check_verdict();
    check_bits((float)ARITH_F32);
    check_bits((float)ARITH_Q27);
    check_ramp((float)ARITH_F32);
    check_ramp((float)ARITH_Q27);
    check_free_run();
    check_overrun();
}
