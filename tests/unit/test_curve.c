/* Pulses and tables: straight lines from point to point, jumps with their impulse, at every step. */
#include "sim/curve.h"

#include "base/fixed.h"
#include "base/fmath.h"
#include "plants.h"
#include "tap.h"
#include "tests.h"

/* Mass and stiffness for wn = 1 rad/s, so a step takes 2 pi/64 s; the model's units are 10 N and 10 m/s. */
#define UNIT_SET "m 1 ke 1 mu_s 0.1 N_max 10 v_max 10 "
#define STEP_S 0.0981747704f

static struct sim_plan plan;

static float load_at(uint64_t step) { return (float)curve_value(&plan.load.curve, step) / 13421772.8f; }
static float speed_at(uint64_t step) { return (float)curve_value(&plan.speed.curve, step) / 13421772.8f; }

/* Times in steps, values in the unit of the table. */
static void plan_of_table(const char *assignments, enum params_table_index index, uint32_t count,
                          const float points[][2])
{
    struct params params = plants_params(assignments);

    for (uint32_t i = 0u; i < count; i++) {
        params.tables[index].points[i] = (struct params_point){points[i][0] * STEP_S, points[i][1]};
    }
    params.tables[index].count = count;
    plants_plan(&plan, &params);
}

/* On straight lines, as a person would draw them. */
static float drawn(uint32_t count, const float points[][2], float time)
{
    uint32_t i = 0u;

    if (time < points[0][0]) {
        return points[0][1];
    }
    while (i + 1u < count && points[i + 1u][0] <= time) {
        i++;
    }
    return i + 1u == count ? points[i][1]
                           : points[i][1] + (points[i + 1u][1] - points[i][1]) * (time - points[i][0]) /
                                                (points[i + 1u][0] - points[i][0]);
}

static void check_lines(void)
{
    static const float points[][2] = {{3.3f, 1.0f},  {7.9f, 6.0f},  {8.1f, 5.0f},  {8.2f, 9.0f},
                                      {50.7f, 2.0f}, {51.0f, 2.0f}, {90.25f, 8.0f}};
    float worst = 0.0f;

    plan_of_table(UNIT_SET "load table", PARAMS_TABLE_LOAD, 7u, points);
    for (uint32_t i = 0u; i < 120u; i++) {
        worst = fmath_max(worst, fmath_abs(load_at(i) - drawn(7u, points, (float)i + 0.5f)));
    }
    tap_check_close(worst, 0.0f, 3e-5f, "a table is the line through its points, at the middle of each step");
    tap_check(load_at(0u) == 1.0f && load_at(200u) == 8.0f && load_at(UINT64_C(1) << 40) == 8.0f,
              "before the first and after the last it stays");
    tap_check(plan.load.end >= 91u && plan.load.end <= 94u, "and is known to");
    plan_of_table(UNIT_SET "load table", PARAMS_TABLE_LOAD, 1u, points);
    tap_check(load_at(0u) == 1.0f && load_at(1000u) == 1.0f && plan.load.end == 0u, "one point is a constant");
}

/* As many as there may be, at random. */
static void check_full(void)
{
    static float points[PARAMS_POINTS_MAX][2];
    uint32_t dice = 5u;
    float worst = 0.0f;
    float at = 0.0f;

    for (uint32_t i = 0u; i < PARAMS_POINTS_MAX; i++) {
        at += plants_random(&dice, 0.5f, 40.0f);
        points[i][0] = at;
        points[i][1] = plants_random(&dice, -9.0f, 9.0f);
    }
    plan_of_table(UNIT_SET "speed table", PARAMS_TABLE_SPEED, PARAMS_POINTS_MAX, (const float(*)[2])points);
    for (uint32_t i = 0u; i < 2700u; i++) {
        worst = fmath_max(
            worst, fmath_abs(speed_at(i) - drawn(PARAMS_POINTS_MAX, (const float(*)[2])points, (float)i + 0.5f)));
    }
    /* A time of 1300 steps has 24 bits, so it is known to 6e-5 steps; the steepest line falls 18 in half a step. */
    tap_check_close(worst, 0.0f, 4e-3f, "sixty-four of them, of either sign");
}

/* The impulse of what is held, and its first moment about step 0, against those of the jump. */
static void check_jump(float at)
{
    const float points[][2] = {{0.0f, 2.0f}, {at, 2.0f}, {at, 5.0f}, {200.0f, 5.0f}};
    float sum = 0.0f;
    float moment = 0.0f;

    plan_of_table(UNIT_SET "load table", PARAMS_TABLE_LOAD, 4u, points);
    for (uint32_t i = 0u; i < 60u; i++) {
        sum += load_at(i);
        moment += load_at(i) * ((float)i + 0.5f);
    }
    tap_check_close(sum, 2.0f * at + 5.0f * (60.0f - at), 2e-4f,
                    "a jump inside a step has the impulse of the real one");
    tap_check_close(moment, at * at + 2.5f * (3600.0f - at * at), 1e-2f, "and its first moment");
}

/* A disc's speed changes at the nearest grid point. */
static void check_speed_jump(void)
{
    static const float points[][2] = {{0.0f, 3.0f}, {10.4f, 3.0f}, {10.4f, -2.0f}, {20.6f, -2.0f}, {20.6f, 1.0f}};

    plan_of_table(UNIT_SET "speed table", PARAMS_TABLE_SPEED, 5u, points);
    tap_check(speed_at(9u) == 3.0f && fmath_abs(speed_at(10u) + 2.0f) < 1e-6f, "0.4 into a step it jumps at its begin");
    tap_check(fmath_abs(speed_at(20u) + 2.0f) < 1e-6f && fmath_abs(speed_at(21u) - 1.0f) < 1e-6f, "0.6 at its end");
}

/* One period of a pulse whose times are in steps. */
static float pulse(float time, float rise, float hold, float fall)
{
    if (time < rise) {
        return 1.0f + 4.0f * time / rise;
    }
    if (time < rise + hold) {
        return 5.0f;
    }
    return time < rise + hold + fall ? 5.0f - 4.0f * (time - rise - hold) / fall : 1.0f;
}

static void check_pulses(void)
{
    float worst = 0.0f;
    float sum = 0.0f;

    /* t1 5.25 steps, rise 3, hold 10, fall 6, every 31.5 */
    plan_of_table(UNIT_SET "load pulses N0 1 N1 5 t1 0.515417545 rise 0.294524311 hold 0.981747704 fall 0.589048623 "
                           "every 3.09250527",
                  PARAMS_TABLE_LOAD, 0u, NULL);
    for (uint32_t i = 0u; i < 3000u; i++) {
        const float time = (float)i + 0.5f - 5.25f;
        const float phase = time - 31.5f * (float)(int32_t)(time / 31.5f);
        const float expected = time < 0.0f ? 1.0f : pulse(phase, 3.0f, 10.0f, 6.0f);

        worst = fmath_max(worst, fmath_abs(load_at(i) - expected));
    }
    tap_check_close(worst, 0.0f, 5e-4f, "apply, hold, release, and again, at every step of a hundred pulses");
    tap_check(plan.load.end == UINT64_MAX, "without end");
    plan_of_table(UNIT_SET "load pulses N0 1 N1 5 t1 0.515417545 hold 1.5 every 3.0", PARAMS_TABLE_LOAD, 0u, NULL);
    /* -2 N for 0.515418 s, 999 whole periods of nothing, +2 N for 1.5 s, -2 N for 0.911043 s. */
    for (uint32_t i = 0u; i < 30557u; i++) {
        sum += load_at(i) - 3.0f;
    }
    tap_check_close(sum, 0.147079f / STEP_S, 0.02f,
                    "sudden ones have the impulse of the real ones, wherever in a step they come");
    tap_check_close(load_at(5u), 1.0f + 4.0f * 0.5f * 1.75f * 0.75f, 2e-5f, "the first comes 0.25 into its step");
    tap_check_close(load_at(6u), 1.0f + 4.0f * 0.5f * 1.75f * 1.25f, 2e-5f, "and is made up for in the next");
}

static void check_once(void)
{
    plan_of_table(UNIT_SET "load pulses N0 1 N1 5 t1 0.981747704 rise 0.294524311 hold 0.981747704 fall 0.589048623",
                  PARAMS_TABLE_LOAD, 0u, NULL);
    tap_check_close(load_at(9u), 1.0f, 1e-6f, "one pulse begins from rest");
    tap_check_close(load_at(10u), 1.0f + 4.0f * 0.5f / 3.0f, 2e-5f, "rises");
    tap_check_close(load_at(20u), 5.0f, 1e-6f, "holds");
    tap_check_close(load_at(25u), 5.0f - 4.0f * 2.5f / 6.0f, 2e-5f, "falls");
    tap_check(load_at(29u) == load_at(0u) && load_at(1000000u) == load_at(0u) && plan.load.end < 33u, "and is over");
}

/* 1e4 s are 1e11 steps, later than any point in time. */
static void check_rare(void)
{
    plan_of_table("m 1e-6 ke 1e6 mu_s 0.1 N_max 10 v_max 10 load pulses N0 1 N1 5 rise 1e-4 every 1e4",
                  PARAMS_TABLE_LOAD, 0u, NULL);
    tap_check(load_at(3000u) == 1.0f, "a pulse that never comes again is over in its time");
}

static void check_limits(void)
{
    static const float points[][2] = {{0.0f, 0.0f}, {10.0f, 10.0f}, {10.0f, 1.0f}, {30.0f, 1.0f}};

    plan_of_table(UNIT_SET "load table N_off -2 N_low 0.5 N_high 6", PARAMS_TABLE_LOAD, 4u, points);
    tap_check_close(load_at(2u), 0.5f, 1e-6f, "an offset comes first, then the limits");
    tap_check_close(load_at(5u), 3.5f, 1e-5f, "between them it is the line");
    tap_check_close(load_at(9u), 6.0f, 1e-6f, "above, the upper one");
    tap_check_close(load_at(10u), 0.5f, 1e-5f, "and after the jump the lower one");
}

void test_curve(void)
{
    check_lines();
    check_full();
    check_jump(10.0f);
    check_jump(10.3f);
    check_jump(10.5f);
    check_jump(10.9f);
    check_speed_jump();
    check_pulses();
    check_once();
    check_rare();
    check_limits();
}
