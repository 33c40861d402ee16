/* Load and speed over time in integers: the values of the float profile, with its exact ends. */
#include "base/fmath.h"
#include "plants.h"
#include "sim/profile.h"
#include "tap.h"
#include "tests.h"

#define UNIT_SET "m 1 ke 1 mu_s 0.1 N_max 10 v_max 10 "

static struct sim_plan plan;

/* Largest difference to the float profile over the first steps, in units of the scale. */
static void check_same(const char *assignments, uint32_t steps, const char *claim)
{
    const struct params params = plants_params(assignments);
    float worst = 0.0f;

    plants_plan(&plan, &params);
    for (uint32_t i = 0u; i < steps; i++) {
        const float load = (float)profile_q27_value(&plan.load.profile_q27, i) / 134217728.0f;
        const float speed = (float)profile_q27_value(&plan.speed.profile_q27, i) / 134217728.0f;

        worst = fmath_max(worst, fmath_abs(load - profile_value(&plan.load.profile, i)));
        worst = fmath_max(worst, fmath_abs(speed - profile_value(&plan.speed.profile, i)));
    }
    tap_check_close(worst, 0.0f, 3e-7f, claim);
}

static int32_t load_at(uint64_t step) { return profile_q27_value(&plan.load.profile_q27, step); }

static void check_ends(void)
{
    const int32_t five = fixed_from_float(0.5f, 27);
    struct params params = plants_params(UNIT_SET "load step N0 2 N1 5 t1 1.0210176");

    plants_plan(&plan, &params);
    tap_check(load_at(9u) == fixed_from_float(0.2f, 27) && load_at(12u) == five && load_at(UINT64_MAX) == five,
              "a step begins and ends with its values, to the bit");
    params = plants_params(UNIT_SET "load ramp N0 2 N1 5 t1 0.3 t2 1e6");
    plants_plan(&plan, &params);
    tap_check(load_at(0u) == fixed_from_float(0.2f, 27) && load_at(10200000u) == five && load_at(UINT64_MAX) == five,
              "so does a ramp of a million seconds");
    tap_check_close((float)load_at(5092958u) / 134217728.0f, 0.35f, 1e-6f, "whose middle is in the middle");
    params = plants_params(UNIT_SET "load ramp N0 2 N1 5 t1 1 t2 1.0001");
    plants_plan(&plan, &params);
    tap_check(load_at(9u) == fixed_from_float(0.2f, 27) && load_at(11u) == five, "and one within a step");
}

static void check_sine(void)
{
    float worst = 0.0f;
    bool is_odd = true;

    for (uint32_t i = 0u; i < 4096u; i++) {
        const uint32_t turns = i * 1048583u;
        const float error = (float)fmath_sine_turns_q30(turns) / 1073741824.0f - fmath_sine_turns(turns);

        worst = fmath_max(worst, fmath_abs(error));
        is_odd = is_odd && fmath_sine_turns_q30(0u - turns) == -fmath_sine_turns_q30(turns) &&
                 fmath_sine_turns_q30(0x80000000u - turns) == fmath_sine_turns_q30(turns);
    }
    tap_check_close(worst, 0.0f, 1.2e-7f, "the sine of the profile is that of the float profile");
    tap_check(is_odd && fmath_sine_turns_q30(0u) == 0 && fmath_sine_turns_q30(0x40000000u) - (1 << 30) <= 4 &&
                  fmath_sine_turns_q30(0x40000000u) - (1 << 30) >= -4,
              "odd and symmetric to the bit, with its crest at 1");
}

void test_profile_q27(void)
{
    check_same(UNIT_SET "N0 2 v0 -3", 100u, "constant");
    check_same(UNIT_SET "load step N0 2 N1 5 t1 1.0210176 speed step v0 1 v1 -2 tv1 1.0406526", 100u, "a step");
    check_same(UNIT_SET "load step N0 5 N1 0 t1 0 speed step v0 1 v1 -2 tv1 0", 10u, "a step at the start");
    check_same(UNIT_SET "load ramp N0 2 N1 6 t1 1.0062914 t2 2.9697868 speed ramp v0 4 v1 0 tv1 0 tv2 0.98174770", 100u,
               "a ramp");
    check_same(UNIT_SET "load ramp N0 2 N1 6 t1 1 t2 1.03 speed ramp v0 4 v1 -4 tv1 0.01 tv2 0.12", 100u,
               "a ramp shorter than two steps");
    check_same(UNIT_SET "load sine N0 5 N1 2 t1 0.4908739 fN 0.029841552", 2000u, "a sine");
    check_same(UNIT_SET "load sine N0 5 N1 2 t1 0 fN 3.3", 2000u, "a fast sine");
    check_ends();
    check_sine();
}
