/* Trials: when they end, what they measure, and that the growth they tell is that of the closed form. */
#include "sim/trial.h"

#include "base/fmath.h"
#include "plants.h"
#include "tap.h"
#include "tests.h"

static struct trial trial;
static const struct trial_span usual = {.transient = TRIAL_TRANSIENT_DEFAULT, .window = TRIAL_WINDOW_DEFAULT};
static const struct trial_span whole = {.transient = 400u, .window = 40u, .is_whole = true};
static const struct trial_span brief = {.transient = 1600u, .window = 40u, .is_brief = true};

static const struct trial *try_set(const struct params *params, const struct trial_span *span)
{
    const struct params_problem problem = trial_begin(&trial, params, span);

    tap_check(problem.error == ERROR_OK, "a set that can be had is tried");
    while (!trial_go_on(&trial, 100u)) {
    }
    return &trial;
}

static const struct trial *try_preset(const char *name, const char *assignments, const struct trial_span *span)
{
    const struct params params = plants_preset(name, assignments);

    return try_set(&params, span);
}

static uint8_t propensity(void) { return trial.sim.detector.verdict.propensity; }

static void check_ends(void)
{
    try_preset("brake", "", &usual);
    tap_check(trial.end == TRIAL_SQUEALED && propensity() == PROPENSITY_SQUEAL,
              "squeal that repeats ends the transient");
    tap_check(trial.sim.measure.done == 40u * 64u && trial_periods(&trial) < 500.0f,
              "the window is measured whole all the same");
    try_preset("brake", "N1 1000", &usual);
    tap_check(trial.end == TRIAL_DECAYED && propensity() == PROPENSITY_QUIET, "so does decay");
    tap_check(trial_periods(&trial) > 145.0f + 40.0f, "but not before the load has come to rest");
    try_preset("fig7-ke5000", "", &usual);
    tap_check(trial.end == TRIAL_DIVERGED && trial.sim.measure.done == 0u, "divergence ends all, without a window");
    try_preset("fig6-a0.04", "", &usual);
    tap_check(trial.end == TRIAL_WAS_WHOLE && trial_periods(&trial) == 400.0f, "what repeats in nothing runs whole");
    try_preset("brake", "load sine N0 3000 N1 100 fN 100", &usual);
    tap_check(trial.end == TRIAL_WAS_WHOLE, "so does a sine of the load");
    try_preset("brake", "load sine N0 3000 N1 0.001 fN 100", &usual);
    tap_check(trial.end == TRIAL_WAS_WHOLE && propensity() == PROPENSITY_SQUEAL,
              "also one so small that the motion repeats");
    try_preset("brake", "load step t1 0 lag 0.02", &usual);
    tap_check(trial.end == TRIAL_SQUEALED && trial_periods(&trial) > 400.0f, "a lag is waited for");
    try_preset("brake", "load step t1 0 dither 1 f_dither 100", &usual);
    tap_check(trial.end == TRIAL_WAS_WHOLE, "dither never comes to rest");
    try_preset("stop", "J 3", &usual);
    tap_check(trial.is_over && trial.sim.f32.disc == 0.0f && trial_periods(&trial) < 2000.0f,
              "a stop is watched until the disc stands");
    try_preset("stop", "J 3 N1 0", &usual);
    tap_check(trial.is_over && trial_periods(&trial) < 1000.0f, "and one that nothing brakes is not waited for");
    try_preset("brake", "", &whole);
    tap_check(trial.end == TRIAL_WAS_WHOLE && trial_periods(&trial) > 440.0f + 145.0f,
              "and what was asked for whole, counted from the end of the ramp");
}

/* Pressed on without a swing, the pad rides along for 60 periods until the spring holds mu N; then permanent slip is
 * stable and takes the motion away. Before, it is as still as it can be, and nothing is known. */
static void check_ride(void)
{
    try_preset("table1", "y0 1 v0 0.001 c 0.05 alpha 0", &usual);
    tap_check(trial.has_event && trial.end == TRIAL_DECAYED && propensity() == PROPENSITY_QUIET,
              "a pad that rides along is followed until it breaks loose and its motion dies out");
    tap_check(trial_periods(&trial) < 500.0f, "well before the end of its span");
    try_preset("table1", "y0 1 v0 0 x0 0.1 c 0.05", &usual);
    tap_check(trial.end == TRIAL_DECAYED && sim_output(&trial.sim)->v == 0, "under a stopped disc sticking is an end");
}

/* At resonance the forced motion creeps up to the disc's speed while its transient decays: that is no promise of
 * quiet. */
static void check_resonance(void)
{
    struct params params = plants_params("kt 0.5 k 0.5 c 0.0088 alpha 0 v0 33.9");
    const struct trial_span all = {.transient = 1600u, .window = 40u, .is_brief = true, .is_whole = true};

    try_set(&params, &usual);
    tap_check(trial.end != TRIAL_DECAYED && propensity() == PROPENSITY_SQUEAL, "touching late is squeal");
    try_set(&params, &brief);
    tap_check(trial_is_loud(&trial), "to a brief trial too");
    params = plants_preset("brake", "");
    try_set(&params, &all);
    tap_check(trial.end == TRIAL_WAS_WHOLE && trial_is_loud(&trial) && !trial_is_undecided(&trial),
              "one that shall run whole does");
    params = plants_preset("brake", "t2 1");
    try_set(&params, &usual);
    tap_check(trial.end == TRIAL_SQUEALED && trial_periods(&trial) > 2906.0f, "a slow ramp is waited for");
    params = plants_preset("brake", "N1 2000 t2 0.055 arith q27 rough 0 runout 0");
    try_set(&params, &brief);
    tap_check(trial_is_undecided(&trial) && !trial_is_loud(&trial), "on the border itself there is no proof");
    params = plants_preset("brake", "N1 1000");
    try_set(&params, &usual);
    tap_check(trial.end == TRIAL_DECAYED && trial.is_measuring && !trial_is_loud(&trial), "what decays is not loud");
    trial.sim.detector.verdict.propensity = PROPENSITY_SQUEAL;
    tap_check(trial_is_loud(&trial), "unless the window says squeal");
    trial.is_measuring = false;
    tap_check(!trial_is_loud(&trial), "where the growth ended it there is no window, and growth counts");
}

static void check_refusal(void)
{
    const struct params params = plants_params("spp 16 ke 0.3");

    tap_check(trial_begin(&trial, &params, &usual).error == ERROR_STEP_TOO_LARGE,
              "a set that cannot be had is refused");
}

static void check_slices(void)
{
    const struct params params = plants_preset("fig5-n5", "");
    struct plant plant;

    try_set(&params, &usual);
    plants_start_preset(&plant, "fig5-n5", "");
    plants_run_steps(&plant, (uint32_t)trial.sim.step);
    tap_check(plant.sim.f32.x == trial.sim.f32.x && plant.sim.f32.v == trial.sim.f32.v &&
                  plant.sim.detector.verdict.frame == trial.sim.detector.verdict.frame,
              "a trial makes the steps that the plant makes");
}

/* Growth of permanent slip, (N |alpha| - c)/2 sqrt(m ke) per unit of time: per normal period, from equilibrium. Noise
 * and run-out of the brake's disc blur it, but not its side. */
static void check_growth(const char *arithmetic)
{
    static const struct {
        const char *load;
        float newton;
    } rows[] = {{" N1 1900", 1900.0f}, {" N1 1990", 1990.0f}, {" N1 2010", 2010.0f}, {" N1 2100", 2100.0f}};
    float growth = 0.0f;
    float error = 0.0f;

    for (uint32_t i = 0u; i < 4u; i++) {
        struct params params = plants_preset("brake", arithmetic);
        const float expected = (rows[i].newton * 0.06f - 120.0f) / 0.6f * 3.44144233e-4f;

        params.load_end_n = rows[i].newton;
        try_set(&params, &brief);
        tap_check(trial_is_loud(&trial) == (expected > 0.0f), "the side is told through the starting noise");
        params.roughness_ratio = 0.0f;
        params.runout_ratio = 0.0f;
        try_set(&params, &brief);
        tap_check(trial_growth(&trial, &growth, &error), rows[i].load);
        tap_check_close(growth, expected, error + 0.01f * fmath_abs(expected), "growth as the closed form has it");
        tap_check(error < 2e-5f, "to 2e-5 a period");
        tap_check(trial_is_loud(&trial) == (expected > 0.0f), "which tells the side");
    }
}

static void check_onset(void)
{
    try_preset("fig5-n5", "", &whole);
    tap_check(trial.has_flag && trial.has_onset && trial.flag_step > trial.onset_step,
              "squeal is flagged after the first stick");
    tap_check(trial.flag_step - trial.onset_step < 64u * 40u, "within 40 periods");
    try_preset("brake", "", &whole);
    tap_check(trial.has_flag && !trial.has_onset && trial.event_step > trial.flag_step,
              "what grows by itself is flagged before it sticks");
    try_preset("table1", "", &whole);
    tap_check(!trial.has_event && !trial.has_flag, "a pad that slips on has neither");
}

void test_trial(void)
{
    check_ends();
    check_ride();
    check_resonance();
    check_refusal();
    check_slices();
    check_growth("");
    check_growth("arith q27");
    check_onset();
}
