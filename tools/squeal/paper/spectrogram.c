/* What one would hear: the brake applied, and a stop at falling speed, as spectra over time. */
#include "squeal/paper/lab_live.h"

#include "squeal/plot/figure.h"
#include "squeal/plot/spectrum.h"

#include <math.h>
#include <stdlib.h>

enum { EVERY = 1, TAIL = 16384, WINDOW = 4096, FRAMES = 110, FRAMES_SMALL = 24, BANDS = 58, TEXT_SIZE = 256 };

#define PITCH_HZ 1999.5 /* of the preset's squeal, by the reference solver */
#define HIGHEST_HZ 9000.0
#define FAINTEST_DB 60.0
#define NANOMETRE 1e-9 /* m/s: 0 dB */

struct sound {
    const char *name, *title, *assignments, *caption;
    double length_s;
};

static const struct sound sounds[] = {
    {"spectrogram-applied", "The brake is applied: 0 to 3000 N in 50 ms", "",
     "Velocity of the pad while the brake is applied and "
     "held. The squeal builds up from the roughness of the disc, and brings its harmonics when the pad begins to "
     "stick.",
     0.25},
    {"spectrogram-stop", "A stop at 3000 N: the disc slows down from 1.5 to 0.05 m/s",
     "speed ramp v0 1.5 v1 0.05 tv1 0.06 tv2 0.4",
     "Velocity of the pad during a stop. Above the knee of friction the brake is "
     "quiet; below it squeals, ever less as the disc slows down, at the same pitch.",
     0.5},
};

/* Level of the strongest line of each band, in dB. */
static void window_write(struct lab *lab, FILE *script, const double *samples, double rate_hz, double t_s)
{
    struct spectrum spectrum;
    double band[BANDS] = {0.0};

    if (!spectrum_make(&spectrum, samples, WINDOW, rate_hz)) {
        lab_fail(lab, "no spectrum of %d samples", WINDOW);
    }
    for (size_t i = 1; i < spectrum.lines; i++) {
        const double place = (double)i * spectrum.step_hz / HIGHEST_HZ * BANDS;
        if (place < BANDS) {
            band[(int)place] = fmax(band[(int)place], spectrum.amplitude[i]);
        }
    }
    free(spectrum.amplitude);
    for (int i = 0; i < BANDS; i++) {
        const double level = 20.0 * log10(fmax(band[i], 1e-12) / sqrt(2.0) / NANOMETRE);
        (void)fprintf(script, "%.5g %.5g %.1f\n", 1e3 * t_s, (i + 0.5) * HIGHEST_HZ / BANDS / 1e3,
                      fmax(level, FAINTEST_DB));
    }
    (void)fputc('\n', script);
}

/* The pitch at the end. */
static void tell(struct lab *lab, const struct sound *sound, const struct lab_track *track, double rate_hz)
{
    struct spectrum spectrum;
    const size_t count = track->count < TAIL ? track->count : TAIL;

    if (!spectrum_make(&spectrum, track->value[0] + track->count - count, count, rate_hz)) {
        lab_fail(lab, "no spectrum of %zu samples", count);
    }
    const size_t peak = spectrum_peak(&spectrum);
    lab_compare(lab, sound->title, "pitch at the end", (double)peak * spectrum.step_hz, "Hz", PITCH_HZ,
                spectrum.resolution_hz);
    lab_number(lab, sound->title, "level of that line", 20.0 * log10(spectrum.amplitude[peak] / sqrt(2.0) / NANOMETRE),
               "dB re 1 nm/s");
    free(spectrum.amplitude);
}

static const char commands[] =
    "set title headline offset 0,0.3\nset xlabel 'time  [ms]'\nset ylabel 'frequency  [kHz]'\nset tmargin 3\nset "
    "rmargin 14\n"
    "set xrange [0:length]\nset yrange [0:9]\nset cbrange [60:160]\nset cblabel 'velocity  [dB re 1 nm/s]' offset "
    "1.5,0\n"
    "set palette defined (0 '#f7f9fb', 0.3 '#b9cfe2', 0.6 '#f08c3a', 1 '#6b1d06')\nunset grid\nunset key\n"
    "plot $frames using 1:2:(wide):(high):3 with boxxyerror fs solid noborder fc palette\n";

static void run(struct lab *lab, const struct sound *sound)
{
    const int frames = lab_options(lab)->is_small ? FRAMES_SMALL : FRAMES;
    FILE *script;

    lab_preset(lab, "brake");
    lab_set(lab, sound->assignments);
    const double rate_hz = 1.0 / (EVERY * lab_step_s(lab));
    const struct lab_track track = lab_record(lab, "xd", (unsigned)(sound->length_s / lab_period_s(lab)), EVERY);
    if (track.count <= WINDOW) {
        lab_fail(lab, "the brake left its domain before it could be heard");
    }
    script = lab_figure_open(lab);
    (void)fputs("$frames << END\n", script);
    for (int i = 0; i < frames; i++) {
        const size_t first = (size_t)((double)(track.count - WINDOW) * i / (frames - 1));
        window_write(lab, script, track.value[0] + first, rate_hz, track.t_s[first + WINDOW / 2]);
    }
    (void)fprintf(script, "END\nheadline = '%s'\nlength = %.6g\nwide = %.6g\nhigh = %.6g\n", sound->title,
                  1e3 * sound->length_s, 0.5e3 * sound->length_s / (frames - 1), 0.5 * HIGHEST_HZ / BANDS / 1e3);
    lab_figure_close(lab, script, sound->name, sound->caption, commands);
    lab_csv_tracks(lab, sound->name, &track, 1);
    tell(lab, sound, &track, rate_hz);
}

void experiment_spectrogram(struct lab *lab)
{
    for (size_t i = 0; i < sizeof sounds / sizeof sounds[0]; i++) {
        run(lab, &sounds[i]);
    }
}
