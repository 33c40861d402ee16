/* What must not change the motion: mirror images, scalings, the split of a sum; and what it must keep: energy,
 * bounds. */
#include "base/fmath.h"
#include "plants.h"
#include "tap.h"
#include "tests.h"

static struct plant plant;
static struct plant other;

/* The same set seen in a mirror: disc and initial motion the other way. */
static void start_mirrored(struct plant *mirrored, const struct params *params)
{
    struct params turned = *params;

    turned.speed_m_per_s = -turned.speed_m_per_s;
    turned.speed_end_m_per_s = -turned.speed_end_m_per_s;
    turned.x_initial_m = -turned.x_initial_m;
    turned.xd_initial_m_per_s = -turned.xd_initial_m_per_s;
    plants_plan(&mirrored->plan, &turned);
    sim_reset(&mirrored->sim, &mirrored->plan);
}

static bool is_mirrored(const struct sim *a, const struct sim *b)
{
    const struct step_f32 *one = &a->f32;
    const struct step_f32 *two = &b->f32;

    return one->x == -two->x && one->v == -two->v && one->disc == -two->disc && one->mode == -two->mode &&
           one->normal.y == two->normal.y && one->normal.w == two->normal.w && sim_output(a)->x == -sim_output(b)->x &&
           sim_output(a)->v == -sim_output(b)->v &&
           plant_notes(sim_output(a)).stick == plant_notes(sim_output(b)).stick &&
           plant_notes(sim_output(a)).events == plant_notes(sim_output(b)).events;
}

static void check_mirror(const char *assignments, bool has_events)
{
    const struct params params = plants_params(assignments);
    bool ok = true;

    plants_plan(&plant.plan, &params);
    sim_reset(&plant.sim, &plant.plan);
    start_mirrored(&other, &params);
    for (uint32_t i = 0u; i < plants_scaled(20000u, 3000u) && ok; i++) {
        plants_run_steps(&plant, 1u);
        plants_run_steps(&other, 1u);
        ok = is_mirrored(&plant.sim, &other.sim);
    }
    tap_check(ok && plant.sim.fault == SIM_FAULT_NONE, "a mirrored start gives mirrored bits");
    tap_check((plant.sim.counters.events > 20u) == has_events, "with or without events as intended");
}

/* Runs two sets and returns the largest difference of x in the model's units. */
static float difference(const char *first, const char *second, uint32_t periods)
{
    float worst = 0.0f;

    plants_start(&plant, first);
    plants_start(&other, second);
    for (uint32_t i = 0u; i < periods * plant.plan.scale.steps_per_period; i++) {
        plants_run_steps(&plant, 1u);
        plants_run_steps(&other, 1u);
        worst = fmath_max(worst, fmath_abs(plant.sim.f32.x - other.sim.f32.x));
    }
    return worst / 0.5f;
}

static void check_scalings(void)
{
    tap_check(difference("N0 5 alpha -0.02 x0 0.1", "N0 10 alpha -0.01 v0 2 x0 0.2", 40u) == 0.0f &&
                  plant.sim.hash == other.sim.hash && other.plan.scale.length_m == 2.0f * plant.plan.scale.length_m,
              "load, speed and displacement doubled at the same N alpha: the same bits in twice the units");
    tap_check_close(difference("N0 5 alpha -0.021 x0 0.1", "N0 15 alpha -0.007 v0 3 x0 0.3", 20u), 0.0f, 1e-5f,
                    "times three: the same but for rounding");
    tap_check_close(difference("N0 1 x0 0.1", "N0 0.7 alpha -0.00285714286 v0 0.7 x0 0.07", 40u), 0.0f, 1e-5f,
                    "times 0.7 without stick");
    tap_check(difference("N0 5 mu_s 0.3 v0 1", "N0 5 mu_s 0.6 v0 2", 40u) == 0.0f && plant.sim.hash == other.sim.hash,
              "friction and speed act through their ratio alone: doubled, the same bits");
    tap_check_close(difference("N0 5 mu_s 0.3 v0 1", "N0 5 mu_s 0.9 v0 3", 20u), 0.0f, 1e-5f, "times three too");
    tap_check(difference("N0 5 kt 0.375 k 0.8125", "N0 5 kt 0.8125 k 0.375", 40u) == 0.0f &&
                  plant.sim.hash == other.sim.hash,
              "both springs may be exchanged");
    tap_check(difference("N0 5 kt 0.375 k 0.8125", "N0 5 kt 1.1875 k 0", 40u) == 0.0f &&
                  plant.sim.hash == other.sim.hash,
              "or be one");
    tap_check(difference("N0 5 substeps 1 tick 1000", "N0 5 substeps 7 tick 30", 10u) == 0.0f &&
                  plant.sim.hash == other.sim.hash,
              "the rate of the interrupt changes nothing");
    tap_check(difference("N0 5", "N0 5.00001", 10u) > 0.0f && plant.sim.hash != other.sim.hash,
              "and what differs is told apart");
}

/* |x| <= mu n [1/Z2 + 1/(Z2 - 1) + 1/(Z2 - 1) - 1/Z2] = 2 mu n of undamped forced slip at Z2 = 2. */
static void check_undamped(void)
{
    const uint32_t steps = plants_scaled(64u * 2000u, 64u * 100u);
    float late = 0.0f;
    float bound;
    float largest = 0.0f;

    plants_start(&plant, "c 0 alpha 0 N0 0.5 normal exact");
    bound = 2.0f * plant.plan.scale.friction * 0.25f;
    for (uint32_t i = 0u; i < steps; i++) {
        plants_run_steps(&plant, 1u);
        largest = fmath_max(largest, fmath_abs(plant.sim.f32.x));
        late = i == steps / 2u ? 0.0f : fmath_max(late, fmath_abs(plant.sim.f32.x));
    }
    tap_check(largest <= 1.0001f * bound, "without any damping the motion stays bounded");
    tap_check(late > 0.97f * bound, "and does not die");
}

/* Over whole periods of a settled motion friction's work is what the damper takes, plus the change of energy. */
static void check_energy(void)
{
    const struct step_f32 *pad = &plant.sim.f32;
    const struct scale *scale = &plant.plan.scale;
    float friction = 0.0f;
    float damper = 0.0f;
    float stored;
    float power = 0.0f;

    plants_start(&plant, "c 0.1 N0 1 normal exact");
    plants_run_periods(&plant, 60u);
    stored = 0.5f * (pad->v * pad->v + scale->stiffness * pad->x * pad->x);
    for (uint32_t i = 0u; i < 64u; i++) {
        /* Equal weights are exact to many orders for what repeats after the last step. */
        friction += step_f32_friction(pad, &plant.plan.f32) * pad->v;
        power = fmath_max(power, fmath_abs(step_f32_friction(pad, &plant.plan.f32) * pad->v));
        damper += scale->damping * pad->v * pad->v;
        plants_run_steps(&plant, 1u);
    }
    stored -= 0.5f * (pad->v * pad->v + scale->stiffness * pad->x * pad->x);
    tap_check(plant.sim.counters.events == 0u && damper > 0.0f, "a settled slip motion");
    tap_check_close((friction - damper + stored / scale->step) / (64.0f * power), 0.0f, 1e-5f,
                    "friction's work is what the damper takes");
    tap_check_close(friction / damper, 1.0f, 1e-3f, "and both are nearly equal in one period");
}

/* Sets across the whole range of the model: nothing leaves its bounds. */
static void check_random(void)
{
    uint32_t state = 20u;
    uint32_t switches = 0u;
    bool is_bounded = true;
    bool is_told = true;

    for (uint32_t i = 0u; i < plants_scaled(150u, 10u); i++) {
        struct params params = plants_params("normal exact N_max 40 v_max 8");

        params.load_n = plants_random(&state, 0.0f, 10.0f);
        params.load_end_n = plants_random(&state, 0.0f, 10.0f);
        params.load_start_s = plants_random(&state, 0.0f, 9.0f);
        params.load_profile = (float)LOAD_STEP;
        params.contact = (float)(tap_random(&state) % 3u);
        params.normal_method = (float)(tap_random(&state) % 2u);
        params.speed_m_per_s = plants_random(&state, -1.0f, 1.0f);
        params.friction_slope_s_per_m = plants_random(&state, -0.1f, 0.05f);
        params.stiffness_contact_n_per_m = plants_random(&state, 0.0f, 8.0f);
        params.friction_floor_ratio = tap_random(&state) % 2u == 0u ? 0.1f : -1e30f;
        plants_plan(&plant.plan, &params);
        sim_reset(&plant.sim, &plant.plan);
        for (uint32_t step = 0u; step < 640u; step++) {
            const struct plant_output *output = sim_output(&plant.sim);
            struct plant_notes notes;

            plants_run_steps(&plant, 1u);
            notes = plant_notes(output);
            is_bounded = is_bounded && notes.events <= PLANT_EVENTS_MAX &&
                         (!notes.is_capped || notes.events == PLANT_EVENTS_MAX) && notes.stick <= PLANT_SHARE_ONE &&
                         notes.slip_minus <= PLANT_SHARE_ONE &&
                         notes.stick + notes.slip_minus <= PLANT_SHARE_ONE + 1000u;
            is_told = is_told && output->mode == plant.sim.f32.mode &&
                      (output->mode != PLANT_STICK || output->v == output->disc);
        }
        switches += plant.sim.counters.events;
    }
    tap_check(switches > plants_scaled(1500u, 100u) && is_bounded,
              "no step locates more events than it may, and shares stay shares");
    tap_check(is_told, "a pad that sticks has the disc's speed, always");
}

void test_invariance(void)
{
    check_mirror("N0 1", false);
    check_mirror("N0 5 x0 0.3 xd0 -0.2", true);
    check_mirror("N0 5 alpha -0.02 normal exact mu_floor 0.2 speed ramp v1 0.5 tv2 60", true);
    check_mirror("N0 4 N1 2 load step t1 1.7206 contact lift normal exact", true);
    check_mirror("N0 8 N1 10 load sine fN 0.23 contact no_pull cn 0.1", true);
    check_mirror("N0 5 method naive", false);
    check_scalings();
    check_undamped();
    check_energy();
    check_random();
}
