/* Which motion the detector names: periods, beats, the pad's own time, divergence. */
#include "sim/detector.h"

#include "tap.h"
#include "tests.h"
#include "tones.h"

static struct tones bench;

static void check_periods(void)
{
    tones_start(&bench, 0.25f, tones_forced, (struct tone){0.05f, TONES_TURN / 2, 0.0f});
    tap_check(tones_say(tones_run_to(&bench, 8u), PROPENSITY_QUIET, CLASS_FORCED, 2u),
              "a tone of half the frequency: period 2");
    tones_start(&bench, 0.25f, tones_forced, (struct tone){0.05f, TONES_TURN / 3 + 1, 0.0f});
    tap_check(tones_say(tones_run_to(&bench, 8u), PROPENSITY_QUIET, CLASS_FORCED, 3u), "a third: period 3");
    bench.stick_steps = 3u;
    tap_check(tones_say(tones_run_to(&bench, 14u), PROPENSITY_SQUEAL, CLASS_STICKSLIP, 3u), "sticking too");
    tones_start(&bench, 0.25f, tones_forced, (struct tone){0.05f, TONES_TURN / 16, 0.0f});
    tap_check(tones_say(tones_run_to(&bench, 8u), PROPENSITY_QUIET, CLASS_FORCED, 16u), "a sixteenth: period 16");
    tones_start(&bench, 0.25f, tones_forced, (struct tone){0.05f, TONES_TURN_OWN, 0.0f});
    tap_check(tones_say(tones_run_to(&bench, 8u), PROPENSITY_QUIET, CLASS_APERIODIC, 0u),
              "a tone of its own: no period");
    tones_start(&bench, 0.25f, tones_forced, (struct tone){0.05f, TONES_TURN / 17 + 1, 0.0f});
    tap_check(tones_run_to(&bench, 8u)->period == 0u, "a seventeenth is beyond what is tried");
}

/* Rounding in integers may lock into a circle of some hundred counts that repeats after a few periods. */
static void check_rounding(void)
{
    tones_start(&bench, 0.01f, (struct tone){0.0004f, TONES_TURN, 0.0f},
                (struct tone){1e-6f, TONES_TURN / 3 + 1, 0.0f});
    bench.disc = 0.02f;
    tap_check(tones_say(tones_run_to(&bench, 8u), PROPENSITY_QUIET, CLASS_FORCED, 1u),
              "a tone at the level of rounding does not make another period");
    tones_start(&bench, 0.01f, (struct tone){0.0004f, TONES_TURN, 0.0f},
                (struct tone){4e-5f, TONES_TURN / 3 + 1, 0.0f});
    bench.disc = 0.02f;
    tap_check(tones_run_to(&bench, 8u)->period == 3u, "forty times as large it does");
}

/* A beat of 200 periods: near its turning points neighbours agree, but never for 56 periods. */
static void check_beat(void)
{
    bool is_named = false;

    tones_start(&bench, 0.25f, tones_forced, (struct tone){0.04f, TONES_TURN + TONES_TURN / 200, 0.0f});
    for (uint32_t frame = 7u; frame < 40u; frame++) {
        is_named = is_named || tones_run_to(&bench, frame)->motion == CLASS_FORCED;
        if (frame == 13u) {
            tap_check(tones_say(&bench.detector.verdict, PROPENSITY_QUIET, CLASS_APERIODIC, 0u) &&
                          bench.detector.verdict.growth_q16 > bench.detector.verdict.growth_error_q16 / 2,
                      "a slope within twice its scatter is no growth");
        }
    }
    tap_check(!is_named, "a slow beat is never taken for a period");
}

/* Passages are counted across a band of a tenth of the range: a wiggle does not leave it, every swing does. */
static void check_passages(void)
{
    const struct detector_verdict *verdict = &bench.detector.verdict;

    tones_start(&bench, 0.0f, (struct tone){0.05f, TONES_TURN / 4, 0.0f},
                (struct tone){0.12f, TONES_TURN / 100 * 432, 0.0f}); /* x: 0.2 and 0.028 */
    (void)tones_run_to(&bench, 8u);
    tap_check_close((float)verdict->cycles * 32768.0f * TONES_SPP / (float)verdict->cycle_steps_q15, 0.25f, 5e-3f,
                    "a wiggle that crosses the level again adds nothing to the frequency");
    tones_start(&bench, 0.0f, (struct tone){0.2f, TONES_TURN, 0.0f}, (struct tone){0.035f, TONES_TURN / 2, 0.0f});
    (void)tones_run_to(&bench, 8u);
    tap_check_close((float)verdict->cycles * 32768.0f * TONES_SPP / (float)verdict->cycle_steps_q15, 1.0f, 5e-3f,
                    "nor is the shallower of two swings missed");
}

static void check_autonomous(void)
{
    const struct detector_verdict *verdict = &bench.detector.verdict;
    const struct tone own = {0.15f, 46305082u, 0.0f}; /* 0.69 of the normal frequency, as the brake's */

    tones_start(&bench, 0.0f, own, tones_none);
    tones_set_spring(&bench, 0.4761f);
    tap_check(tones_run_to(&bench, 4u)->propensity == PROPENSITY_WATCH, "motion that nothing explains is watched");
    tap_check(tones_say(tones_run_to(&bench, 6u), PROPENSITY_SQUEAL, CLASS_LIMITCYCLE_SLIP, 1u),
              "it is a limit cycle, squeal without sticking");
    tap_check_close((float)verdict->cycles * 32768.0f * TONES_SPP / (float)verdict->cycle_steps_q15, 0.69f, 1e-4f,
                    "with a frequency of its own");
    bench.stick_steps = 3u;
    tap_check(tones_say(tones_run_to(&bench, 12u), PROPENSITY_SQUEAL, CLASS_LIMITCYCLE_STICKSLIP, 1u),
              "with sticking a stick-slip one");
    tones_start(&bench, 0.0f, (struct tone){0.002f, TONES_TURN, 0.0f}, tones_none);
    tap_check(tones_say(tones_run_to(&bench, 8u), PROPENSITY_QUIET, CLASS_REST, 0u),
              "below 1/64 of the disc's speed it is rest");
    bench.disc = 0.0f;
    tap_check(tones_run_to(&bench, 16u)->motion != CLASS_REST, "beside a disc that stands still it is not");
    tones_start(&bench, 0.48f, (struct tone){0.48f, TONES_TURN, 0.0f}, tones_none);
    tap_check(tones_run_to(&bench, 8u)->propensity == PROPENSITY_WATCH,
              "forced motion at 0.96 of the disc's speed is watched");
    tones_start(&bench, 0.0f, own, tones_none);
    bench.config.load_speed = tones_q27(0.2f);
    bench.config.load_response = tones_q27(0.15f);
    tones_set_spring(&bench, 0.4761f);
    tap_check(tones_run_to(&bench, 8u)->propensity == PROPENSITY_QUIET, "what a sine of the load explains is quiet");
}

static void check_explained(void)
{
    const struct tone own = {0.15f, 46305082u, 0.0f};

    tones_start(&bench, 0.2f, (struct tone){0.30f, TONES_TURN, 0.0f}, tones_none);
    tap_check(tones_run_to(&bench, 6u)->propensity == PROPENSITY_QUIET, "half more than what y explains is quiet");
    tones_start(&bench, 0.2f, (struct tone){0.34f, TONES_TURN, 0.0f}, tones_none);
    tap_check(tones_run_to(&bench, 6u)->propensity == PROPENSITY_SQUEAL, "still more is self-excited");
    tones_start(&bench, 0.2f, own, tones_none);
    bench.config.load_speed = tones_q27(0.2f);
    tones_set_spring(&bench, 0.4761f);
    tap_check(tones_run_to(&bench, 6u)->propensity == PROPENSITY_SQUEAL, "a sine of the load explains its share of y");
    tones_start(&bench, 0.03f, own, tones_none);
    tones_set_spring(&bench, 0.4761f);
    tap_check(tones_say(tones_run_to(&bench, 8u), PROPENSITY_SQUEAL, CLASS_APERIODIC, 0u),
              "y explains a fifth: two clocks");
    tones_start(&bench, 0.015f, own, tones_none);
    tones_set_spring(&bench, 0.4761f);
    tap_check(tones_say(tones_run_to(&bench, 8u), PROPENSITY_SQUEAL, CLASS_LIMITCYCLE_SLIP, 1u),
              "a tenth: the pad's own");
}

/* Growth of a limit cycle by its rate a period. */
static void check_spiral(void)
{
    tones_start(&bench, 0.0f, (struct tone){0.15f, 46305082u, 2e-5f / TONES_SPP}, tones_none);
    tones_set_spring(&bench, 0.4761f);
    tap_check(tones_say(tones_run_to(&bench, 8u), PROPENSITY_SQUEAL, CLASS_LIMITCYCLE_SLIP, 1u),
              "2e-5 is a limit cycle");
    tones_start(&bench, 0.0f, (struct tone){0.15f, 46305082u, 1e-3f / TONES_SPP}, tones_none);
    tones_set_spring(&bench, 0.4761f);
    tap_check(tones_say(tones_run_to(&bench, 8u), PROPENSITY_SQUEAL, CLASS_GROWING, 0u), "1e-3 still grows");
    tones_start(&bench, 0.0f, (struct tone){0.15f, 20132659u, 0.0f}, tones_none); /* 0.3 of the normal frequency */
    tones_set_spring(&bench, 0.09f);
    tap_check(tones_say(tones_run_to(&bench, 6u), PROPENSITY_SQUEAL, CLASS_APERIODIC, 0u) &&
                  tones_say(tones_run_to(&bench, 9u), PROPENSITY_SQUEAL, CLASS_LIMITCYCLE_SLIP, 1u),
              "a slow one needs twenty of its own maxima");
    detector_restart(&bench.detector, &bench.config);
    tap_check(tones_run_to(&bench, 16u)->motion == CLASS_APERIODIC, "after a change twenty new ones");
}

/* Wiggles of x around its middle, 1/11 of its range, are no passages. */
static void check_wiggles(void)
{
    const struct detector_verdict *verdict = &bench.detector.verdict;

    tones_start(&bench, 0.3f, tones_forced, (struct tone){0.28f, 557010944u, 0.0f}); /* 8.3 times */
    (void)tones_run_to(&bench, 8u);
    tap_check_close((float)verdict->cycles * 32768.0f * TONES_SPP / (float)verdict->cycle_steps_q15, 1.0f, 5e-3f,
                    "wiggles around the middle are not counted");
}

static void check_diverged(void)
{
    const struct detector_verdict *verdict = &bench.detector.verdict;
    struct plant_output output;

    tones_start(&bench, 0.2f, tones_forced, tones_none);
    (void)tones_run_to(&bench, 4u);
    detector_set_diverged(&bench.detector);
    tap_check(tones_say(tones_run_to(&bench, 8u), PROPENSITY_SQUEAL, CLASS_DIVERGING, 0u),
              "a plant that left its domain squeals");
    detector_restart(&bench.detector, &bench.config);
    tap_check(tones_say(verdict, PROPENSITY_SQUEAL, CLASS_DIVERGING, 0u), "after a change too");
    output = tones_output(&bench);
    detector_reset(&bench.detector, &bench.config, &output);
    tap_check(tones_say(verdict, PROPENSITY_UNKNOWN, CLASS_UNSETTLED, 0u) && verdict->frame == 0u, "until a reset");
}

void test_motion(void)
{
    check_periods();
    check_rounding();
    check_beat();
    check_passages();
    check_autonomous();
    check_explained();
    check_spiral();
    check_wiggles();
    check_diverged();
}
