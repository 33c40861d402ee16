/* The acting process: limits, lag, dither, and an inertia that the pad brakes. */
#include "sim/acting.h"

#include "base/fixed.h"
#include "base/fmath.h"
#include "plants.h"
#include "tap.h"
#include "tests.h"

/* wn = 1 rad/s, so a step takes 2 pi/64 s; the model's units are 10 N and 10 m/s. */
#define UNIT_SET "m 1 ke 1 mu_s 0.1 N_max 10 v_max 10 "
#define STEP_S 0.0981747704f
#define Q27 134217728.0f

static struct plant plant;
static struct plant twin;

/* What is held over the next step, N and m/s. */
static float load_now(void)
{
    const struct sim_plan *plan = &plant.plan;

    return plan->scale.load_n * (plan->arithmetic == ARITH_Q27
                                     ? (float)acting_value_q27(&plan->load, &plant.sim.load, plant.sim.step) / Q27
                                     : acting_value_f32(&plan->load, &plant.sim.load, plant.sim.step));
}

static float speed_now(void)
{
    const struct sim_plan *plan = &plant.plan;

    return plan->scale.speed_m_per_s *
           (plan->arithmetic == ARITH_Q27
                ? (float)acting_value_q27(&plan->speed, &plant.sim.speed, plant.sim.step) / Q27
                : acting_value_f32(&plan->speed, &plant.sim.speed, plant.sim.step));
}

static void start(const char *assignments, float arith)
{
    struct params params = plants_params(assignments);

    params.arithmetic = arith;
    plants_plan(&plant.plan, &params);
    sim_reset(&plant.sim, &plant.plan);
}

/* --- Limits, lag, dither ------------------------------------------------------------------------------------------ */

/* 1 - e^-x without the function under test. */
static float rise(float x) { return 1.0f - fmath_exp2(-1.44269504f * x); }

static void check_limits(float arith)
{
    float worst = 0.0f;

    start(UNIT_SET "load ramp N0 1 N1 9 t1 0 t2 9.81747704 N_off -2 N_low 1 N_high 5 v0 2 v_off 3 v_high 4", arith);
    for (uint32_t i = 0u; i < 120u; i++) {
        const float line = fmath_min(1.0f + 0.08f * ((float)i + 0.5f), 9.0f) - 2.0f;

        worst = fmath_max(worst, fmath_abs(load_now() - fmath_min(fmath_max(line, 1.0f), 5.0f)));
        plants_run_steps(&plant, 1u);
    }
    tap_check_close(worst, 0.0f, 1e-5f, "base and offset, then the limits, at every step");
    tap_check_close(speed_now(), 4.0f, 1e-6f, "of the speed too");
    start(UNIT_SET "load sine N0 2 N1 6 fN 0.1", arith);
    worst = 1.0f;
    for (uint32_t i = 0u; i < 400u; i++) {
        worst = fmath_min(worst, load_now());
        plants_run_steps(&plant, 1u);
    }
    tap_check(worst == 0.0f, "a sine does not pull: no force is below 0");
}

static void check_lag(float arith)
{
    float worst = 0.0f;

    start(UNIT_SET "load step N0 1 N1 6 t1 0 lag 2.5 v0 4 speed step v1 -3 tv1 0.981747704 v_lag 0.3", arith);
    for (uint32_t i = 0u; i < 600u; i++) {
        const float t = ((float)i + 0.5f) * STEP_S;
        const float late = t - 10.0f * STEP_S;

        worst = fmath_max(worst, fmath_abs(load_now() - (1.0f + 5.0f * rise(t / 2.5f))));
        worst = fmath_max(worst, fmath_abs(speed_now() - (4.0f - 7.0f * rise(fmath_max(late, 0.0f) / 0.3f))));
        plants_run_steps(&plant, 1u);
    }
    tap_check_close(worst, 0.0f, 2e-5f, "a lag answers a step with 1 - e^-t/lag, exactly in the middle of each step");
    plants_run_steps(&plant, 2000u);
    tap_check_close(load_now(), 6.0f, 3e-7f, "and gets there, however small its last steps");
    start(UNIT_SET "load step N0 1 N1 6 t1 0 lag 1e4", arith);
    plants_run_steps(&plant, plants_scaled(20000u, 2000u));
    tap_check_close((load_now() - 1.0f) / (5.0f * rise(((float)plant.sim.step + 0.5f) * STEP_S / 1e4f)), 1.0f, 1e-4f,
                    "a slow one does not stall on rounding");
}

static void check_dither(float arith)
{
    float worst = 0.0f;

    start(UNIT_SET "N0 3 dither 1 f_dither 0.5 v0 2 v_dither 0.5 fv_dither 0.25", arith);
    for (uint32_t i = 0u; i < 300u; i++) {
        const float turns = ((float)i + 0.5f) * STEP_S;
        const uint32_t load = (uint32_t)((0.5f * turns - (float)(int32_t)(0.5f * turns)) * 4294967040.0f);
        const uint32_t speed = (uint32_t)((0.25f * turns - (float)(int32_t)(0.25f * turns)) * 4294967040.0f);

        worst = fmath_max(worst, fmath_abs(load_now() - 3.0f - fmath_sine_turns(load)));
        worst = fmath_max(worst, fmath_abs(speed_now() - 2.0f - 0.5f * fmath_sine_turns(speed)));
        plants_run_steps(&plant, 1u);
    }
    tap_check_close(worst, 0.0f, 2e-4f, "dither is a sine on top");
    start(UNIT_SET "N0 0.1 dither 1 f_dither 0.5", arith);
    worst = 1.0f;
    for (uint32_t i = 0u; i < 100u; i++) {
        worst = fmath_min(worst, load_now());
        plants_run_steps(&plant, 1u);
    }
    tap_check(worst == 0.0f, "of a force that stays above 0");
}

/* --- Inertia ------------------------------------------------------------------------------------------------------ */

static void start_stop(struct plant *which, float arith, const char *assignments)
{
    struct params params = plants_preset("brake", assignments);

    params.arithmetic = arith;
    plants_plan(&which->plan, &params);
    sim_reset(&which->sim, &which->plan);
}

static float friction_n(void)
{
    const struct sim *sim = &plant.sim;

    return plant.plan.scale.force_n * (plant.plan.arithmetic == ARITH_Q27
                                           ? (float)step_q27_friction(&sim->q27, &plant.plan.q27) / Q27
                                           : step_f32_friction(&sim->f32, &plant.plan.f32));
}

/* J dOmega = - integral of pads F R dt, with R 0.11 m, J 0.05 kg m2, two pads. */
static void check_balance(float arith)
{
    float impulse = 0.0f;
    float rest = 0.0f;
    float balance = 0.0f;
    float loss = 0.0f;
    bool falls = true;

    start_stop(&plant, arith, "v0 1.5 speed inertia J 0.05 load constant N0 1000 y0 1e-5");
    for (uint32_t i = 0u; i < 30000u && speed_now() != 0.0f; i++) {
        const float before = speed_now();

        plants_run_steps(&plant, 1u);
        if (speed_now() != 0.0f) {
            impulse = fmath_add_kept(impulse, friction_n() * plant.plan.scale.step_s, &rest);
            loss = 0.05f * (1.5f - speed_now()) / 0.11f;
            balance = fmath_max(balance, fmath_abs(loss - 2.0f * 0.11f * impulse));
            falls = falls && (speed_now() <= before || friction_n() < 0.0f);
        }
    }
    tap_check(loss > 0.1f, "friction takes the disc's momentum");
    tap_check_close(balance / 0.6818f, 0.0f, 3e-6f, "as much as the integral of its torque, at every step");
    tap_check(falls, "and gives nothing");
    plants_run_steps(&plant, 5000u);
    tap_check(speed_now() == 0.0f && acting_is_steady(&plant.plan.speed, &plant.sim.speed, plant.sim.step,
                                                      plant.plan.arithmetic == ARITH_Q27),
              "until it stands, and then it stands");
}

/* A great inertia loses less in a step than a float can tell. */
static void check_small_losses(float arith)
{
    const uint32_t steps = plants_scaled(40000u, 4000u);
    float impulse = 0.0f;
    float rest = 0.0f;

    start_stop(&plant, arith, "v0 1.5 speed inertia J 2000 load constant N0 1000 alpha 0 c 200");
    for (uint32_t i = 0u; i < steps; i++) {
        plants_run_steps(&plant, 1u);
        impulse = fmath_add_kept(impulse, friction_n() * plant.plan.scale.step_s, &rest);
    }
    tap_check_close((1.5f - speed_now()) * 2000.0f / (0.11f * 0.11f) / (2.0f * impulse), 1.0f,
                    plant.plan.arithmetic == ARITH_Q27 || tap_is_hosted() ? 0.02f : 0.2f, "which adds up all the same");
}

static void check_mirror(float arith)
{
    bool ok = true;

    start_stop(&plant, arith, "v0 1.5 speed inertia J 0.05 v_lag 0.001 runout 0 x0 1e-6");
    start_stop(&twin, arith, "v0 -1.5 speed inertia J 0.05 v_lag 0.001 runout 0 x0 -1e-6");
    for (uint32_t i = 0u; i < plants_scaled(30000u, 3000u); i++) {
        plants_run_steps(&plant, 1u);
        plants_run_steps(&twin, 1u);
        ok = ok && sim_output(&plant.sim)->disc == -sim_output(&twin.sim)->disc &&
             sim_output(&plant.sim)->x == -sim_output(&twin.sim)->x &&
             plant.sim.speed.inertia.value == -twin.sim.speed.inertia.value &&
             plant.sim.speed.inertia.value_q56 == -twin.sim.speed.inertia.value_q56;
    }
    tap_check(ok, "the other way round it is its mirror image, to the bit");
}

static void check_alike(void)
{
    float worst = 0.0f;

    start_stop(&plant, (float)ARITH_F32, "v0 1.5 speed inertia J 0.05 alpha 0 c 200 lag 0.003 cn 20");
    start_stop(&twin, (float)ARITH_Q27, "v0 1.5 speed inertia J 0.05 alpha 0 c 200 lag 0.003 cn 20");
    for (uint32_t i = 0u; i < plants_scaled(20000u, 2000u); i++) {
        plants_run_steps(&plant, 1u);
        plants_run_steps(&twin, 1u);
        worst = fmath_max(worst, fmath_abs(plant.sim.f32.disc - (float)twin.sim.q27.disc / Q27));
    }
    tap_check_close(worst, 0.0f, 2e-6f, "in integers it is the same stop");
    tap_check(plant.sim.counters.saturations == 0u && twin.sim.counters.saturations == 0u, "which saturates nothing");
}

/* --- While it runs ------------------------------------------------------------------------------------------------ */

static void apply(const char *assignments)
{
    static struct sim_plan next;
    struct params params = plants_params(assignments);

    params.arithmetic = plant.plan.params.arithmetic;
    (void)sim_plan_make(&next, &params, &plant.plan.scale);
    sim_apply(&plant.sim, &next);
    plant.plan = next;
    plant.sim.plan = &plant.plan;
}

static void check_live(float arith)
{
    const struct input held = {.sets_load = true, .holds_load = true, .load = 0.8f, .load_q27 = 107374182};
    const struct input back = {.sets_load = true};
    const uint32_t dither = (uint32_t)(0.5f * 5.5f * STEP_S * 4294967296.0f); /* of a turn, in the sixth step */

    start(UNIT_SET "N0 6 v0 4", arith);
    plants_run_steps(&plant, 100u);
    apply(UNIT_SET "N0 2 v0 4 lag 1 speed inertia J 1e9");
    tap_check_close(load_now(), 6.0f - 4.0f * rise(0.5f * STEP_S), 1e-5f, "a lag that begins goes on from what acts");
    tap_check_close(speed_now(), 4.0f, 1e-5f, "so does an inertia");
    plants_run_steps(&plant, 10u);
    sim_input(&plant.sim, &held);
    plants_run_steps(&plant, 10u);
    sim_input(&plant.sim, &back);
    tap_check_close(load_now(), 8.0f - 6.0f * rise(0.5f * STEP_S), 1e-5f, "and from what a controller held");
    tap_check(!acting_is_steady(&plant.plan.load, &plant.sim.load, plant.sim.step, arith == (float)ARITH_Q27),
              "it moves");
    plants_run_steps(&plant, 100u);
    tap_check(acting_is_steady(&plant.plan.load, &plant.sim.load, plant.sim.step, arith == (float)ARITH_Q27),
              "until nearly nothing is left");
    start(UNIT_SET "N0 5 dither 2 f_dither 0.5 v0 4 v_dither 2 fv_dither 0.5", arith);
    plants_run_steps(&plant, 5u);
    apply(UNIT_SET "N0 5 lag 1e4 dither 2 f_dither 0.5 v0 4 speed inertia J 1e9 v_dither 2 fv_dither 0.5");
    tap_check_close(load_now(), 5.0f + 2.0f * fmath_sine_turns(dither), 1e-3f,
                    "a lag goes on from what acts without the dither");
    tap_check_close(speed_now(), 4.0f + 2.0f * fmath_sine_turns(dither), 1e-3f, "and so does an inertia");
}

static enum error problem_of(const char *assignments)
{
    static struct sim_plan wanted;
    const struct params params = plants_params(assignments);

    return sim_plan_make(&wanted, &params, NULL).error;
}

static void check_refusals(void)
{
    tap_check(problem_of("N_low 3 N_high 2") == ERROR_OUT_OF_RANGE &&
                  problem_of("v_low 3 v_high 2") == ERROR_OUT_OF_RANGE,
              "limits the wrong way round");
    tap_check(problem_of("load pulses rise 1 hold 1 fall 1 every 2.9") == ERROR_OUT_OF_RANGE &&
                  problem_of("load pulses rise 1 hold 1 fall 1 every 3") == ERROR_OK,
              "pulses that come before the last is over");
    tap_check(problem_of("load table") == ERROR_NO_TABLE && problem_of("speed table") == ERROR_NO_TABLE,
              "a table without points");
    tap_check(problem_of("speed inertia m 1 R 1 J 1.9") == ERROR_OUT_OF_RANGE &&
                  problem_of("speed inertia m 1 R 1 J 2") == ERROR_OK,
              "a disc lighter than its pads");
    tap_check(problem_of("N0 1 dither 1 N_max 1.9") == ERROR_OUT_OF_SCALE &&
                  problem_of("N0 1 dither 1 N_max 2") == ERROR_OK &&
                  problem_of("N0 1 N_off 2 N_max 2.9") == ERROR_OUT_OF_SCALE,
              "what does not fit the scale");
    tap_check(problem_of("load ramp N1 2000 t2 9 N_high 1") == ERROR_OUT_OF_SCALE &&
                  problem_of("load sine fN 1 N1 2000 N_high 1") == ERROR_OUT_OF_SCALE &&
                  problem_of("load pulses rise 9 N_off 2000 N_high 1") == ERROR_OUT_OF_SCALE &&
                  problem_of("speed ramp v1 100 tv2 9 v_high 1 v_low -1") == ERROR_OUT_OF_SCALE &&
                  problem_of("load ramp N1 59 t2 9 N_high 1") == ERROR_OK,
              "a line of which the limits leave next to nothing");
    tap_check(problem_of("load step N1 2000 t1 9 N_high 1") == ERROR_OK, "a jump is where it is");
    tap_check(problem_of("speed inertia v0 5 v_off -4.5 v_max 1") == ERROR_OK,
              "an inertia reaches no more than what it starts with");
}

void test_acting(void)
{
    for (int arith = ARITH_F32; arith <= ARITH_Q27; arith++) {
        check_limits((float)arith);
        check_lag((float)arith);
        check_dither((float)arith);
        check_balance((float)arith);
        check_small_losses((float)arith);
        check_mirror((float)arith);
        check_live((float)arith);
    }
    check_alike();
    check_refusals();
}
