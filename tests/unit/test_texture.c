/* The disc's surface: its statistics, its independence of the step, the angle of the disc, and that nothing is
 * nothing. */
#include "sim/texture.h"

#include "base/fmath.h"
#include "base/hash.h"
#include "plants.h"
#include "tap.h"
#include "tests.h"

/* 1 rad/s, 1 m/s as half the unit of speed: 64 steps at v0 1 under R 1 are a turn. */
#define UNIT_SET "m 1 ke 1 cn 1 mu_s 0.1 N_max 10 v_max 2 R 1 "
#define ROUGH_SET "rough 0.02 seed 3 spp 16 kt 0.5 k 0.5"
#define ONE_Q30 1073741824.0f

enum { SLOW_STEPS = 10000 };

static struct plant plant;
static struct plant other;
static struct sim *const sim = &plant.sim;
static const struct texture_angle at_zero;

static int32_t value_at(uint64_t step) { return texture_value(&plant.plan.texture, &at_zero, step, 0); }

/* Turns from -1/2 to 1/2. */
static float turns_of(const struct texture_angle *angle)
{
    return (float)(int32_t)(uint32_t)(angle->turns >> 32) / 4294967296.0f;
}

static float load_f32(void) { return sim->f32.normal.n * plant.plan.scale.load_n; }

/* --- Roughness ---------------------------------------------------------------------------------------------------- */

static void check_statistics(void)
{
    const uint32_t count = plants_scaled(100000u, 4000u);
    const float error = 4.0f / fmath_sqrt((float)count);
    float sum = 0.0f, squares = 0.0f, largest = 0.0f;

    plants_start(&plant, ROUGH_SET);
    for (uint32_t i = 0u; i < count; i++) {
        const float value = (float)value_at(i) / (0.02f * ONE_Q30);

        sum += value;
        squares += value * value;
        largest = fmath_max(largest, fmath_abs(value));
    }
    tap_check_close(sum / (float)count, 0.0f, error, "roughness has the mean 0");
    tap_check_close(squares / (float)count, 1.0f, 0.9f * error, "and the rms asked for");
    tap_check(largest <= 1.7320511f && largest > 1.72f, "never beyond sqrt 3 of it, but up to there");
}

static void check_every_spp(void)
{
    struct params params = plants_params(ROUGH_SET);
    bool is_same = true;
    bool holds = true;

    plants_start(&plant, ROUGH_SET);
    for (uint32_t k = 0u; k < 7u; k++) {
        params.steps_per_period = (float)k;
        plants_plan(&other.plan, &params);
        for (uint64_t i = 0u; i < 300u; i++) {
            const int32_t value = texture_value(&other.plan.texture, &at_zero, i << k, 0);

            is_same = is_same && value == value_at(i);
            holds = holds && value == texture_value(&other.plan.texture, &at_zero, ((i + 1u) << k) - 1u, 0);
        }
    }
    tap_check(is_same, "every number of steps a period meets the same realisation");
    tap_check(holds, "which holds for a sixteenth of a period");
}

static void check_pure(void)
{
    int32_t first, far;
    bool moves = false;

    plants_start(&plant, "rough 0.02 seed 3");
    first = value_at(12345u);
    far = value_at(UINT64_C(1) << 40);
    for (uint64_t i = 0u; i < 64u; i += 4u) {
        moves = moves || value_at(i) != value_at(i + 4u);
    }
    tap_check(moves && first == value_at(12345u) && far == value_at(UINT64_C(1) << 40) && far != first,
              "a step's value is its own, whenever it is asked for");
    plants_start(&plant, "rough 0.02 seed 4");
    tap_check(first != value_at(12345u) && far != value_at(UINT64_C(1) << 40), "another seed is another surface");
    plants_start(&plant, "rough 0.02 seed 3 arith q27");
    tap_check(first == value_at(12345u), "the number format meets the same one");
}

/* --- Run-out ------------------------------------------------------------------------------------------------------ */

static void check_turns(const char *arithmetic)
{
    struct params params = plants_params(UNIT_SET "runout 0.25 N0 2 v0 1");
    const struct texture_angle *angle = &sim->angle;
    static struct sim_plan back;

    params.arithmetic = arithmetic[0] == 'q' ? (float)ARITH_Q27 : (float)ARITH_F32;
    plants_plan(&plant.plan, &params);
    sim_reset(sim, &plant.plan);
    plants_run_steps(&plant, 16u);
    tap_check_close(turns_of(angle), 0.25f, 1e-6f, arithmetic);
    plants_run_steps(&plant, 64u * 1000u - 16u);
    tap_check_close(turns_of(angle), 0.0f, 2e-4f, "a thousand turns later the disc is where it was");
    plants_run_steps(&plant, 37u);
    params.speed_m_per_s = -1.0f;
    (void)tap_check(sim_plan_make(&back, &params, &plant.plan.scale).error == ERROR_OK, "a disc may turn back");
    sim_apply(sim, &back);
    plants_run_steps(&plant, 64u * 1000u + 37u);
    tap_check(angle->turns == 0u && angle->rest == 0u, "which takes it to where it began, to the bit");
    plants_run_steps(&plant, 16u);
    tap_check_close(turns_of(angle), -0.25f, 1e-6f, "and on to the other side");
    sim_reset(sim, &plant.plan);
    tap_check(angle->turns == 0u && angle->rest == 0u, "a reset begins anew");
}

/* From 1 to -1 m/s over 128 pi seconds, 4096 steps: 16 turns forth and 16 back. */
static void check_ramp(void)
{
    plants_start(&plant, UNIT_SET "runout 0.25 N0 2 speed ramp v0 1 v1 -1 tv1 0 tv2 402.123859");
    plants_run_steps(&plant, 256u); /* at v = 7/8: 4 turns less 1/4 */
    tap_check_close(turns_of(&sim->angle), -0.25f, 1e-4f, "a sixteenth of the time, 3 3/4 turns");
    plants_run_steps(&plant, 2048u - 256u);
    tap_check_close(turns_of(&sim->angle), 0.0f, 1e-4f, "at the stop, 16 turns");
    plants_run_steps(&plant, 2048u);
    tap_check_close(turns_of(&sim->angle), 0.0f, 1e-4f, "and all of them back");
}

/* What the pad is pressed with: the load times 1 + runout sin(angle), held over four steps at the middle of them. */
static void check_load(void)
{
    float worst = 0.0f;

    plants_start(&plant, UNIT_SET "runout 0.25 N0 2 v0 1");
    for (uint32_t i = 0u; i < 200u; i++) {
        plants_run_steps(&plant, 1u);
        worst = fmath_max(worst, fmath_abs(load_f32() - 2.0f - 0.5f * fmath_sine_turns((i / 4u * 4u + 2u) << 26)));
    }
    tap_check_close(worst, 0.0f, 1e-5f, "the load swings with the disc");
    plants_start(&plant, UNIT_SET "runout 0.25 N0 2 v0 1 arith q27");
    worst = 0.0f;
    for (uint32_t i = 0u; i < 200u; i++) {
        float load;

        plants_run_steps(&plant, 1u);
        load = (float)sim->q27.normal.n / 134217728.0f * 10.0f;
        worst = fmath_max(worst, fmath_abs(load - 2.0f - 0.5f * fmath_sine_turns((i / 4u * 4u + 2u) << 26)));
    }
    tap_check_close(worst, 0.0f, 1e-5f, "in integers too");
}

/* 1e-5 m/s under 10 m: a turn takes 73 days, and a step at 2^-27 of the unit of speed is 2^-66 turns. */
static void check_slow(void)
{
    plants_start(&plant, "m 1e-6 ke 1e6 mu_s 0.1 N_max 1e-3 v_max 1e-3 N0 1e-4 R 10 v0 1e-5 runout 0.25");
    plants_run_steps(&plant, SLOW_STEPS);
    tap_check_close(fmath_from_u64(sim->angle.turns) / 18446744073709551616.0f / (1.5625e-14f * (float)SLOW_STEPS),
                    1.0f, 1e-4f, "a creeping disc does not stall");
    for (uint32_t i = 0u; i < SLOW_STEPS; i++) {
        texture_turn(&plant.plan.texture, &sim->angle, -sim_output(sim)->disc);
    }
    tap_check(sim->angle.turns == 0u && sim->angle.rest == 0u, "nor does it forget a part of a bit");
}

/* --- Both --------------------------------------------------------------------------------------------------------- */

static void check_peak(void)
{
    struct params params = plants_params("N0 3 N1 2 load sine fN 0.05 rough 0.1 runout 0.5 R 0.02 seed 2");
    const float peak = 5.0f * (1.0f + 0.17320508f + 0.5f);
    float largest = 0.0f;
    float least = 1e9f;

    tap_check_close(scale_load_peak_n(&params), peak, 1e-5f, "the peak counts roughness and run-out");
    params.load_max_n = scale_load_peak_n(&params);
    plants_plan(&plant.plan, &params);
    sim_reset(sim, &plant.plan);
    for (uint32_t i = 0u; i < plants_scaled(60000u, 6000u); i++) {
        plants_run_steps(&plant, 1u);
        largest = fmath_max(largest, load_f32());
        least = fmath_min(least, load_f32());
    }
    tap_check(largest <= peak && largest > 0.95f * peak, "which no load exceeds, but which some come near to");
    tap_check(least > 0.0f, "and a brake force never pulls");
    params.load_max_n = 0.999f * peak;
    {
        const struct params_problem problem = sim_plan_make(&other.plan, &params, NULL);

        tap_check(problem.error == ERROR_OUT_OF_SCALE, "a scale that cannot hold it is refused");
        tap_check_close(problem.low, peak, 1e-5f, "with what it would have to hold");
    }
}

/* Without texture the plant steps as it would by its model alone. */
static uint32_t plain_hash(uint32_t steps)
{
    struct step_f32 state;
    uint32_t hash = HASH_INIT;
    const struct sim_plan *plan = &plant.plan;

    for (uint64_t i = 0u; i < steps; i++) {
        const struct step_f32_input input = {profile_value(&plan->load.profile, i),
                                             profile_value(&plan->speed.profile, i)};

        if (i == 0u) {
            step_f32_reset(&state, &plan->f32, &plan->params, &plan->scale, input);
        }
        step_f32_set_input(&state, &plan->f32, input);
        step_f32_advance(&state, &plan->f32);
        hash = hash_word(hash, fmath_bits(state.x));
        hash = hash_word(hash, fmath_bits(state.v));
        hash = hash_word(hash, fmath_bits(state.normal.y));
        hash = hash_word(hash, fmath_bits(state.normal.w));
        hash = hash_word(hash, (uint32_t)(int32_t)state.mode);
    }
    return hash;
}

static void check_nothing(void)
{
    uint32_t hash;

    plants_start(&plant, "N0 5 alpha -0.02 seed 99 R 0.5 speed ramp v1 0.2 tv2 30");
    plants_run_steps(&plant, 5000u);
    tap_check(sim->hash == plain_hash(5000u), "with both ratios 0 no bit of the motion changes");
    plants_start(&plant, "N0 5 alpha -0.02 arith q27");
    plants_run_steps(&plant, 5000u);
    hash = sim->hash;
    plants_start(&plant, "N0 5 alpha -0.02 arith q27 seed 99 R 0.5");
    plants_run_steps(&plant, 5000u);
    tap_check(sim->hash == hash && sim->angle.turns == 0u, "nor does seed or radius alone in integers");
    plants_start(&plant, "N0 5 alpha -0.02 arith q27 rough 1e-6");
    plants_run_steps(&plant, 5000u);
    tap_check(sim->hash != hash, "the least roughness does");
}

/* --- What it is for ----------------------------------------------------------------------------------------------- */

/* Where the brakes slide steadily, to the last digit that their numbers hold. */
#define BRAKE_3000 "load constant N0 3000 x0 2.61473677e-5 y0 3e-5 "
#define GROAN_1000 "load constant N0 1000 x0 1.40316209e-4 y0 1.65016502e-4 "

/* Does a preset start to squeal within so many periods? */
static bool starts(const char *name, const char *assignments, uint32_t periods)
{
    plants_start_preset(&plant, name, assignments);
    for (uint32_t i = 0u; i < periods; i++) {
        plants_run_periods(&plant, 1u);
        if (sim->detector.verdict.propensity == PROPENSITY_SQUEAL) {
            return true;
        }
    }
    return false;
}

static void check_start(void)
{
    const uint32_t many = plants_scaled(2000u, 150u);

    tap_check(!starts("brake", BRAKE_3000 "arith q27 rough 0 runout 0", many) && sim_output(sim)->v == 0,
              "in integers an unstable brake on a perfect disc locks at its equilibrium");
    tap_check(starts("groan", GROAN_1000 "arith q27", 150u), "the preset's disc starts creep groan");
    if (tap_is_hosted()) {
        tap_check(starts("groan", GROAN_1000, 150u), "in single precision too");
        tap_check(starts("brake", BRAKE_3000 "arith q27", 400u), "and squeal");
        tap_check(starts("brake", BRAKE_3000, 400u), "in both");
        tap_check(starts("brake", BRAKE_3000 "arith q27 runout 0", 400u), "roughness alone does it");
        tap_check(starts("brake", BRAKE_3000 "arith q27 rough 0", 400u), "so does run-out");
    }
}

void test_texture(void)
{
    check_statistics();
    check_every_spp();
    check_pure();
    check_turns("f32: a quarter of a turn");
    check_turns("q27: a quarter of a turn");
    check_ramp();
    check_load();
    check_slow();
    check_peak();
    check_nothing();
    check_start();
}
