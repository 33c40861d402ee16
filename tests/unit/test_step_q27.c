/* The plant in integers: against closed forms and the golden solver, against its float twin, in a mirror, at both ends
 * of its range, and its fast path against the general one. */
#include "model/step_q27.h"

#include "base/fmath.h"
#include "plants.h"
#include "sim/executive.h"
#include "tap.h"
#include "tests.h"

#define UNIT (1.0f / 134217728.0f)

static struct plant plant;
static struct plant other;
static const struct step_q27 *const pad = &plant.sim.q27;

static float x_m(const struct plant *of)
{
    return (float)sim_output(&of->sim)->x * UNIT * (float)(1u << of->plan.scale.length_shift) * of->plan.scale.length_m;
}

/* Largest difference of displacement and velocity of two plants, in the model's units, over so many periods. */
static float difference(uint32_t periods)
{
    const float length = (float)(1u << plant.plan.scale.length_shift);
    float worst = 0.0f;

    sim_measure(&plant.sim, periods * plant.plan.scale.steps_per_period);
    sim_measure(&other.sim, periods * plant.plan.scale.steps_per_period);
    for (uint32_t i = 0u; i < periods * plant.plan.scale.steps_per_period; i++) {
        plants_run_steps(&plant, 1u);
        plants_run_steps(&other, 1u);
        worst =
            fmath_max(worst, fmath_abs((float)(sim_output(&plant.sim)->x - sim_output(&other.sim)->x) * UNIT * length));
        worst = fmath_max(worst, fmath_abs((float)(sim_output(&plant.sim)->v - sim_output(&other.sim)->v) * UNIT));
    }
    return worst;
}

/* --- What it must reach ------------------------------------------------------------------------------------------- */

/* tests/golden: fig5_N5, which sticks and crosses; x after 20 periods from a solver of order 22. */
static void check_golden(void)
{
    plants_start(&plant, "N0 5 normal exact spp 64 arith q27");
    plants_run_periods(&plant, 20u);
    tap_check_close(x_m(&plant), 0.230829189f, 1e-4f, "64 steps a period, of a swing of 2 m");
    plants_start(&plant, "N0 5 normal exact spp 128 arith q27");
    plants_run_periods(&plant, 20u);
    tap_check_close(x_m(&plant), 0.230829189f, 1e-5f, "128 steps are at least ten times as good");
    plants_start(&plant, "N0 5 normal rk4 method naive spp 128 arith q27");
    plants_run_periods(&plant, 20u);
    tap_check(fmath_abs(x_m(&plant) - 0.230829189f) > 1e-3f, "RK4 on the raw sign is not");
}

static void check_stick(const char *assignments)
{
    const struct scale *scale = &plant.plan.scale;
    float carried = 0.0f; /* steps */
    float expected;
    bool is_held = true;

    plants_start(&plant, assignments);
    expected = (scale->friction * 0.25f / fmath_abs((float)pad->disc * UNIT) - scale->damping) /
               (scale->stiffness * scale->step);
    tap_check(pad->mode == PLANT_STICK && pad->disc != 0, "a pad at the disc's speed that friction can hold sticks");
    for (uint32_t i = 0u; i < 1000u && pad->mode == PLANT_STICK; i++) {
        const float need = scale->damping * (float)pad->v * UNIT + scale->stiffness * (float)pad->x * UNIT;

        is_held = is_held && pad->v == pad->disc &&
                  fmath_abs((float)step_q27_friction(pad, &plant.plan.q27) * UNIT - need) < 1e-7f;
        plants_run_steps(&plant, 1u);
        carried += (float)plant_notes(sim_output(&plant.sim)).stick / (float)PLANT_SHARE_ONE;
    }
    tap_check(is_held, "it has the disc's speed to the bit, and friction is what the springs need");
    tap_check_close(carried / expected, 1.0f, 1e-5f, "until the springs win, located inside the step");
    tap_check(pad->mode == (pad->disc > 0 ? PLANT_SLIP_PLUS : PLANT_SLIP_MINUS), "then it slips back");
}

/* A pad that comes to rest under little damping ends in a cycle that its own rounding feeds. */
static void check_rest(const char *assignments, bool is_lifted)
{
    int32_t low = INT32_MAX;
    int32_t high = -INT32_MAX;

    plants_start(&plant, assignments);
    plants_run_periods(&plant, 600u);
    for (uint32_t i = 0u; i < 2000u; i++) {
        plants_run_steps(&plant, 1u);
        low = pad->x < low ? pad->x : low;
        high = pad->x > high ? pad->x : high;
    }
    tap_check(pad->normal.is_lifted == is_lifted && pad->mode != PLANT_STICK, "a pad left to itself");
    if (!tap_check((int64_t)high - low < 24, "comes to rest within a few counts")) {
        tap_note(assignments);
    }
    tap_note_number("counts", (float)high - (float)low);
}

/* --- Against its twin --------------------------------------------------------------------------------------------- */

static void agree(const char *assignments, float tolerance)
{
    struct params params = plants_params(assignments);

    plants_plan(&other.plan, &params);
    sim_reset(&other.sim, &other.plan);
    params.arithmetic = ARITH_Q27;
    plants_plan(&plant.plan, &params);
    sim_reset(&plant.sim, &plant.plan);
    tap_check_close((float)step_q27_friction(pad, &plant.plan.q27) * UNIT,
                    step_f32_friction(&other.sim.f32, &other.plan.f32), 1e-7f, "friction at the start");
    if (!tap_check_close(difference(20u), 0.0f, tolerance, "twenty periods as in single precision")) {
        tap_note(assignments);
    }
    /* A load from rest lets the pad touch y = 0, which either may round below it a few times. */
    tap_check(plant.sim.counters.saturations == 0u && plant.sim.fault == SIM_FAULT_NONE &&
                  (plant.sim.counters.events > 0u) == (other.sim.counters.events > 0u) &&
                  (plant.sim.counters.lifted > 20u) == (other.sim.counters.lifted > 20u),
              "nothing saturates, and the same kind of things happen");
    if ((int)params.tangential_method == METHOD_EVENT) {
        tap_check_close((float)step_q27_friction(pad, &plant.plan.q27) * UNIT,
                        step_f32_friction(&other.sim.f32, &other.plan.f32), tolerance, "friction at the end too");
    }
    tap_check_close(measure_share(&plant.sim.measure, plant.sim.measure.stick),
                    measure_share(&other.sim.measure, other.sim.measure.stick), 1e-4f, "and as long");
}

static void check_agreement(void)
{
    agree("N0 1", 2e-6f);
    agree("N0 1 y0 1 alpha -0.1 xd0 -1 mu_floor 0.25", 1e-5f);
    agree("N0 5 normal exact", 1e-5f);
    agree("N0 10 alpha -0.02 x0 0.3 xd0 -0.2 spp 128", 1e-5f);
    agree("N0 10 alpha -0.02 normal exact N_max 10 v_max 1", 2e-5f); /* nothing kept in reserve */
    agree("N0 5 alpha -0.1 normal exact mu_floor 0.22 speed ramp v1 -0.5 tv1 3 tv2 30", 1e-4f);
    agree("N0 5 cn 0.2 normal exact spp 128 load ramp N1 8 t1 3.3 t2 20", 1e-5f);
    agree("N0 4 N1 1 load step t1 1.7206 normal exact", 2e-5f);
    agree("N0 4 N1 1 load step t1 1.7206 normal exact contact no_pull", 2e-5f);
    agree("N0 4 N1 1 load step t1 1.7206 normal exact contact lift spp 128", 5e-4f);
    agree("N0 4 N1 1 load step t1 1.7206 contact lift spp 128", 5e-4f);
    agree("N0 3 N1 1 load sine fN 0.23 t1 2", 2e-5f);
    agree("N0 5 kt 12 k 3 normal exact", 2e-4f);    /* Z2 = 15: beyond the fast path */
    agree("N0 1 kt 0.05 k 0 normal exact", 5e-6f);  /* x in units of 8 */
    agree("N0 1 c 2.2 cn 2.2 normal exact", 5e-6f); /* z at its limit */
    agree("N0 5 method naive", 1e-3f);              /* whose crossings are not located */
    agree("N0 1 spp 16 kt 0.5 k 0.5", 2e-3f);       /* y inside a step is a cubic here */
    agree("N0 1 spp 1024", 2e-5f);
}

/* The fast path and the general one differ by rounding alone. */
static void check_paths(const char *assignments, float tolerance)
{
    plants_start(&plant, assignments);
    plants_start(&other, assignments);
    tap_check(plant.plan.q27.reach_max > 0, "a set that the fast path serves");
    other.plan.q27.reach_max = 0;
    tap_check_close(difference(20u), 0.0f, tolerance, "goes the same way without it");
    tap_check(plant.sim.counters.events == other.sim.counters.events, "through the same events");
}

/* --- To the bit --------------------------------------------------------------------------------------------------- */

static bool is_mirrored(const struct sim *a, const struct sim *b)
{
    const struct step_q27 *one = &a->q27;
    const struct step_q27 *two = &b->q27;

    return one->x == -two->x && one->v == -two->v && one->disc == -two->disc && one->mode == -two->mode &&
           one->normal.y == two->normal.y && one->normal.w == two->normal.w && sim_output(a)->x == -sim_output(b)->x &&
           sim_output(a)->v == -sim_output(b)->v &&
           plant_notes(sim_output(a)).stick == plant_notes(sim_output(b)).stick &&
           plant_notes(sim_output(a)).events == plant_notes(sim_output(b)).events &&
           sim_output(a)->mode == -sim_output(b)->mode &&
           step_q27_friction(one, &a->plan->q27) == -step_q27_friction(two, &b->plan->q27);
}

static void check_mirror(const char *assignments, bool has_events)
{
    struct params params = plants_params(assignments);
    bool ok = true;

    params.arithmetic = ARITH_Q27;
    plants_plan(&plant.plan, &params);
    sim_reset(&plant.sim, &plant.plan);
    params.speed_m_per_s = -params.speed_m_per_s;
    params.speed_end_m_per_s = -params.speed_end_m_per_s;
    params.x_initial_m = -params.x_initial_m;
    params.xd_initial_m_per_s = -params.xd_initial_m_per_s;
    plants_plan(&other.plan, &params);
    sim_reset(&other.sim, &other.plan);
    for (uint32_t i = 0u; i < plants_scaled(30000u, 5000u) && ok; i++) {
        plants_run_steps(&plant, 1u);
        plants_run_steps(&other, 1u);
        ok = is_mirrored(&plant.sim, &other.sim);
    }
    tap_check(ok && plant.sim.fault == SIM_FAULT_NONE, "a mirrored start gives mirrored bits");
    tap_check((plant.sim.counters.events > 20u) == has_events, "with or without events as intended");
}

static void check_mirrors(void)
{
    check_mirror("N0 1", false);
    check_mirror("N0 5 x0 0.3 xd0 -0.2 normal exact", true);
    check_mirror("N0 5 alpha -0.1 mu_floor 0.22 speed ramp v1 0.5 tv2 60", true);
    check_mirror("N0 4 N1 2 load step t1 1.7206 contact lift normal exact", true);
    check_mirror("N0 8 N1 10 load sine fN 0.23 contact no_pull cn 0.1", true);
    check_mirror("N0 10 kt 12 k 3 alpha -0.05 c 0", true);
    check_mirror("N0 5 method naive", false);
}

static uint32_t hash_by_ticks(const char *assignments, uint32_t steps)
{
    static struct executive executive;

    plants_executive(&executive, assignments);
    executive_grant(&executive, steps);
    plants_spend(&executive);
    tap_check(executive.sim.step == steps, "every step is made");
    return executive.sim.hash;
}

static void check_substeps(void)
{
    const uint32_t hash = hash_by_ticks("arith q27 N0 10 alpha -0.02", 3000u);

    tap_check(hash_by_ticks("arith q27 N0 10 alpha -0.02 substeps 7", 3000u) == hash &&
                  hash_by_ticks("arith q27 N0 10 alpha -0.02 substeps 64 tick 10", 3000u) == hash,
              "the same bits with any number of steps a tick");
    tap_check(hash_by_ticks("N0 10 alpha -0.02", 3000u) != hash, "and others than in single precision");
    plants_start(&plant, "arith q27 N0 10 alpha -0.02");
    plants_run_steps(&plant, 3000u);
    tap_check(plant.sim.hash == hash, "an interrupt or none");
    /* Pinned, so that every board, compiler and level of optimisation gives these bits. */
    tap_check(hash == 0xa27fa994u, "the bits of every board");
    tap_note_bits("hash", hash);
}

/* --- Ends of the range -------------------------------------------------------------------------------------------- */

/* One step from anywhere in the range is that of single precision, or says that it saturated. */
static void check_headroom(const char *assignments, float tolerance)
{
    uint32_t state = 77u;
    uint32_t saturated = 0u;
    uint32_t compared = 0u;
    float worst = 0.0f;
    bool is_told = true;
    const float reach[] = {0.3f, 1.9f, 4.5f, 15.99f};

    for (uint32_t i = 0u; i < plants_scaled(8000u, 600u); i++) {
        const float size = reach[i % 4u];
        struct step_q27 q27;
        struct step_f32 f32;
        float error;

        plants_start(&plant, assignments);
        q27 = plant.sim.q27;
        f32 = plant.sim.f32;
        q27.x = fixed_from_float(plants_random(&state, -size, size), 27);
        q27.v = fixed_from_float(plants_random(&state, -size, size), 27);
        q27.mode = q27.v < q27.disc ? PLANT_SLIP_PLUS : PLANT_SLIP_MINUS;
        normal_q27_reset(&q27.normal, &plant.plan.q27.normal, fixed_from_float(plants_random(&state, -size, size), 27),
                         fixed_from_float(plants_random(&state, -size, size), 27), q27.normal.n, &q27.is_saturated);
        step_q27_adopt(&q27, &plant.plan.q27);
        step_f32_reset(&f32, &plant.plan.f32, &plant.plan.params, &plant.plan.scale,
                       (struct step_f32_input){(float)q27.normal.n * UNIT, (float)q27.disc * UNIT});
        f32.x = (float)q27.x * UNIT;
        f32.v = (float)q27.v * UNIT;
        f32.mode = q27.mode;
        normal_f32_reset(&f32.normal, &plant.plan.f32.normal, (float)q27.normal.y * UNIT, (float)q27.normal.w * UNIT,
                         (float)q27.normal.n * UNIT);
        step_f32_adopt(&f32, &plant.plan.f32);
        step_q27_advance(&q27, &plant.plan.q27);
        step_f32_advance(&f32, &plant.plan.f32);
        if (q27.is_saturated) {
            saturated++;
            is_told = is_told && step_q27_is_outside(&q27);
            continue;
        }
        compared++;
        error = fmath_max(fmath_abs((float)q27.x * UNIT - f32.x), fmath_abs((float)q27.v * UNIT - f32.v));
        error = fmath_max(error, fmath_abs((float)q27.normal.y * UNIT - f32.normal.y));
        error = fmath_max(error, fmath_abs((float)q27.normal.w * UNIT - f32.normal.w));
        worst = fmath_max(worst, error);
    }
    tap_check(compared > plants_scaled(8000u, 600u) / 2u && is_told, "most steps from anywhere fit");
    if (!tap_check_close(worst, 0.0f, tolerance, "and are those of single precision")) {
        tap_note(assignments);
    }
    tap_note_number("saturated", (float)saturated);
}

static void check_ends(const char *assignments, int32_t sign)
{
    struct step_q27 state;

    plants_start(&plant, assignments);
    state = *pad;
    state.x = sign * (INT32_MAX - 5);
    state.v = sign * (9 << 27);
    step_q27_advance(&state, &plant.plan.q27);
    tap_check(state.output.x == sign * INT32_MAX && plant_notes(&state.output).is_saturated &&
                  step_q27_is_outside(&state),
              "a displacement beyond the range stays at its end, and the step says so");
    state = *pad;
    state.v = sign * ((10 << 27) + 1);
    tap_check(step_q27_is_outside(&state), "a speed beyond ten lies outside");
    state.v = sign * (10 << 27);
    tap_check(!step_q27_is_outside(&state), "ten lies inside");
}

static void check_faults(void)
{
    check_ends("N0 1 arith q27", 1);
    check_ends("N0 1 v0 -1 arith q27", -1);
    plants_start(&plant, "N0 1 x0 100 arith q27");
    tap_check(plant_notes(sim_output(&plant.sim)).is_saturated && sim_output(&plant.sim)->x == INT32_MAX,
              "a start beyond the range is told");
    (void)sim_step(&plant.sim);
    tap_check(plant.sim.fault == SIM_FAULT_DOMAIN && plant.sim.counters.saturations == 1u, "and is a fault");
    plants_start_preset(&plant, "fig7-ke5000", "normal exact arith q27");
    plants_start_preset(&other, "fig7-ke5000", "normal exact");
    plants_run_steps(&plant, 20000u);
    plants_run_steps(&other, 20000u);
    tap_check(plant.sim.fault == SIM_FAULT_DOMAIN && plant.sim.step == other.sim.step &&
                  plant.sim.v10_step == other.sim.v10_step,
              "a diverging pad leaves its domain in the same step as in single precision");
}

/* A live change between two steps: the state goes on, in the same units. */
static void check_apply(void)
{
    static struct sim_plan changed;
    struct params params = plants_params("N0 2 kt 0.15 k 0 alpha -0.01 c 0.02 v0 0.9 arith q27");
    int32_t x;

    plants_start(&plant, "N0 1 kt 0.05 k 0 normal rk4 arith q27");
    plants_run_steps(&plant, 1000u);
    (void)tap_check(sim_plan_make(&changed, &params, &plant.plan.scale).error == ERROR_OK &&
                        changed.scale.length_shift == plant.plan.scale.length_shift,
                    "a live change keeps the unit of length");
    x = pad->x;
    sim_apply(&plant.sim, &changed);
    plants_run_steps(&plant, 1u);
    tap_check(fmath_abs((float)(pad->x - x) * UNIT) < 0.02f && pad->normal.n == 1 << 26 &&
                  pad->disc == fixed_from_float(0.9f / 4.0f, 27),
              "the motion goes on with the new load and speed");
}

void test_step_q27(void)
{
    plants_check_undamped(&plant, "normal exact spp 64 arith q27", 2e-4f);
    plants_check_undamped(&plant, "normal exact spp 256 arith q27", 2e-6f);
    plants_check_undamped(&plant, "spp 256 arith q27", 5e-6f);
    check_golden();
    check_stick("N0 1 y0 1 v0 0.05 xd0 0.05 arith q27");
    check_stick("N0 1 y0 1 v0 -0.05 xd0 -0.05 arith q27");
    check_rest("N0 1.5 load step t1 28.3919 contact lift normal exact arith q27", true);
    check_rest("N0 1.5 load step t1 28.3919 contact lift spp 128 arith q27", true);
    check_rest("N0 1 y0 1 x0 0.15 arith q27", false);
    check_rest("N0 1 y0 1 x0 0.15 v0 -1 cn 1 normal exact spp 256 arith q27", false);
    check_agreement();
    check_paths("N0 1 arith q27", 2e-6f);
    check_paths("N0 10 alpha -0.02 normal exact arith q27", 5e-6f);
    check_paths("N0 5 alpha -0.1 mu_floor 0.22 cn 0.1 normal exact arith q27", 5e-6f);
    check_mirrors();
    check_substeps();
    check_headroom("N0 1 N_max 1 v_max 1 arith q27 normal exact", 1e-5f);
    check_headroom("N0 1 N_max 1 v_max 1 arith q27 alpha -1 spp 1024 c 10 contact no_pull", 1e-5f);
    check_headroom("N0 1 N_max 1 v_max 1 arith q27 kt 12 k 3 mu_floor 0.1 contact lift", 1e-4f);
    check_headroom("N0 1 N_max 1 v_max 1 arith q27 spp 16 kt 0.5 k 0.5 c 0.5 cn 0.5 alpha 0.5 normal exact", 5e-3f);
    check_faults();
    check_apply();
}
