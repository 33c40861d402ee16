/* Spectrum, trace, words. */
#include "tests/monitor/parts.h"
#include "tests/monitor/tap.h"

#include "squeal/monitor/letters.h"
#include "squeal/monitor/panels.h"
#include "squeal/monitor/picture.h"
#include "squeal/monitor/trace.h"
#include "squeal/plot/spectrum.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double PI = 3.14159265358979323846;

static bool is_near(double value, double wanted, double share) { return fabs(value - wanted) <= share * fabs(wanted); }

/* The definition, term by term. */
static double slow_amplitude(const double *values, int size, int line)
{
    double re = 0.0;
    double im = 0.0;
    double mean = 0.0;

    for (int i = 0; i < size; i++) {
        mean += values[i] * (1.0 - cos(2.0 * PI * i / size)) / size;
    }
    for (int i = 0; i < size; i++) {
        const double windowed = (values[i] - mean) * (0.5 - 0.5 * cos(2.0 * PI * i / size));

        re += windowed * cos(2.0 * PI * line * i / size);
        im -= windowed * sin(2.0 * PI * line * i / size);
    }
    return 4.0 * hypot(re, im) / size;
}

void parts_check_spectrum(void)
{
    enum { SIZE = 1024, SHORT = 128 };
    static double values[SIZE];
    struct spectrum spectrum;
    bool is_same = true;

    for (int i = 0; i < SIZE; i++) {
        values[i] = 5.0 + 3.0 * cos(2.0 * PI * 100.0 * i / SIZE + 0.7) + 0.03 * sin(2.0 * PI * 300.0 * i / SIZE);
    }
    tap_check(spectrum_make(&spectrum, values, SIZE, 2048.0) && spectrum.lines == SIZE / 2 && spectrum.step_hz == 2.0,
              "a spectrum has lines up to half the sampling rate");
    tap_check(is_near(spectrum.amplitude[100], 3.0, 1e-9) && is_near(spectrum.amplitude[300], 0.03, 1e-6),
              "a sine has its amplitude on its line");
    tap_check(spectrum.amplitude[0] < 1e-12 && spectrum.amplitude[1] < 1e-12 && spectrum.amplitude[200] < 1e-12,
              "and nothing is where there is nothing: what is constant is taken away");
    tap_check(spectrum_peak(&spectrum) == 100u, "the peak");
    free(spectrum.amplitude);

    for (int i = 0; i < SHORT; i++) {
        values[i] = 3.0 + sin(0.3 * i) + 0.2 * cos(1.7 * i * i);
    }
    (void)spectrum_make(&spectrum, values, SHORT, 1.0);
    for (int k = 0; k < SHORT / 2; k++) {
        is_same = is_same && fabs(slow_amplitude(values, SHORT, k) - spectrum.amplitude[k]) < 1e-12;
    }
    free(spectrum.amplitude);
    tap_check(is_same, "the fast transform is the slow one");
    tap_check(!spectrum_make(&spectrum, values, 63u, 1.0), "too few samples have none");
}

static struct trace trace;

void parts_check_trace(void)
{
    struct trace_measure measure;
    double values[300];

    trace_clear(&trace, 1e-5, 64u, 4u);
    tap_check(trace_point(&trace, 0u) == NULL && isnan(trace_measure(&trace, 32u).amplitude_m),
              "nothing seen, nothing measured");
    for (unsigned i = 1u; i <= 20000u; i++) {
        const double t = i * 4e-5;

        trace_add(&trace, 4u * i, 1e-3 + 2e-6 * exp(3.0 * t) * sin(2.0 * PI * 500.0 * t),
                  2e-6 * exp(3.0 * t) * 2.0 * PI * 500.0 * cos(2.0 * PI * 500.0 * t), 3u, i == 19990u ? 1u : 0u);
    }
    measure = trace_measure(&trace, 32u);
    tap_check(is_near(measure.amplitude_m, 2e-6 * exp(2.4), 0.03), "amplitude");
    tap_check(is_near(measure.velocity_m_per_s, 2e-6 * exp(2.4) * 2.0 * PI * 500.0 / sqrt(2.0), 0.04), "rms velocity");
    tap_check(is_near(measure.frequency_hz, 500.0, 2e-3), "frequency");
    tap_check(is_near(measure.growth_per_s, 3.0, 0.25), "growth");
    tap_check(trace.lost == 1u && trace_latest(&trace, 300u, values) == 11u, "a sample lost is counted, and a gap");
    tap_check(values[10] == trace_point(&trace, 0u)->xd_m_per_s && trace_point(&trace, TRACE_POINTS) == NULL,
              "the latest is the last");
    tap_check(trace_period(&trace, 1250u) != NULL && trace_period(&trace, 1249u)->propensity == 3u &&
                  trace_period(&trace, 1249u)->high_m > trace_period(&trace, 1249u)->low_m,
              "each period has its extremes");
    trace_break(&trace, 8u);
    trace_add(&trace, 80008u, 0.0, 0.0, 1u, 0u);
    tap_check(trace_latest(&trace, 300u, NULL) == 1u, "another stream: no neighbours");
    trace_add(&trace, 4u, 0.0, 0.0, 1u, 0u);
    tap_check(trace.points == 1u && trace_period(&trace, 1249u) == NULL, "an earlier step begins anew");
    trace_add(&trace, 8u, (double)NAN, 0.0, 1u, 0u);
    tap_check(trace_period(&trace, 0u)->high_m == 0.0f, "what is no number has no extremes");
}

static bool is_quantity(double value, const char *unit, const char *wanted)
{
    char text[64];

    picture_quantity(text, sizeof text, value, unit);
    return strcmp(text, wanted) == 0;
}

void parts_check_words(void)
{
    static struct picture picture;
    static struct screen screen;
    char text[64];

    tap_check(is_quantity(8.149e-6, "m", "8.15 \xc2\xb5m") && is_quantity(-0.0123, "N", "-12.3 mN") &&
                  is_quantity(0.0, "m", "0 m"),
              "quantities in three digits");
    tap_check(is_quantity(999.9, "Hz", "1.00 kHz") && is_quantity(1e-3, "m", "1.00 mm") &&
                  is_quantity((double)NAN, "m", "-"),
              "at the borders of prefixes");
    picture_count(text, sizeof text, 1234567u);
    tap_check(strcmp(text, "1 234 567") == 0, "counts in groups");
    tap_check(is_near(picture_level_db(72.31e-3), 157.2, 5e-4) && isnan(picture_level_db(0.0)),
              "level of the rms velocity");
    tap_check(letters_width("SQUEAL", 1) == 47 && letters_width("squeal", 1) == 0, "large letters, capitals only");

    /* However small or large the screen is, nothing is drawn outside. */
    picture_init(&picture);
    for (int rows = 1; rows <= SCREEN_ROWS_MAX; rows += 3) {
        for (int cols = 1; cols <= SCREEN_COLS_MAX; cols += 7) {
            screen_open(&screen, rows, cols, (struct screen_style){256u, false});
            picture.overlay = (enum picture_overlay)((rows + cols) % 3);
            panels_draw(&screen, &picture);
        }
    }
    tap_check(true, "screens of all sizes, with nothing to show");

    /* A frequency between two lines of a spectrum. */
    trace_clear(&picture.trace, 1e-5, 64u, 4u);
    for (unsigned i = 1u; i <= 2048u; i++) {
        trace_add(&picture.trace, 4u * i, 0.0, sin(2.0 * PI * 1234.5 * 4e-5 * i), 1u, 0u);
    }
    picture_update(&picture, 80);
    tap_check(is_near(picture.peak_hz, 1234.5, 2e-4), "the peak's frequency lies between two lines");
    tap_check(picture.level_db.high == 180.0 && picture.level_db.low == 80.0, "a level axis that holds 177 dB");
}
