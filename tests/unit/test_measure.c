/* A measurement over a number of steps, fed with tones of known size and frequency. */
#include "sim/measure.h"

#include "base/fmath.h"
#include "tap.h"
#include "tests.h"

enum { STEP_Q27 = 13176796 /* 2 pi/64 */ };

#define ONE 134217728.0f

/* x = mean + size sin(f t), v its derivative, 64 steps in a turn of f = 1; turn is f in 2^-32 turns a step, start the
 * phase at the start. */
static struct plant_output tone(float mean, float size, uint32_t turn, uint32_t start, uint32_t step)
{
    const uint32_t phase = start + turn * step;
    const float ratio = (float)turn / 67108864.0f;
    struct plant_output output = {.mode = PLANT_SLIP_PLUS};

    output.x = (int32_t)((mean + size * fmath_sine_turns(phase)) * ONE);
    output.v = (int32_t)(size * ratio * fmath_sine_turns(phase + (1u << 30)) * ONE);
    return output;
}

static void run(struct measure *measure, float mean, float size, uint32_t turn, uint32_t start, uint32_t steps)
{
    struct plant_output output = tone(mean, size, turn, start, 0u);

    measure_start(measure, &output, steps, STEP_Q27);
    for (uint32_t i = 1u; measure_is_active(measure); i++) {
        output = tone(mean, size, turn, start, i);
        measure_push(measure, &output);
    }
}

static void check_tone(void)
{
    const uint32_t turn = 46305082u; /* 0.69 of a turn in 64 steps */
    struct measure measure;

    run(&measure, -1.3f, 0.8f, turn, 0x40000000u, 6400u); /* starts at its maximum */
    tap_check(measure.done == 6400u && !measure_is_active(&measure), "it ends by itself");
    tap_check_close((float)measure.x_max / ONE, -0.5f, 1e-6f, "largest displacement, between the samples");
    tap_check_close((float)measure.x_min / ONE, -2.1f, 2e-6f, "smallest displacement");
    tap_check_close((float)measure.v_max / ONE, 0.552f, 2e-6f, "largest speed");
    tap_check_close((float)measure.v_min / ONE, -0.552f, 2e-6f, "smallest speed");
    tap_check_close(measure_frequency(&measure) * 64.0f, 0.69f, 2e-6f, "frequency");
    tap_check(measure.crossings == 34u || measure.crossings == 35u, "counted in the second half, around the middle");
    tap_check(measure_share(&measure, measure.stick) == 0.0f && measure_share(&measure, measure.slip_minus) == 0.0f,
              "all of it slip with the disc");
    run(&measure, 0.0f, 0.8f, 1u << 26, 1u << 25, 640u); /* samples half a step beside each extreme */
    tap_check_close((float)measure.x_max / ONE, 0.8f, 1e-6f, "a maximum that every sample misses");
    tap_check_close((float)measure.x_min / ONE, -0.8f, 1e-6f, "a minimum too");
    tap_check_close((float)measure.v_max / ONE, 0.8f, 1e-5f, "and the largest speed");
}

static void check_shares(void)
{
    struct plant_output output = {.has_notes = true,
                                  .noted = {.stick = PLANT_SHARE_ONE / 4, .slip_minus = PLANT_SHARE_ONE / 8}};
    struct measure measure;

    measure_start(&measure, &output, 100u, STEP_Q27);
    tap_check(measure_share(&measure, measure.stick) == 0.0f && measure_frequency(&measure) == 0.0f,
              "before the first step nothing is known");
    for (uint32_t i = 0u; i < 150u; i++) {
        measure_push(&measure, &output);
        output.noted.stick = i >= 99u ? PLANT_SHARE_ONE : output.noted.stick;
        output.x = i >= 99u ? 1000 : 0;
    }
    tap_check(measure.done == 100u && measure.x_max == 0, "what comes after the end does not count");
    tap_check_close(measure_share(&measure, measure.stick), 0.25f, 1e-6f, "share of sticking");
    tap_check_close(measure_share(&measure, measure.slip_minus), 0.125f, 1e-6f, "share of slip against the disc");
    tap_check(measure_frequency(&measure) == 0.0f, "what never crosses its middle has no frequency");
}

/* A speed that is cut off at the disc's has no parabola to be found: the sample is its extreme. */
static void check_kinks(void)
{
    static const int32_t speeds[] = {0, 400, 1000, 900, 0, -300, -1000, -990, 0};
    struct plant_output output = {.mode = PLANT_SLIP_PLUS};
    struct measure measure;

    measure_start(&measure, &output, 9u, STEP_Q27);
    for (uint32_t i = 0u; i < 9u; i++) {
        output.v = speeds[i];
        output.has_notes = i == 3u;
        output.noted.events = i == 3u ? 1u : 0u;
        output.mode = i == 7u ? PLANT_STICK : PLANT_SLIP_PLUS;
        measure_push(&measure, &output);
    }
    tap_check(measure.v_max == 1000 && measure.v_min == -1000, "at an event the sample itself is the extreme");
    measure_start(&measure, &output, 9u, STEP_Q27);
    output.mode = PLANT_SLIP_PLUS;
    for (uint32_t i = 0u; i < 9u; i++) {
        output.v = speeds[i];
        measure_push(&measure, &output);
    }
    tap_check(measure.v_max > 1040 && measure.v_min < -1040, "in smooth slip it lies beyond the sample");
}

void test_measure(void)
{
    check_tone();
    check_shares();
    check_kinks();
}
