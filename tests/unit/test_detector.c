/* The detector on synthetic motions, whose verdict follows from how they were made. */
#include "sim/detector.h"

#include "base/compiler.h"
#include "base/fmath.h"
#include "tap.h"
#include "tests.h"
#include "tones.h"

BASE_STATIC_ASSERT(sizeof(struct detector) < 1536, detector_fits_its_budget);

static struct tones bench;

static void check_forced(void)
{
    const struct detector_verdict *verdict = &bench.detector.verdict;
    bool is_unknown;

    tones_start(&bench, 0.2f, tones_forced, tones_none);
    is_unknown = tones_say(tones_run_to(&bench, 0u), PROPENSITY_UNKNOWN, CLASS_UNSETTLED, 0u);
    is_unknown = tones_say(tones_run_to(&bench, 3u), PROPENSITY_UNKNOWN, CLASS_UNSETTLED, 0u) && is_unknown;
    tap_check(is_unknown, "until the window is full nothing is known");
    tap_check(tones_say(tones_run_to(&bench, 4u), PROPENSITY_QUIET, CLASS_UNSETTLED, 0u),
              "then what the normal oscillation explains is quiet");
    tap_check(tones_say(tones_run_to(&bench, 6u), PROPENSITY_QUIET, CLASS_UNSETTLED, 0u), "but not yet named");
    tap_check(tones_say(tones_run_to(&bench, 8u), PROPENSITY_QUIET, CLASS_FORCED, 1u),
              "forced, as soon as it has repeated long enough");
    tap_check(verdict->frame == 8u && bench.news >= 8u && bench.news <= 16u,
              "news comes once a frame, twice with a class");
    tap_check_close((float)verdict->x_max / TONES_ONE, 0.2f, 1e-6f, "its amplitude lies between the samples");
    tap_check_close((float)(verdict->v_max - verdict->v_min) / TONES_ONE, 0.4f, 1e-3f, "its speed in them");
    tap_check_close((float)verdict->variance / 4294967296.0f, 0.02f, 1e-5f, "its mean square");
    tap_check_close((float)verdict->acceleration / TONES_ONE, 0.2f * 0.0981353f, 2e-5f, "its largest change in a step");
    tap_check_close((float)verdict->cycles * 32768.0f * TONES_SPP / (float)verdict->cycle_steps_q15, 1.0f, 1e-5f,
                    "its frequency");
    detector_restart(&bench.detector, &bench.config);
    tap_check(tones_say(verdict, PROPENSITY_UNKNOWN, CLASS_UNSETTLED, 0u), "a change makes it unknown again");
    bench.step = 0u;
    tap_check(tones_say(tones_run_to(&bench, 3u), PROPENSITY_UNKNOWN, CLASS_UNSETTLED, 0u) &&
                  tones_say(tones_run_to(&bench, 4u), PROPENSITY_QUIET, CLASS_UNSETTLED, 0u) && verdict->frame == 12u,
              "for a whole window, while frames are counted on");
}

static void check_growth(void)
{
    const struct detector_verdict *verdict = &bench.detector.verdict;
    uint32_t frame = 5u;
    bool is_watched = true;

    tones_start(&bench, 0.2f, tones_forced, (struct tone){0.001f, TONES_TURN_OWN, 0.03f / TONES_SPP});
    tap_check(tones_run_to(&bench, 4u)->propensity == PROPENSITY_WATCH,
              "a tone that grows is watched while it is small");
    tap_check_close((float)verdict->growth_q16 / 65536.0f, 0.3461f, 0.02f, "by its growth, in octaves a frame");
    tap_check(tones_say(tones_run_to(&bench, 8u), PROPENSITY_WATCH, CLASS_GROWING, 0u), "and called growing");
    tap_check_close((float)verdict->growth_q16 / 65536.0f, 0.3461f, 1e-3f, "by its growth, now exact");
    while (frame < 40u && verdict->propensity != PROPENSITY_SQUEAL) {
        is_watched = is_watched && tones_run_to(&bench, frame++)->propensity != PROPENSITY_QUIET;
    }
    tap_check(is_watched && verdict->propensity == PROPENSITY_SQUEAL, "never quiet, it ends as squeal");
    tones_start(&bench, 0.2f, tones_forced, (struct tone){0.001f, TONES_TURN_OWN, 2e-5f / TONES_SPP});
    tap_check(tones_run_to(&bench, 8u)->propensity == PROPENSITY_QUIET, "slower than 5e-5 a period is no growth");
    tones_start(&bench, 0.2f, tones_forced, (struct tone){2e-5f, TONES_TURN_OWN, 0.03f / TONES_SPP});
    tap_check(tones_run_to(&bench, 4u)->propensity == PROPENSITY_WATCH && verdict->has_growth,
              "a tone of 2e-5 is seen");
    tones_start(&bench, 0.2f, tones_forced, (struct tone){2e-7f, TONES_TURN_OWN, 0.03f / TONES_SPP});
    tap_check(tones_run_to(&bench, 4u)->propensity == PROPENSITY_QUIET && !verdict->has_growth, "one of 2e-7 is noise");

    tones_start(&bench, 0.2f, tones_forced, (struct tone){0.15f, TONES_TURN_OWN, -0.03f / TONES_SPP});
    tap_check(tones_run_to(&bench, 4u)->propensity == PROPENSITY_QUIET && verdict->growth_q16 < 0,
              "one that dies out is quiet");
    tap_check(tones_say(tones_run_to(&bench, 8u), PROPENSITY_QUIET, CLASS_DECAYING, 0u), "and called decaying");
    tap_check(tones_say(tones_run_to(&bench, 22u), PROPENSITY_QUIET, CLASS_DECAYING, 0u),
              "also while only the older of 56 periods show it");
    tap_check(tones_say(tones_run_to(&bench, 40u), PROPENSITY_QUIET, CLASS_FORCED, 1u),
              "until the forced motion is left");
}

static void check_stick(void)
{
    const struct detector_verdict *verdict = &bench.detector.verdict;

    tones_start(&bench, 0.2f, tones_forced, tones_none);
    bench.stick_steps = 10u;
    tap_check(tones_run_to(&bench, 4u)->propensity == PROPENSITY_SQUEAL,
              "stick in every period is squeal once the window is full");
    tap_check(tones_say(tones_run_to(&bench, 8u), PROPENSITY_SQUEAL, CLASS_STICKSLIP, 1u), "stick-slip of period 1");
    tap_check_close((float)verdict->stick / (float)PLANT_SHARE_ONE, 10.0f / 64.0f, 1e-6f, "with its share of sticking");
    bench.stick_steps = 0u;
    tap_check(tones_run_to(&bench, 23u)->propensity == PROPENSITY_SQUEAL, "it is remembered for 15 frames");
    tap_check(tones_say(tones_run_to(&bench, 26u), PROPENSITY_QUIET, CLASS_FORCED, 1u), "and then forgotten");
    bench.stick_steps = 10u;
    tap_check(tones_run_to(&bench, 28u)->propensity == PROPENSITY_WATCH, "two frames of it are worth watching");
    tap_check(tones_run_to(&bench, 30u)->propensity == PROPENSITY_SQUEAL, "more are squeal");

    tones_start(&bench, 0.2f, tones_forced, tones_none);
    bench.minus_steps = 5u;
    tap_check(tones_say(tones_run_to(&bench, 8u), PROPENSITY_SQUEAL, CLASS_CROSS, 1u),
              "overtaking the disc without sticking is crossing");
    tap_check_close((float)verdict->slip_minus / (float)PLANT_SHARE_ONE, 5.0f / 64.0f, 1e-6f, "with its share");
    tones_start(&bench, 0.2f, tones_forced, tones_none);
    bench.disc = -0.5f;
    bench.minus_steps = TONES_SPP;
    tap_check(tones_say(tones_run_to(&bench, 8u), PROPENSITY_QUIET, CLASS_FORCED, 1u),
              "against a disc that turns back it is no event");
    bench.minus_steps = TONES_SPP - 5u;
    tap_check(tones_run_to(&bench, 16u)->propensity == PROPENSITY_SQUEAL, "but slip the other way is");
    tones_start(&bench, 0.2f, tones_forced, tones_none);
    bench.disc = -0.5f;
    bench.stick_steps = 10u;
    bench.minus_steps = TONES_SPP - 10u;
    tap_check(tones_run_to(&bench, 4u)->propensity == PROPENSITY_SQUEAL, "so is stick beside the usual slip");
    tones_start(&bench, 0.2f, (struct tone){0.005f, TONES_TURN, 0.0f}, tones_none);
    bench.stick_steps = 10u;
    tap_check(tones_say(tones_run_to(&bench, 8u), PROPENSITY_QUIET, CLASS_REST, 0u), "stick that hardly moves is none");
    tones_start(&bench, 0.0f, tones_none, tones_none);
    bench.stick_steps = TONES_SPP;
    bench.carried = 0.5f;
    tap_check(tones_say(tones_run_to(&bench, 8u), PROPENSITY_QUIET, CLASS_REST, 0u) && verdict->variance == 0u,
              "a pad that sticks for good is at rest, whatever the disc's speed");
    tones_start(&bench, 0.3f, tones_forced, tones_none);
    bench.stick_steps = TONES_SPP;
    tap_check(tones_run_to(&bench, 8u)->propensity == PROPENSITY_QUIET, "also where the disc's speed swings");
}

/* The longest search: every period that is tried repeats up to its last pair of strobes. */
static uint32_t steps_of_search(uint32_t steps_per_period)
{
    const uint32_t frame = steps_per_period * DETECTOR_FRAME_PERIODS;
    const uint32_t turn = UINT32_MAX / steps_per_period + 1u;
    struct detector *detector = &bench.detector;
    struct plant_output output = {.mode = PLANT_SLIP_PLUS, .disc = tones_q27(0.5f), .y = tones_q27(0.25f)};

    bench.config =
        (struct detector_config){steps_per_period, 843314857 / (int32_t)steps_per_period, 2u << 16, 1u << 16, 0, 0};
    detector_reset(detector, &bench.config, &output);
    for (uint32_t step = 1u; step < 9u * frame; step++) {
        const bool is_odd_strobe = step == frame + steps_per_period; /* the first of the second frame */

        output.x = tones_q27(0.2f * fmath_sine_turns(turn * step));
        output.v = tones_q27(0.2f * fmath_sine_turns(turn * step + (1u << 30)) + (is_odd_strobe ? 0.01f : 0.0f));
        output.w = output.v;
        (void)detector_push(detector, &output);
        if (step > 8u * frame && detector->search.stage == STAGE_IDLE) {
            return step - 8u * frame;
        }
    }
    return UINT32_MAX;
}

static void check_search(void)
{
    bool ends = true;

    for (uint32_t steps = 16u; steps <= 1024u; steps *= 2u) {
        ends = ends && steps_of_search(steps) < steps * DETECTOR_FRAME_PERIODS;
        ends = ends && bench.detector.verdict.motion != CLASS_UNSETTLED;
    }
    tap_check(ends, "the longest search for a period ends before the next frame does");
    tap_check(steps_of_search(64u) >= 190u, "in steps that make no more than eight comparisons");
}

void test_detector(void)
{
    check_forced();
    check_growth();
    check_stick();
    check_search();
    tap_check_text(detector_propensity_name(PROPENSITY_SQUEAL), "squeal", "the words of the protocol");
    tap_check_text(detector_class_name(CLASS_DIVERGING), "diverging", "the last of them");
}
