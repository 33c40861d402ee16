/* What the detector's bands leave out is nothing: beside a twin whose bands are always empty, so that it looks at every
 * value, all else stays the same, whatever comes. */
#include "base/fixed.h"
#include "base/mem.h"
#include "base/random.h"
#include "sim/detector.h"
#include "tap.h"
#include "tests.h"
#include "tones.h"

enum { STEPS = 39999, SPP = 64, RESTARTS = 4000, SILENCES = 500, SILENCE = 37, KINDS = 8 };

static struct detector quick, careful;

/* Q4.27 in +-range, often one of few values, so that extremes and zeros come again. */
static int32_t any(uint32_t stream, uint32_t step, float range)
{
    const int32_t raw = random_uniform_q31(1u, stream, step);
    const float value = range * (float)raw / 2147483648.0f;

    return random_uniform_q31(2u, stream, step) < 0 ? tones_q27(value)
                                                    : tones_q27(range / 4.0f) * fixed_floor_word(raw, 29u);
}

/* Tones most of the time, then noise; now and then x beyond what fits. */
static struct plant_output output_at(const struct tones *bench, uint32_t step)
{
    struct plant_output output = tones_output(bench);

    if (step / 512u % KINDS == 0u) {
        output.x = any(3u, step, 15.0f);
        output.v = any(4u, step, 10.0f);
        output.w = any(5u, step, 15.0f);
    } else if (step / 512u % KINDS == 1u) {
        output.x = step % 3u == 0u ? INT32_MAX : -INT32_MAX;
        output.w = output.x;
    }
    return output;
}

static bool are_same(void)
{
    struct detector a, b;

    memcpy(&a, &quick, sizeof a);
    memcpy(&b, &careful, sizeof b);
    detector_empty_bands(&a);
    detector_empty_bands(&b);
    return memcmp(&a, &b, sizeof a) == 0;
}

void test_bands(void)
{
    static struct tones bench;
    struct plant_output output;
    bool same = true;

    tones_start(&bench, 0.2f, tones_forced, (struct tone){0.01f, TONES_TURN_OWN, 1e-5f});
    output = tones_output(&bench);
    detector_reset(&quick, &bench.config, &output);
    detector_reset(&careful, &bench.config, &output);
    for (uint32_t step = 1u; step <= STEPS && same; step++) {
        bench.step = step;
        output = output_at(&bench, step);
        if (step % RESTARTS == 0u) {
            detector_restart(&quick, &bench.config);
            detector_restart(&careful, &bench.config);
        }
        detector_empty_bands(&careful);
        if (step % SILENCES < SILENCE) {
            same = detector_skip(&quick, &output) == detector_skip(&careful, &output);
        } else {
            same = detector_push(&quick, &output) == detector_push(&careful, &output);
        }
        same = same && are_same();
    }
    tap_check(same, "what is no news to the bands changes nothing");
    tap_check(detector_step(&quick) == STEPS && quick.peaks > DETECTOR_PEAKS, "in many steps");
}
