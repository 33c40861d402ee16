/* The closed-form prediction against rows of the paper and of the brake whose motion is known. */
#include "analysis/predictor.h"

#include "base/fmath.h"
#include "plants.h"
#include "tap.h"
#include "tests.h"

static struct sim_plan plan;

static struct prediction predict(struct params params)
{
    plants_plan(&plan, &params);
    return plan.prediction;
}

static bool says(const char *assignments, enum predictor_verdict verdict)
{
    const struct prediction prediction = predict(plants_params(assignments));

    return prediction.verdict == verdict;
}

static bool says_of(const char *preset, const char *assignments, enum predictor_verdict verdict)
{
    const struct prediction prediction = predict(plants_preset(preset, assignments));

    return prediction.verdict == verdict;
}

/* Classes of tests/golden: forced motion or rest is quiet, everything that sticks, crosses or grows is squeal. */
static void check_paper(void)
{
    tap_check(says_of("fig5-n1", "", PREDICTION_QUIET) && says_of("fig6-a0.004", "", PREDICTION_QUIET), "N = 1: quiet");
    tap_check(says_of("fig5-n2", "", PREDICTION_SQUEAL) && says_of("fig5-n5", "", PREDICTION_SQUEAL) &&
                  says_of("fig5-n50", "", PREDICTION_SQUEAL),
              "N = 2 and more: the forced motion reaches the disc's speed");
    tap_check(says("N0 1.8", PREDICTION_WATCH) && says("N0 1.9", PREDICTION_SQUEAL), "which begins at N = 1.84");
    tap_check(says("N0 1.86", PREDICTION_WATCH), "next to it both are possible");
    tap_check(says("N0 10 alpha -0.02", PREDICTION_SQUEAL) && says_of("fig6-a0.02", "", PREDICTION_SQUEAL),
              "N |alpha| beyond c: permanent slip is unstable");
    tap_check(says("alpha -0.00999", PREDICTION_WATCH), "N |alpha| next to c: too close to call");
    tap_check(says_of("fig8-g0.25", "", PREDICTION_SQUEAL) && says_of("fig8-g1", "", PREDICTION_SQUEAL) &&
                  says_of("fig8-g2", "", PREDICTION_QUIET) && says_of("fig8-g3", "", PREDICTION_QUIET),
              "away from resonance it is quiet");
    tap_check(says("N0 4.99 y0 4.99", PREDICTION_WATCH) && says("N0 4 y0 4", PREDICTION_QUIET) &&
                  says("N0 6 y0 6", PREDICTION_SQUEAL),
              "without a step of the load only N |alpha| counts");
}

/* Growth of permanent slip is -(C + eps)/2 far from the tongue, with hand values for Table 1 at N = 1. */
static void check_rate(void)
{
    struct prediction prediction = predict(plants_params("N0 1"));

    tap_check_close(prediction.rate, -0.5f * (0.018257419f - 0.0036514837f), 1e-7f, "rate of Table 1");
    tap_check_close(prediction.touch_ratio, 0.54407f, 1e-3f, "its forced speed is 0.544 of the disc's");
    tap_check(prediction.onset_touch_ratio > prediction.touch_ratio, "and more at the onset");
    prediction = predict(plants_params("N0 1 v0 -1"));
    tap_check_close(prediction.touch_ratio, 0.54407f, 1e-3f, "a disc that turns back is the same brake");
    /* Tongue at Z = 1/2: unstable beyond 2/3 of c, half way up (A eps/4)^2 counts in full. */
    tap_check(says("kt 0.125 k 0.125 N0 0.3 alpha -0.0215", PREDICTION_QUIET) &&
                  says("kt 0.125 k 0.125 N0 0.3 alpha -0.0227", PREDICTION_SQUEAL),
              "at Z = 1/2 the threshold is two thirds of c");
    prediction = predict(plants_params("kt 0.125 k 0.125 N0 0.3 alpha -0.03"));
    tap_check_close(prediction.rate, -0.5f * (0.018257419f - 0.016431677f) + 0.25f * 0.016431677f, 1e-6f,
                    "the rate in the middle of the tongue");
    tap_check(says("kt 0.125 k 0.125 N0 0.3 y0 0.3 alpha -0.03", PREDICTION_QUIET), "which needs a normal oscillation");
}

static void check_brake(void)
{
    struct prediction prediction;

    tap_check(says_of("brake", "N1 1500", PREDICTION_QUIET) && says_of("brake", "N1 1900", PREDICTION_QUIET),
              "brake: quiet below 2000 N");
    tap_check(says_of("brake", "N1 2100", PREDICTION_SQUEAL) && says_of("brake", "N1 3000", PREDICTION_SQUEAL) &&
                  says_of("brake", "v0 0.02", PREDICTION_SQUEAL),
              "brake: squeal above");
    prediction = predict(plants_preset("brake", "v0 1.1"));
    tap_check(prediction.verdict == PREDICTION_QUIET && prediction.is_bistable,
              "brake: quiet past the knee of the floor, but a kick may start it");
    prediction = predict(plants_preset("brake", "v0 1.1 N1 1500"));
    tap_check(prediction.verdict == PREDICTION_QUIET && !prediction.is_bistable, "brake: with less load not even that");
    tap_check(!predict(plants_preset("brake", "")).is_bistable, "brake: on the slope nothing is bistable");
    tap_check(says("m 0.235 c 0.0707 v0 2.73 mu_s 0.314 alpha -0.062 ke 3.7 kt 0.229 k 0.869 N0 2.91 y0 0.787 "
                   "mu_floor 0.1545",
                   PREDICTION_WATCH),
              "where the onset alone is kick enough, quiet is not promised");
    tap_check(says_of("groan", "N1 400", PREDICTION_QUIET) && says_of("groan", "", PREDICTION_SQUEAL) &&
                  says_of("groan", "v0 0.1", PREDICTION_QUIET),
              "groan: from 452 N, at creep only");
    tap_check(says_of("brake", "speed step tv1 1 v1 1.1", PREDICTION_QUIET) &&
                  says_of("brake", "N1 1000 load constant N0 3000", PREDICTION_SQUEAL),
              "the end of the profiles counts");
}

static void check_standstill(void)
{
    struct prediction prediction = predict(plants_params("v0 0"));

    tap_check(prediction.verdict == PREDICTION_UNKNOWN && fmath_is_finite(prediction.touch_ratio),
              "a disc at rest is not predicted");
    tap_check(says("speed ramp tv2 5 v1 0", PREDICTION_UNKNOWN) && says("v0 0 speed step v1 1", PREDICTION_QUIET),
              "nor one that comes to rest, but one that starts is");
    prediction = predict(plants_params("N0 1 alpha -0.1 mu_floor 0.25"));
    tap_check_close(prediction.touch_ratio, 0.45636f, 1e-3f, "on the floor its friction moves the pad");
    tap_check(says("N0 2 cn 0.1", PREDICTION_QUIET), "a damped normal oscillation does not last");
    tap_check(says("N0 0", PREDICTION_QUIET), "no load, no noise");
    tap_check(says("contact lift load step N0 4 N1 0 t1 5", PREDICTION_QUIET), "a pad let go does not come back");
}

/* A ramp of whole normal periods leaves no oscillation, one of half a period leaves 2/pi of the step's. */
static void check_ramp(void)
{
    const float step = predict(plants_params("N0 0 N1 1 load step")).touch_ratio;

    tap_check_close(step, 0.54407f, 1e-3f, "a step after the start is a step");
    tap_check_close(predict(plants_params("N0 0 N1 1 load ramp t2 3.44144")).touch_ratio, 0.0f, 1e-3f,
                    "a ramp of one period leaves the pad at rest");
    tap_check_close(predict(plants_params("N0 0 N1 1 load ramp t2 1.72072")).touch_ratio, step * 0.6366198f, 1e-3f,
                    "one of half a period does not");
    tap_check_close(predict(plants_params("N0 0 N1 1 load ramp t1 5 t2 6.72072")).touch_ratio, step * 0.6366198f, 1e-3f,
                    "nor one that comes later");
}

/* A sine of the load below wn: y swings by N1/(1 - r^2), x by the same with its own resonance. */
static void check_sine(void)
{
    const struct prediction prediction = predict(plants_params("N0 0.5 y0 0.5 N1 0.1 load sine fN 0.14528816 alpha 0"));

    /* r = 1/2: N1/(0.75) r mu/(Z2 - r^2) sqrt(m ke)^-1 = 0.1/0.75 0.5 0.3/1.75/0.5477 */
    tap_check_close(prediction.touch_ratio, 0.0208655f, 2e-4f, "a sine of the load moves the pad by its response");
    tap_check(says("N0 1 N1 0.9 load sine fN 0.2906", PREDICTION_SQUEAL), "at wn it moves it far");
}

/* The other forms of the load, by what they have in common with those. */
static void check_forms(void)
{
    const float half = predict(plants_params("N0 0 N1 1 load ramp t2 1.72072")).touch_ratio;
    const float step = predict(plants_params("N0 0 N1 1 load step")).touch_ratio;
    struct params params = plants_params("load table");

    params.tables[PARAMS_TABLE_LOAD] = (struct params_points){3u, {{5.0f, 0.0f}, {5.86036f, 0.5f}, {6.72072f, 1.0f}}};
    tap_check_close(predict(params).touch_ratio, half, 1e-4f, "a table is its lines");
    tap_check_close(predict(plants_params("N0 0 N1 1 load pulses rise 1.72072 hold 9 fall 3")).touch_ratio, half, 1e-4f,
                    "a pulse is its rise");
    tap_check_close(predict(plants_params("N0 0 N1 1 load step lag 1")).touch_ratio, step * 0.48038446f, 1e-3f,
                    "a lag takes of an onset what it takes of wn");
    tap_check_close(predict(plants_params("N0 0.5 y0 0.5 dither 0.1 f_dither 0.14528816 alpha 0")).touch_ratio,
                    0.0208655f, 2e-4f, "dither is a sine of the load");
    tap_check(says("N0 1 N_off 0.9", PREDICTION_SQUEAL) && says("N0 2.5 N_high 1", PREDICTION_QUIET),
              "offset and limits are in the load that it is about");
    tap_check(says("speed inertia", PREDICTION_UNKNOWN) && says("speed inertia N0 0", PREDICTION_QUIET),
              "an inertia comes to rest where it is braked");
    tap_check(says_of("stop", "", PREDICTION_UNKNOWN), "so does the stop");
}

/* How large the plant's normal oscillation is in the end. */
static float oscillation(const char *assignments)
{
    static struct plant plant;
    float y;

    plants_start(&plant, assignments);
    plants_run_steps(&plant, 64u * 30u);
    y = plant.sim.f32.normal.y - plant.sim.f32.normal.n;
    return fmath_sqrt(y * y + plant.sim.f32.normal.w * plant.sim.f32.normal.w) / plant.sim.f32.normal.n;
}

static float share(const char *assignments)
{
    const struct params params = plants_params(assignments);

    plants_plan(&plan, &params);
    return predictor_finish(&params, &plan.scale).share;
}

/* Amplitude and phase: what is there from the beginning and what the onset adds meet. */
static void check_onsets(void)
{
    static const char *const sets[] = {"N0 1 N1 3 load step t1 5.3 y0 1.4 normal exact",
                                       "N0 1 N1 3 load step t1 5.3 lag 0.4 normal exact",
                                       "N0 1 N1 3 load step t1 6.1 lag 0.4 normal exact",
                                       "N0 1 N1 3 load ramp t1 5.3 t2 7 lag 1.3 y0 1.4 normal exact",
                                       "N0 1 N1 3 load pulses t1 4.3 rise 0.9 hold 999 lag 0.5 normal exact"};

    for (unsigned i = 0u; i < sizeof sets / sizeof sets[0]; i++) {
        tap_check_close(oscillation(sets[i]), share(sets[i]), 2e-3f, "what lasts of an onset is what the plant shows");
    }
}

void test_predictor(void)
{
    check_paper();
    check_rate();
    check_brake();
    check_standstill();
    check_ramp();
    check_sine();
    check_forms();
    check_onsets();
    tap_check_text(predictor_verdict_name(PREDICTION_UNKNOWN), "unknown", "the words of the protocol");
    tap_check_text(predictor_verdict_name(PREDICTION_SQUEAL), "squeal", "the words of the protocol");
}
