/* Load and speed over time: held at the middle of each step, steps rounded to the grid, from the index alone. */
#include "sim/profile.h"

#include "base/fmath.h"
#include "model/sine.h"
#include "plants.h"
#include "tap.h"
#include "tests.h"

/* Mass and stiffness for wn = 1 rad/s; N_max and v_max make the model's units 1 N and 1 m/s. */
#define UNIT_SET "m 1 ke 1 mu_s 0.1 N_max 10 v_max 10 "

static struct sim_plan plan; /* of the profile under test */

static void plan_of(const char *assignments)
{
    const struct params params = plants_params(assignments);

    plants_plan(&plan, &params);
}

/* Loads in newtons at a step of the present plan. */
static float load_at(uint64_t step) { return profile_value(&plan.load.profile, step) * plan.scale.load_n; }
static float speed_at(uint64_t step) { return profile_value(&plan.speed.profile, step) * plan.scale.speed_m_per_s; }

static bool load_moves(uint64_t step) { return step < plan.load.profile.end; }

static void check_constant(void)
{
    plan_of(UNIT_SET "N0 2 N1 5 v0 -3 v1 1");
    tap_check_close(load_at(0u), 2.0f, 1e-6f, "a constant load at the start");
    tap_check(load_at(0u) == load_at(UINT64_MAX) && speed_at(0u) == speed_at(UINT64_MAX), "and for ever");
    tap_check_close(speed_at(5u), -3.0f, 1e-6f, "a constant speed with its sign");
    tap_check(!load_moves(0u) && plan.speed.profile.end == 0u, "which does not move");
}

/* h = 0.0981748 s: 10.45 steps are 1.0259264 s, 10.55 are 1.0357438 s. */
static void check_step(void)
{
    uint32_t state = 31u;
    bool is_steady = true;

    plan_of(UNIT_SET "load step N0 2 N1 5 t1 1.0259264 speed step v0 1 v1 -2 tv1 1.0357438");
    tap_check_close(load_at(9u), 2.0f, 1e-6f, "before its instant a step has the first value");
    tap_check_close(load_at(10u), 2.0f + 3.0f * 0.42625f, 3e-5f, "a load step 0.45 into a model step begins in it");
    tap_check_close(load_at(11u), 2.0f + 3.0f * 1.12375f, 3e-5f, "and makes up for the rest in the next");
    tap_check_close(load_at(10u) + load_at(11u), 2.0f * 5.0f - 3.0f * 0.45f, 3e-5f, "with the impulse of the real one");
    tap_check_close(load_at(12u), 5.0f, 2e-6f, "then it has its last value");
    tap_check_close(speed_at(10u), 1.0f, 1e-6f, "a speed step 0.55 into a model step goes to the next grid point");
    tap_check_close(speed_at(11u), -2.0f, 1e-6f, "where the last value begins");
    tap_check(load_moves(11u) && !load_moves(12u), "it moves until then");
    plan_of(UNIT_SET "load step N0 2 N1 5 t1 0");
    tap_check_close(load_at(0u), 5.0f, 2e-6f, "a step at time 0 is there at once");
    for (uint32_t i = 0u; i < plants_scaled(2000u, 100u); i++) {
        struct params params = plants_params(UNIT_SET "load step t1 0");

        params.load_n = plants_random(&state, 0.0f, 10.0f);
        params.load_end_n = plants_random(&state, 0.0f, 10.0f);
        plants_plan(&plan, &params);
        is_steady = is_steady && load_at(0u) == load_at(2u) && load_at(1u) == load_at(2u);
    }
    tap_check(is_steady, "in one change, to the bit: the plant may take it for a load that never changed");
    plan_of(UNIT_SET "load step N0 2 N1 5 t1 1e6");
    tap_check_close(load_at(10000000u), 2.0f, 1e-6f, "a late step waits");
}

/* From 10.25 to 30.25 steps: 1.0062914 s and 2.9697868 s. */
static void check_ramp(void)
{
    bool rises = true;
    bool is_known = true;

    plan_of(UNIT_SET "load ramp N0 2 N1 6 t1 1.0062914 t2 2.9697868 speed ramp v0 4 v1 0 tv1 0 tv2 0.98174770");
    tap_check_close(load_at(9u), 2.0f, 1e-6f, "before a ramp there is the first value");
    tap_check_close(load_at(10u), 2.05f, 1e-5f, "its first step is held at its middle, 0.25 steps up the ramp");
    tap_check_close(load_at(20u), 4.05f, 1e-5f, "so is any other");
    tap_check_close(load_at(29u), 5.85f, 1e-5f, "and the last whole one");
    tap_check_close(load_at(30u), 6.0f, 2e-6f, "after it the last value");
    tap_check(load_at(31u) == load_at(UINT64_C(1) << 40) && load_at(31u) == load_at((UINT64_C(1) << 32) + 12u),
              "which stays");
    tap_check_close(speed_at(0u), 3.8f, 1e-5f, "a ramp of ten steps from time 0");
    tap_check_close(speed_at(9u), 0.2f, 1e-5f, "ends half a step before its end");
    tap_check(speed_at(10u) == 0.0f, "and then is over");
    for (uint32_t i = 0u; i < 40u; i++) {
        rises = rises && load_at(i + 1u) >= load_at(i);
        is_known = is_known && (load_moves(i) || i >= 30u) && !(load_moves(i) && i > 32u);
    }
    tap_check(rises, "it never falls back");
    tap_check(is_known, "it is known to move until its end, and at most two steps longer");
    plan_of(UNIT_SET "load ramp N0 2 N1 6 t1 0 t2 0");
    tap_check_close(load_at(0u), 6.0f, 2e-6f, "a ramp without length is a step");
}

/* 3/1024 turns a step, 0.0304 Hz: the phase at the middle of step i is 3 (2 i + 1)/2048 turns. */
static float expected_sine(uint64_t step)
{
    const uint32_t phase = (uint32_t)((2u * step + 1u) * 3u % 2048u);

    return 5.0f + 2.0f * fmath_sine_turns(phase << 21);
}

static void check_sine(void)
{
    float worst = 0.0f;

    plan_of(UNIT_SET "load sine N0 5 N1 2 t1 0.4908739 fN 0.029841552");
    tap_check_close(load_at(4u), 5.0f, 2e-6f, "before its start a sine has its mean");
    tap_check_close(load_at(5u), expected_sine(5u), 1e-5f, "then it counts its phase from time 0");
    for (uint64_t i = 0u; i < 2000u; i++) {
        const float error = load_at(1000000u + i) - expected_sine(1000000u + i);

        worst = fmath_max(worst, fmath_abs(error));
    }
    /* The frequency in turns a step has 24 bits: after 3000 turns its last bit is worth 2e-4 turns. */
    tap_check_close(worst, 0.0f, 3e-3f,
                    "a million steps later the phase is off by no more than the frequency's rounding");
    tap_check(load_moves(UINT64_MAX - 1u), "a sine never ends");
    plan_of(UNIT_SET "load sine N0 5 N1 2 fN 0.15915494"); /* 1/64 turn a step but for the last bit */
    tap_check_close(load_at(15u), 5.0f + 2.0f * fmath_sine_turns(0x3e000000u), 1e-5f, "just before its crest");
    tap_check_close(load_at(48u), 5.0f - 2.0f * fmath_sine_turns(0x3e000000u), 1e-5f, "and just after its trough");
}

static void check_exact_phase(void)
{
    /* A frequency that is a power of two of the steps' rate is exact, so its phase never drifts. */
    const struct profile profile = {.kind = DEMAND_SINE,
                                    .to = 1.0f,
                                    .low = -1.0f,
                                    .high = 1.0f,
                                    .first = 1.0f,
                                    .second = 1.0f,
                                    .turns_per_step = UINT64_C(1) << 58,
                                    .end = UINT64_MAX};
    const uint64_t late = UINT64_C(1) << 50;
    bool is_same = true;

    for (uint64_t i = 0u; i < 64u; i++) {
        is_same = is_same && profile_value(&profile, i) == profile_value(&profile, late + i);
    }
    tap_check(is_same, "an exact frequency gives the same bits after 2^50 steps");
    tap_check(profile_value(&profile, 0u) == fmath_sine_turns(0x02000000u), "half a step after 0 at first");
    plan_of(UNIT_SET "load sine N0 5 N1 2 fN 1.2345678e-5");
    tap_check((float)plan.load.profile.turns_per_step == 1.2345678e-5f * plan.scale.step_s * 18446744073709551616.0f,
              "a low frequency keeps all its bits");
}

void test_profile(void)
{
    check_constant();
    check_step();
    check_ramp();
    check_sine();
    check_exact_phase();
}
