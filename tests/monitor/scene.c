/* The numbers are those of the preset brake, about. */
#include "tests/monitor/scene.h"

#include <math.h>
#include <stdio.h>

enum { EVERY = 4, STEPS_PER_PERIOD = 64, SAMPLES = 16000 };

static const double STEP_S = 5.3772e-6;
static const double ANGULAR_FREQUENCY = 12566.4; /* 2 kHz */

static const struct picture_choice choices[] = {
    {"table1", "the paper's Table 1: quiet"},
    {"brake", "a disc brake with a 2 kHz squeal above 2000 N; engineering choices inside the paper's ranges"},
    {"groan", "creep groan of a caliper at 79 Hz; engineering choices, no published set"},
    {"fig5-n1", "Fig. 5, N = 1 N"},
    {"fig5-n2", "Fig. 5, N = 2 N"},
};

static void put_input(struct picture_input *input, const char *name, const char *symbol, const char *unit, double set,
                      double held)
{
    (void)snprintf(input->name, sizeof input->name, "%s", name);
    (void)snprintf(input->symbol, sizeof input->symbol, "%s", symbol);
    (void)snprintf(input->unit, sizeof input->unit, "%s", unit);
    input->set = set;
    input->held = held;
}

static double amplitude_m(double t_s) { return fmin(2e-9 * exp(30.0 * t_s), 8e-6); }

static uint8_t propensity(double amplitude) { return amplitude < 3e-8 ? 1u : amplitude < 4e-7 ? 2u : 3u; }

/* Samples up to the given one, a run of them missing. */
static void put_samples(struct picture *picture, uint64_t lost_from, uint32_t lost)
{
    uint32_t missing = 0u;

    for (uint64_t i = 1u; i <= SAMPLES; i++) {
        const double t_s = (double)(i * EVERY) * STEP_S;
        const double size_m = amplitude_m(t_s);
        const double phase = ANGULAR_FREQUENCY * t_s;
        const double middle_m = 26.5e-6 * fmin(t_s / 0.05, 1.0);

        if (i >= lost_from && i < lost_from + lost) {
            missing++;
            continue;
        }
        trace_add(&picture->trace, i * EVERY, middle_m + size_m * cos(phase), -size_m * ANGULAR_FREQUENCY * sin(phase),
                  propensity(size_m), missing);
        missing = 0u;
    }
    picture->step = (uint64_t)SAMPLES * EVERY;
    picture->propensity = propensity(amplitude_m((double)picture->step * STEP_S));
}

static void begin(struct picture *picture)
{
    picture_init(picture);
    trace_clear(&picture->trace, STEP_S, STEPS_PER_PERIOD, EVERY);
    (void)snprintf(picture->port, sizeof picture->port, "qemu:mps2-an386");
    (void)snprintf(picture->board, sizeof picture->board, "mps2-an386, Cortex-M4F, emulated");
    (void)snprintf(picture->preset, sizeof picture->preset, "brake");
    put_input(&picture->input[0], "N", "N1", "N", 3000.0, 3000.0);
    put_input(&picture->input[1], "v0", "v0", "m/s", 0.1, 0.1);
    put_input(&picture->input[2], "alpha", "alpha", "s/m", -0.06, (double)NAN);
    picture->choices = choices;
    picture->choice_count = sizeof choices / sizeof choices[0];
    picture->choice = 1u;
    picture->sigma = 0.043018;
    picture->steps_per_s = 8000.0;
}

void scene_squeal(struct picture *picture)
{
    begin(picture);
    picture->state = 1u;
    picture->pace = 1.0 / 11.6;
    put_samples(picture, 0u, 0u);
    picture->counters = (struct picture_counters){.offered = 16002u, .sent = 16000u, .refused = 1234567u};
    picture_motion(picture->motion, sizeof picture->motion, 8u, 2u);
    picture->severity.stick_share = 0.0514;
    picture->severity.loudness_dba = 101.5;
    (void)snprintf(picture->forecast, sizeof picture->forecast, "closed form: squeal, +30 1/s");
}

void scene_fault(struct picture *picture)
{
    begin(picture);
    picture->state = 2u;
    put_samples(picture, 12000u, 900u);
    picture->input[0].held = 1200.0;
    picture->counters = (struct picture_counters){.offered = 16000u,
                                                  .sent = 15100u,
                                                  .dropped = 900u,
                                                  .overruns = 12u,
                                                  .shed = 24u,
                                                  .saturations = 3u,
                                                  .refused = 1u};
    (void)snprintf(picture->message, sizeof picture->message,
                   "N1 = 13000 N is refused: 0 .. 12000 would do (out-of-scale), or this were a message of two rows");
    picture->is_refusal = true;
}
