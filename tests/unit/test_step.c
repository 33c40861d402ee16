/* The tangential step, regime by regime: slip against closed forms, stick to the bit, the floor of friction, and a
 * disc that changes its speed. */
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

/* On the steady forced motion x = mu n (1/Z2 + a cos t + b sin t) there is no transient. */
static void check_forced(void)
{
    struct params params = plants_params("c 0.5 N0 0.5 alpha 0 normal exact spp 128");
    float worst = 0.0f;
    float stiffness, damping, unit, size, a, b;

    plants_plan(&plant.plan, &params);
    stiffness = plant.plan.scale.stiffness;
    damping = plant.plan.scale.damping;
    unit = plant.plan.scale.friction * 0.25f;
    size = (stiffness - 1.0f) * (stiffness - 1.0f) + damping * damping;
    a = -(stiffness - 1.0f) / size;
    b = -damping / size;
    params.x_initial_m = unit * (1.0f / stiffness + a) * plant.plan.scale.length_m;
    params.xd_initial_m_per_s = unit * b * plant.plan.scale.speed_m_per_s;
    plants_plan(&plant.plan, &params);
    sim_reset(&plant.sim, &plant.plan);
    for (uint32_t i = 1u; i <= 2000u; i++) {
        plants_run_steps(&plant, 1u);
        worst =
            larger_error(worst, pad->x / unit, 1.0f / stiffness + a * sine_cosine_f32(8u * i) + b * sine_f32(8u * i));
        worst = larger_error(worst, pad->v / unit, b * sine_cosine_f32(8u * i) - a * sine_f32(8u * i));
    }
    tap_check_close(worst, 0.0f, 5e-6f, "damped slip stays on its steady forced motion");
}

/* Under a constant normal force and with c = N |alpha| slip is an undamped oscillation around (mu_s + alpha v0) N/K. */
static void check_slope(void)
{
    float worst = 0.0f;

    plants_start(&plant, "m 1 ke 1 kt 0.5 k 0.5 c 0.05 alpha -0.05 N0 1 y0 1 x0 0.3 spp 256 normal exact");
    for (uint32_t i = 1u; i <= 2560u; i++) {
        plants_run_steps(&plant, 1u);
        worst = larger_error(worst, plants_x_m(&plant), 0.25f + 0.05f * sine_cosine_f32(4u * i));
    }
    tap_check_close(worst / 0.05f, 0.0f, 5e-5f, "friction that falls with speed cancels the damping");
    plants_start(&plant, "N0 1 y0 1 x0 0.149"); /* (mu_s + alpha v0) N/(kt + k) */
    tap_check_close(plants_largest_v(&plant, 2000u), 0.0f, 1e-6f, "a pad at its equilibrium stays there");
    tap_check(plant.sim.counters.events == 0u, "and slips on");
}

/* The pad starts at the disc's speed under a constant normal force: it is carried on until the springs win. */
static void check_stick(const char *assignments)
{
    const struct scale *scale = &plant.plan.scale;
    float worst = 0.0f;
    float carried = 0.0f; /* steps */
    float expected;
    bool is_held = true;

    plants_start(&plant, assignments);
    expected = (scale->friction * 0.25f / fmath_abs(pad->disc) - scale->damping) / (scale->stiffness * scale->step);
    tap_check(pad->mode == PLANT_STICK && pad->disc != 0.0f, "a pad at the disc's speed that friction can hold sticks");
    for (uint32_t i = 0u; i < 1000u && pad->mode == PLANT_STICK; i++) {
        worst = larger_error(worst, pad->x, (float)i * scale->step * pad->disc);
        is_held = is_held && pad->v == pad->disc &&
                  step_f32_friction(pad, &plant.plan.f32) == scale->damping * pad->disc + scale->stiffness * pad->x;
        plants_run_steps(&plant, 1u);
        carried += (float)plant_notes(sim_output(&plant.sim)).stick / (float)PLANT_SHARE_ONE;
    }
    tap_check(is_held, "it has the disc's speed to the bit, and friction is what the springs need");
    tap_check_close(worst / fmath_abs(pad->x), 0.0f, 1e-5f, "it moves linearly");
    tap_check_close(carried / expected, 1.0f, 1e-5f, "until the springs win, located inside the step");
    tap_check(pad->mode == (pad->disc > 0.0f ? PLANT_SLIP_PLUS : PLANT_SLIP_MINUS), "then it slips back");
}

/* Where the pad never comes near the disc's speed the raw sign is no worse. */
static void check_naive(void)
{
    float x;

    plants_start(&plant, "N0 1");
    plants_run_periods(&plant, 20u);
    x = pad->x;
    plants_start(&plant, "N0 1 method naive");
    plants_run_periods(&plant, 20u);
    tap_check_close(pad->x, x, 1e-6f, "in slip the naive method is the same RK4");
}

static void check_floor(void)
{
    plants_start(&plant, "N0 1 y0 1 alpha -0.1 xd0 -1");
    tap_check_close(step_f32_friction(pad, &plant.plan.f32) * plant.plan.scale.force_n, 0.1f, 1e-6f,
                    "friction falls with the speed of slip");
    plants_start(&plant, "N0 1 y0 1 alpha -0.1 xd0 -1 mu_floor 0.25");
    tap_check_close(step_f32_friction(pad, &plant.plan.f32) * plant.plan.scale.force_n, 0.25f, 1e-6f,
                    "but not below its floor");
    plants_start(&plant, "N0 1 y0 1 alpha -0.1 xd0 1.2 mu_floor 0.25");
    tap_check_close(step_f32_friction(pad, &plant.plan.f32) * plant.plan.scale.force_n, -0.28f, 1e-6f,
                    "above it the slope counts, against the disc too");
}

static void advance_with(struct step_f32 *state, const struct step_f32_coeffs *coeffs, struct step_f32_input input)
{
    step_f32_set_input(state, coeffs, input);
    step_f32_advance(state, coeffs);
}

static void check_speed_change(void)
{
    const struct step_f32_coeffs *coeffs = &plant.plan.f32;
    struct step_f32_input input;
    struct step_f32 state;
    bool follows = true;

    plants_start(&plant, "N0 1 y0 1 v0 0.05 xd0 0.05");
    state = *pad;
    input = (struct step_f32_input){state.normal.n, state.disc};
    for (uint32_t i = 0u; i < 10u; i++) {
        input.speed += 1e-4f;
        advance_with(&state, coeffs, input);
        follows = follows && state.mode == PLANT_STICK && state.v == input.speed;
    }
    tap_check(follows, "a pad that sticks follows a slow change of the disc's speed");
    plant.sim.f32 = state;
    input.speed += 0.2f;
    advance_with(&state, coeffs, input);
    tap_check(state.mode == PLANT_SLIP_PLUS && fmath_abs(state.v - (input.speed - 0.2f)) < 0.05f &&
                  plant_notes(&state.output).stick == 0u,
              "a jump that friction cannot follow makes it slip");
    state = plant.sim.f32;
    input.speed -= 0.4f;
    advance_with(&state, coeffs, input);
    tap_check(state.mode == PLANT_SLIP_MINUS && plant_notes(&state.output).slip_minus == PLANT_SHARE_ONE,
              "backwards it overtakes the disc");
}

void test_step(void)
{
    plants_check_undamped(&plant, "normal exact spp 64", 2e-4f);
    plants_check_undamped(&plant, "normal exact spp 256", 2e-6f);
    plants_check_undamped(&plant, "spp 256", 1e-5f);
    check_forced();
    check_slope();
    check_stick("N0 1 y0 1 v0 0.05 xd0 0.05");
    check_stick("N0 1 y0 1 v0 -0.05 xd0 -0.05");
    check_naive();
    check_floor();
    check_speed_change();
}
