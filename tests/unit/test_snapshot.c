/* A run as bytes: it goes on with the same bits elsewhere, and what is forged does no harm. That no field is forgotten
 * is for tools/check_snapshot to say. */
#include "sim/snapshot.h"

#include "base/bytes.h"
#include "base/crc32.h"
#include "base/fmath.h"
#include "base/mem.h"
#include "plants.h"
#include "tap.h"
#include "tests.h"

static struct executive one;
static struct executive other;
static uint8_t image[SNAPSHOT_SIZE];

static void open_brake(struct executive *executive, float arith, const char *assignments)
{
    struct params params = plants_preset("brake", assignments);

    params.arithmetic = arith;
    params.tables[PARAMS_TABLE_LOAD] =
        (struct params_points){4u, {{0.0f, 500.0f}, {0.02f, 3000.0f}, {0.02f, 2000.0f}, {0.06f, 2500.0f}}};
    params.tables[PARAMS_TABLE_SPEED] = (struct params_points){2u, {{0.01f, 1.5f}, {0.05f, -0.5f}}};
    executive_init(executive, ARITH_F32);
    (void)executive_reset(executive, &params);
    executive_tick(executive, false);
}

static void run(struct executive *executive, uint32_t steps)
{
    executive_grant(executive, steps);
    plants_spend(executive);
}

static void demand(struct executive *executive, float newton, uint64_t step)
{
    const struct input_demand wanted = {.load = INPUT_LOAD_FORCE, .load_value = newton, .step = step};

    (void)executive_input(executive, &wanted, NULL);
}

static void take(struct executive *executive)
{
    executive_snapshot(executive);
    executive_tick(executive, false);
    memcpy(image, executive->image, sizeof image);
}

static enum error put_back(struct executive *executive)
{
    enum error error;

    memcpy(executive->image, image, sizeof image);
    error = executive_restore(executive).error;
    if (error == ERROR_OK) {
        executive_tick(executive, false);
    }
    return error;
}

/* --- It goes on --------------------------------------------------------------------------------------------------- */

static bool go_on_alike(uint32_t steps)
{
    run(&one, steps);
    run(&other, steps);
    take(&one);
    executive_snapshot(&other);
    executive_tick(&other, false);
    return one.sim.hash == other.sim.hash && memcmp(image, other.image, sizeof image) == 0;
}

/* Many runs, each left at a random step with demands in all stages, and gone on with by another executive. */
static void check_going_on(float arith)
{
    static const char *const sets[] = {
        "",
        "normal exact",
        "load sine N0 2000 N1 700 fN 500 spp 128",
        "contact lift normal exact load step N0 3000 N1 1000 t1 0.01",
        "stale 0.003 safe 0.006 ramp 0.01",
        "method naive",
        "cn 5 normal exact rough 0.01 runout 0.2",
        "load table lag 0.004 dither 200 f_dither 1700 speed table v_lag 0.01",
        "load pulses t1 0.003 rise 0.001 hold 0.004 every 0.0071 speed inertia J 0.05",
        "speed sine v1 0.3 fv 90 v_off 0.1 v_dither 0.05 fv_dither 700 lag 0.5 N_high 2000",
        "mu_floor 0.1 contact no_pull speed ramp v1 -0.1 tv2 0.05"};
    uint32_t state_of_dice = 7u;
    bool ok = true;

    executive_init(&other, ARITH_F32);
    for (unsigned i = 0u; i < sizeof sets / sizeof sets[0]; i++) {
        const uint32_t before = plants_scaled(100u + tap_random(&state_of_dice) % 20000u, 300u);

        open_brake(&one, arith, sets[i]);
        demand(&one, 2500.0f, before / 2u);
        demand(&one, 2800.0f, before + 500u);
        run(&one, before / 3u);
        executive_measure(&one, 3u * (uint64_t)before);
        executive_tick(&one, false);
        run(&one, before - before / 3u);
        demand(&one, 2600.0f, INPUT_NOW); /* on its way */
        take(&one);
        memset(&other.sim, 0xa5, sizeof other.sim);
        memset(&other.inputs_waiting, 0xa5, sizeof other.inputs_waiting);
        ok = put_back(&other) == ERROR_OK && go_on_alike(plants_scaled(6000u, 1000u)) && ok;
    }
    tap_check(ok, "left at any step, it goes on with the same bits, verdicts and counters");
}

/* Left where a frame is full, and at the steps after it, while the detector is at work on it. */
static void check_frame_end(void)
{
    bool ok = true;

    for (uint32_t after = 0u; after < 4u; after++) {
        open_brake(&one, (float)ARITH_Q27, "spp 64");
        run(&one, DETECTOR_FRAME_PERIODS * 64u + after);
        take(&one);
        ok = put_back(&other) == ERROR_OK && go_on_alike(1000u) && ok;
    }
    tap_check(ok, "so it does from where a frame of the detector ends");
}

static void check_standing(void)
{
    struct executive_report report;

    open_brake(&one, (float)ARITH_F32, "substeps 7");
    run(&one, 777u);
    take(&one);
    open_brake(&other, (float)ARITH_Q27, "N1 1000 tick 50");
    executive_stream(&other, 10u);
    executive_tick(&other, false);
    run(&other, 55u);
    tap_check(put_back(&other) == ERROR_OK, "a run of another arithmetic");
    executive_report(&other, &report);
    tap_check(report.now.step == 777u && report.now.hash == one.sim.hash && report.load.ticks == 0u,
              "is reported as it stands");
    tap_check(memcmp(executive_params(&other), executive_params(&one), sizeof(struct params)) == 0,
              "its set is the one in force");
    tap_check(other.resets == 3u && executive_scale(&other, report.now.epoch) == &other.scales[report.now.epoch & 1u] &&
                  executive_scale(&other, report.now.epoch)->step_s == executive_plan(&one)->scale.step_s,
              "and its scale");
    while (ring_pop(&other.samples, &report.now)) {
    }
    run(&other, 10u);
    tap_check(ring_fill(&other.samples) == 1u, "the stream goes on, counted from there");
    open_brake(&one, (float)ARITH_F32, "v_max 8");
    run(&one, 100u);
    (void)plants_order(&one, "", false, NULL);
    take(&one);
    tap_check(put_back(&other) == ERROR_OK && other.in_force.plan.scale.speed_m_per_s == 8.0f,
              "units are those that were latched");
}

static void check_room(void)
{
    open_brake(&one, (float)ARITH_F32, "");
    for (uint64_t i = 0u; i < INPUT_QUEUE_MAX; i++) {
        demand(&one, 2000.0f, 10000u + i);
    }
    run(&one, 1u);
    take(&one);
    tap_check(put_back(&other) == ERROR_OK && other.inputs_waiting.count == INPUT_QUEUE_MAX, "demands that wait");
    demand(&other, 2000.0f, 20000u);
    tap_check(other.inputs_refused == 1u, "take their room");
    (void)plants_order(&other, "N0 2", true, NULL);
    executive_tick(&other, false);
    demand(&other, 2.0f, 20000u);
    tap_check(other.inputs_refused == 1u, "and a reset gives it back");
}

/* --- What is refused ---------------------------------------------------------------------------------------------- */

static void sign(void)
{
    struct bytes_writer writer = {.bytes = image + SNAPSHOT_SIZE - 4, .capacity = 4u};

    bytes_put_u32(&writer, crc32_add(0u, image, SNAPSHOT_SIZE - 4u));
}

/* The image with a byte changed and a CRC that fits. */
static enum error with_byte(size_t at, uint8_t byte)
{
    const uint8_t before = image[at];
    enum error error;

    image[at] = byte;
    sign();
    error = put_back(&other);
    image[at] = before;
    sign();
    return error;
}

static void check_refusals(void)
{
    enum {
        SET = 4,
        PARAM_N0 = SET + 4 * 11,
        COUNT = SET + 4 * 65,
        LATCHED_LOAD = COUNT + 2 * (4 + 8 * PARAMS_POINTS_MAX),
        SHIFT = LATCHED_LOAD + 8
    };
    uint32_t hash;
    bool ok = true;

    open_brake(&one, (float)ARITH_F32, "");
    run(&one, 5000u);
    take(&one);
    open_brake(&other, (float)ARITH_F32, "N1 1000");
    run(&other, 100u);
    hash = other.sim.hash;
    for (size_t i = 0u; i < SNAPSHOT_SIZE; i += plants_scaled(1u, 53u)) {
        image[i] ^= (uint8_t)(1u << i % 8u);
        ok = put_back(&other) == ERROR_WRONG_CRC && ok;
        image[i] ^= (uint8_t)(1u << i % 8u);
    }
    tap_check(ok, "one bit that is not as it was");
    tap_check(with_byte(0u, SNAPSHOT_LAYOUT + 1) == ERROR_WRONG_LAYOUT, "another layout");
    tap_check(with_byte(2u, PARAMS_VERSION + 1) == ERROR_WRONG_LAYOUT, "another table of parameters");
    tap_check(with_byte(PARAM_N0 + 3u, 0xc0u) == ERROR_OUT_OF_RANGE, "a parameter out of its range");
    image[PARAM_N0 + 2u] = 0xc0u;
    tap_check(with_byte(PARAM_N0 + 3u, 0x7fu) == ERROR_OUT_OF_RANGE, "one that is no number");
    image[PARAM_N0 + 2u] = 0u;
    tap_check(with_byte(LATCHED_LOAD + 3u, 0x30u) == ERROR_OUT_OF_SCALE, "a set that does not fit its units");
    tap_check(with_byte(COUNT, 65u) == ERROR_OUT_OF_RANGE && with_byte(COUNT + 2u, 1u) == ERROR_OUT_OF_RANGE,
              "more points than a table holds");
    tap_check(with_byte(SHIFT, 9u) == ERROR_OUT_OF_RANGE, "units that there are not");
    tap_check(other.sim.hash == hash && other.sim.step == 100u && executive_params(&other)->load_end_n == 1000.0f &&
                  !executive_has_order(&other),
              "nothing of it happens");
    tap_check(put_back(&other) == ERROR_OK && other.sim.hash == one.sim.hash, "as it was it is fine");
}

/* A good run with one thing wrong, each of which might do harm: an index, a divisor, a number that does not fit. */
static struct sim forged;
static struct input_queue waiting;
static struct sim_plan forged_plan;

static void make_forged(float arith, const char *assignments)
{
    open_brake(&one, arith, assignments);
    demand(&one, 2500.0f, 7000u);
    demand(&one, 2400.0f, 8000u);
    run(&one, 3000u);
    forged = one.sim;
    waiting = one.inputs_waiting;
    forged_plan = one.in_force.plan;
    forged.plan = &forged_plan;
}

static bool is_refused(void)
{
    bool ok;

    snapshot_take(image, &forged, &waiting);
    ok = put_back(&other) == ERROR_OUT_OF_RANGE;
    forged = one.sim;
    waiting = one.inputs_waiting;
    forged_plan = one.in_force.plan;
    forged.plan = &forged_plan;
    return ok;
}

#define REFUSES(wrong)                  \
    do {                                \
        forged.wrong;                   \
        if (!is_refused()) {            \
            tap_note("forged." #wrong); \
            ok = false;                 \
        }                               \
    } while (0)

static void check_plants(void)
{
    const float no_number = fmath_from_bits(0x7fc00000u);
    bool ok = true;

    make_forged((float)ARITH_F32, "");
    tap_check(!is_refused() && other.sim.hash == one.sim.hash, "what is right is taken");
    REFUSES(f32.x = 1e9f);
    REFUSES(f32.v = no_number);
    REFUSES(f32.x_rest = 2.0f);
    REFUSES(f32.normal.y_rest = -2.0f);
    REFUSES(f32.normal.w_rest = 2.0f);
    REFUSES(f32.disc = 2.0f);
    REFUSES(f32.mode = 2);
    REFUSES(f32.normal.n = -3.0f);
    REFUSES(f32.normal.cosine = 1e6f);
    REFUSES(f32.normal.sine = -1e6f);
    REFUSES(f32.normal.least_force = 1.0f);
    REFUSES(f32.normal.phase = 256u);
    make_forged((float)ARITH_Q27, "normal exact cn 0");
    REFUSES(q27.is_saturated = true);
    REFUSES(q27.x = INT32_MIN);
    REFUSES(q27.v = 11 << 27);
    REFUSES(q27.disc = 2 << 27);
    REFUSES(q27.mode = -2);
    REFUSES(q27.normal.y = INT32_MIN);
    REFUSES(q27.normal.w = INT32_MIN);
    REFUSES(q27.normal.n = 3 << 27);
    REFUSES(q27.normal.least_force = 1);
    REFUSES(q27.normal.reach = -1);
    REFUSES(q27.normal.reach = 1 << 10);
    REFUSES(q27.normal.y = 3 << 27);
    REFUSES(q27.normal.is_lifted = true);
    REFUSES(q27.normal.phase.index = 256u);
    REFUSES(q27.normal.phase.minus_cosine += 1);
    REFUSES(q27.normal.phase.sine = 7 << 28);
    make_forged((float)ARITH_Q27, "contact lift");
    REFUSES(q27.normal.reach = 1 << 29);
    tap_check(ok, "no plant that is outside, or would leave its tables or its bounds");
}

static void check_rest(void)
{
    bool ok = true;

    make_forged((float)ARITH_F32, "");
    REFUSES(step = UINT64_C(1) << 60);
    REFUSES(v10_step = UINT64_C(1) << 60);
    REFUSES(v10_fraction_q15 = 1u << 20);
    REFUSES(f32.output.mode = 2);
    REFUSES(f32.output.mode = (int8_t)(forged.f32.mode == PLANT_STICK ? PLANT_SLIP_PLUS : PLANT_STICK));
    REFUSES(angle.rest = 1u << 31);
    REFUSES(texture = 1 << 30);
    REFUSES(input.load = 2.0f);
    REFUSES(input.speed = -2.0f);
    REFUSES(input.load_q27 = 2 << 27);
    REFUSES(input.speed_q27 = -(2 << 27));
    REFUSES(safe_load = 2.0f);
    REFUSES(safe_load_q27 = 2 << 27);
    REFUSES(watch.state = WATCH_SAFE + 1);
    REFUSES(watch.silence = WATCH_SILENCE_MAX + 1u);
    REFUSES(watch.ramp = WATCH_ALL + 1u);
    REFUSES(measure.done = 1u);
    REFUSES(measure.planned = UINT64_MAX);
    memset(&waiting, 0, sizeof waiting); /* nothing else to blame */
    waiting.count = INPUT_QUEUE_MAX + 1u;
    ok = is_refused() && ok;
    waiting.waiting[1].load = 2.0f;
    ok = is_refused() && ok;
    waiting.waiting[1].step = 1u;
    ok = is_refused() && ok;
    forged_plan.scale.load_n = 0.0f;
    ok = is_refused() && ok;
    forged_plan.scale.speed_m_per_s = -1.0f;
    ok = is_refused() && ok;
    tap_check(ok, "nothing held, measured or waiting that cannot be");
}

static void check_acting(void)
{
    bool ok = true;

    make_forged((float)ARITH_F32, "speed inertia J 0.05 lag 0.01");
    REFUSES(load.lag.value = 1.2f);
    REFUSES(speed.inertia.value = -1.2f);
    REFUSES(speed.inertia.rest = 2.0f);
    REFUSES(speed.lag.rest = -2.0f);
    REFUSES(load.lag.value_q56 = INT64_MAX);
    REFUSES(speed.inertia.value_q56 = INT64_MIN);
    tap_check(ok, "no lag or inertia beyond what the scale holds");
}

static void check_detectors(void)
{
    bool ok = true;

    make_forged((float)ARITH_F32, "");
    REFUSES(detector.phase = 64u);
    REFUSES(detector.periods = DETECTOR_FRAME_PERIODS);
    REFUSES(detector.periods = DETECTOR_FRAME_PERIODS + 1u);
    REFUSES(detector.frame_v_sum = INT64_C(1) << 40);
    REFUSES(detector.frame_v_sum = -(INT64_C(1) << 40));
    REFUSES(detector.evidence = 17u);
    REFUSES(detector.hysteresis = -1);
    REFUSES(detector.level = INT32_MIN);
    REFUSES(detector.period_step = UINT64_C(1) << 63);
    REFUSES(detector.has_diverged = true);
    REFUSES(detector.search.stage = 5u);
    REFUSES(detector.search.period = 18u);
    REFUSES(detector.search.index = 64u);
    REFUSES(detector.now.change_log2_q16 = INT32_MAX);
    REFUSES(detector.frames[3].change_log2_q16 = INT32_MIN);
    REFUSES(detector.frames[0].acceleration = -1);
    REFUSES(detector.verdict.propensity = PROPENSITY_SQUEAL + 1);
    REFUSES(detector.verdict.motion = CLASS_DIVERGING + 1);
    REFUSES(detector.verdict.period = 18u);
    REFUSES(detector.verdict.growth_q16 = INT32_MIN);
    REFUSES(detector.verdict.growth_error_q16 = INT32_MIN);
    REFUSES(detector.verdict.free_log2_q16 = INT32_MAX);
    REFUSES(detector.verdict.acceleration = -1);
    forged.detector.frame = 0u;
    forged.detector.search.stage = 2u;
    ok = is_refused() && ok;
    tap_check(ok, "no detector that would divide by nothing or search for ever");
}

/* A truth value is 0 or 1. */
static void check_flags(void)
{
    static uint8_t with[SNAPSHOT_SIZE];
    size_t at = 0u;

    make_forged((float)ARITH_F32, "");
    forged.has_v10 = true;
    snapshot_take(with, &forged, &waiting);
    forged.has_v10 = false;
    snapshot_take(image, &forged, &waiting);
    while (at < SNAPSHOT_SIZE && with[at] == image[at]) {
        at++;
    }
    tap_check(with_byte(at, 1u) == ERROR_OK && with_byte(at, 2u) == ERROR_OUT_OF_RANGE, "a flag is 0 or 1");
}

/* Whoever can compute a CRC can send anything: it is refused, or it runs. The sanitizers look on. */
static void check_forged(float arith, const char *assignments)
{
    static uint8_t good[SNAPSHOT_SIZE];
    uint32_t dice = 11u;
    uint32_t taken = 0u;
    const uint32_t rounds = plants_scaled(1500u, 60u);

    open_brake(&one, arith, assignments);
    demand(&one, 2500.0f, 7000u);
    run(&one, 6000u);
    take(&one);
    memcpy(good, image, sizeof good);
    for (uint32_t i = 0u; i < rounds; i++) {
        for (uint32_t changes = 1u + i % 4u; changes > 0u; changes--) {
            static const uint8_t edges[] = {0x00u, 0x01u, 0x7fu, 0x80u, 0xffu};
            const uint32_t at = 4u + tap_random(&dice) % (SNAPSHOT_SIZE - 8u);
            const uint32_t byte = tap_random(&dice) >> 8;

            image[at] = byte % 2u == 0u ? edges[byte / 2u % sizeof edges] : (uint8_t)(byte >> 8);
        }
        sign();
        if (put_back(&other) == ERROR_OK) {
            taken++;
            run(&other, 300u);
        }
        memcpy(image, good, sizeof good);
    }
    tap_check(taken > rounds / 10u && taken < rounds, "forged ones are refused, or run");
    tap_note_number("of them ran", (float)taken);
}

void test_snapshot(void)
{
    check_going_on((float)ARITH_F32);
    check_going_on((float)ARITH_Q27);
    check_frame_end();
    check_standing();
    check_room();
    check_refusals();
    check_plants();
    check_rest();
    check_acting();
    check_detectors();
    check_flags();
    check_forged((float)ARITH_F32, "");
    check_forged((float)ARITH_Q27, "");
    check_forged((float)ARITH_Q27, "normal exact");
    check_forged((float)ARITH_Q27, "contact lift normal exact");
    check_forged((float)ARITH_Q27, "load table lag 0.004 dither 200 f_dither 1700 speed inertia J 0.05");
    check_forged((float)ARITH_F32, "load pulses t1 0.003 hold 0.004 every 0.0071 speed table v_lag 0.01");
    check_forged((float)ARITH_F32, "contact lift normal exact stale 0.001 safe 0.002 ramp 0.01");
}
