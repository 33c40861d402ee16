/* Synthetic motions. */
#include "tones.h"

#include "base/fmath.h"
#include "tap.h"

enum {
    FRAME = TONES_SPP * DETECTOR_FRAME_PERIODS,
    SEARCH = 200,       /* steps after which a frame's class is settled */
    STEP_Q27 = 13176796 /* 2 pi/64 */
};

const struct tone tones_forced = {0.2f, TONES_TURN, 0.0f};
const struct tone tones_none = {0.0f, 0u, 0.0f};

int32_t tones_q27(float value) { return (int32_t)(value * TONES_ONE); }

struct plant_output tones_output(const struct tones *bench)
{
    const uint32_t in_period = bench->step % TONES_SPP;
    const uint32_t minus_end = bench->stick_steps + bench->minus_steps;
    struct plant_output output = {.mode = PLANT_SLIP_PLUS, .disc = tones_q27(bench->disc)};
    float x = 0.0f;
    float v = 0.0f;

    for (unsigned i = 0u; i < 2u; i++) {
        const struct tone *tone = &bench->tones[i];
        const uint32_t phase = 0x9abcdef0u + tone->turn * bench->step;

        if (tone->turn != 0u) {
            x += tone->size / ((float)tone->turn / (float)TONES_TURN) * fmath_sine_turns(phase);
            v += tone->size * fmath_sine_turns(phase + (1u << 30));
        }
    }
    output.x = tones_q27(x);
    output.v = tones_q27(v + bench->carried);
    output.y = tones_q27(0.25f); /* in contact */
    output.w = tones_q27(bench->normal * fmath_sine_turns(TONES_TURN * bench->step));
    output.mode = in_period < bench->stick_steps ? PLANT_STICK
                  : in_period < minus_end        ? PLANT_SLIP_MINUS
                                                 : PLANT_SLIP_PLUS;
    return output;
}

void tones_start(struct tones *bench, float normal, struct tone first, struct tone second)
{
    struct plant_output output;

    *bench = (struct tones){.tones = {first, second}, .normal = normal, .disc = 0.5f};
    bench->config = (struct detector_config){TONES_SPP, STEP_Q27, 2u << 16, 1u << 16, 0, 0};
    output = tones_output(bench);
    detector_reset(&bench->detector, &bench->config, &output);
}

void tones_set_spring(struct tones *bench, float stiffness)
{
    bench->config.stiffness_q16 = (uint32_t)(stiffness * 65536.0f);
    detector_restart(&bench->detector, &bench->config);
}

const struct detector_verdict *tones_run_to(struct tones *bench, uint32_t frames)
{
    while (bench->step < frames * FRAME + SEARCH) {
        struct plant_output output;

        bench->step++;
        bench->tones[0].size *= 1.0f + bench->tones[0].growth;
        bench->tones[1].size *= 1.0f + bench->tones[1].growth;
        output = tones_output(bench);
        bench->news += detector_push(&bench->detector, &output) ? 1u : 0u;
    }
    return &bench->detector.verdict;
}

bool tones_say(const struct detector_verdict *verdict, uint8_t propensity, uint8_t motion, uint8_t period)
{
    const bool ok = verdict->propensity == propensity && verdict->motion == motion && verdict->period == period;

    if (!ok) {
        tap_note(detector_propensity_name(verdict->propensity));
        tap_note(detector_class_name(verdict->motion));
        tap_note_number("period", (float)verdict->period);
    }
    return ok;
}
