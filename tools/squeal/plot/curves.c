/* Pictures of a recorded table. */
#include "squeal/plot/curves.h"

#include "squeal/plot/figure.h"
#include "squeal/plot/spectrum.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define END_SHARE 0.1      /* of the path, drawn over the way there */
#define DEEP 1e-6          /* of the highest line: what lies lower is not shown */
#define HARMONICS_SHOWN 10 /* of the highest line */

enum { BINS = 2000, PATH_POINTS = 40000, TITLE_SIZE = 256 };

static void title_write(FILE *script, const struct curves *curves, const char *second)
{
    char words[TITLE_SIZE];

    (void)fprintf(script, "set title offset 0,1.3 \"%s", figure_plain(curves->title, words, sizeof words));
    (void)fprintf(script, "\\n{/*0.8 %s}\"\n", figure_plain(second, words, sizeof words));
}

static bool finish(FILE *script, const struct curves *curves, char problem[CSV_PROBLEM_MAX])
{
    if (!figure_close(script, curves->path)) {
        (void)snprintf(problem, CSV_PROBLEM_MAX, "gnuplot could not draw %.160s", curves->path);
        return false;
    }
    return true;
}

static FILE *start(char problem[CSV_PROBLEM_MAX])
{
    FILE *script = figure_open();

    if (script == NULL) {
        (void)snprintf(problem, CSV_PROBLEM_MAX, "gnuplot cannot be started");
    }
    return script;
}

struct span {
    double low, high;
};

static struct span span_of(const struct curves *curves, size_t column)
{
    const double *values = curves->values[column];
    struct span span = {values[0], values[0]};

    for (size_t i = 0; i < curves->count; i++) {
        span.low = fmin(span.low, values[i]);
        span.high = fmax(span.high, values[i]);
    }
    return span;
}

void curves_scale(struct curves *curves)
{
    for (size_t column = 0; column < curves->columns; column++) {
        const struct span span = span_of(curves, column);
        const struct figure_unit unit = figure_unit_of(curves->unit[column], fmax(-span.low, span.high));
        for (size_t i = 0; i < curves->count; i++) {
            curves->values[column][i] *= unit.factor;
        }
        if (unit.name != curves->unit[column]) {
            (void)snprintf(curves->unit[column], sizeof curves->unit[column], "%s", unit.name);
        }
    }
}

static void points_write(FILE *script, const char *name, const struct curves *curves, size_t from)
{
    const size_t stride = (curves->count - from) / PATH_POINTS + 1;

    (void)fprintf(script, "$%s << END\n", name);
    for (size_t i = from; i < curves->count; i += stride) {
        (void)fprintf(script, "%.9g %.9g\n", curves->values[0][i], curves->values[1][i]);
    }
    (void)fputs("END\n", script);
}

bool curves_phase(const struct curves *curves, char problem[CSV_PROBLEM_MAX])
{
    FILE *script = start(problem);
    char second[TITLE_SIZE];

    if (script == NULL) {
        return false;
    }
    (void)snprintf(second, sizeof second, "%.9g to %.9g s, the last tenth dark", curves->t_s[0],
                   curves->t_s[curves->count - 1]);
    points_write(script, "path", curves, 0);
    points_write(script, "end", curves, (size_t)((1.0 - END_SHARE) * (double)curves->count));
    for (int i = 0; i < 2; i++) {
        figure_start(script, curves->path, i == 0);
        title_write(script, curves, second);
        (void)fprintf(script,
                      "set xlabel '%s  [%s]'\nset ylabel '%s  [%s]'\nset format '%%.3g'\n"
                      "plot $path with lines lw 1 lc rgb '" FIGURE_COLOUR_PATH
                      "' notitle, $end with lines lw 1.5 lc rgb '" FIGURE_COLOUR_MOTION "' notitle\n",
                      curves->name[0], curves->unit[0], curves->name[1], curves->unit[1]);
    }
    return finish(script, curves, problem);
}

/* Least and most over equal stretches, so that no peak is lost however long the record. */
static void envelope_write(FILE *script, const struct curves *curves)
{
    const size_t width = curves->count / BINS + 1;

    (void)fputs("$time << END\n", script);
    for (size_t from = 0; from < curves->count; from += width) {
        const size_t to = from + width < curves->count ? from + width : curves->count;
        (void)fprintf(script, "%.9g", curves->t_s[from]);
        for (size_t column = 0; column < curves->columns; column++) {
            double low = curves->values[column][from], high = low;
            for (size_t i = from; i < to; i++) {
                low = fmin(low, curves->values[column][i]);
                high = fmax(high, curves->values[column][i]);
            }
            (void)fprintf(script, " %.9g %.9g", low, high);
        }
        (void)fputc('\n', script);
    }
    (void)fputs("END\n", script);
}

static void panel_write(FILE *script, const struct curves *curves, size_t column)
{
    const double height = 0.88 / (double)curves->columns;
    const bool is_last = column + 1 == curves->columns;
    const size_t low = 2 * column + 2; /* of its pair of columns in the data */
    const struct span span = span_of(curves, column);
    const double size = fmax(fabs(span.low), fabs(span.high));
    const double room = span.high > span.low ? 0.06 * (span.high - span.low) : size > 0.0 ? 0.1 * size : 1.0;

    (void)fprintf(script,
                  "set origin 0,%.4f\nset size 1,%.4f\nset tmargin 1\nset format y '%%g'\nset format x '%s'\n"
                  "set xlabel '%s'\nset ylabel '%s  [%s]'\nset yrange [%.9g:%.9g]\nset ytics %.9g\n",
                  (double)(curves->columns - 1 - column) * height, height, is_last ? "%g" : "",
                  is_last ? "time t  [s]" : "", curves->name[column], curves->unit[column], span.low - room,
                  span.high + room, figure_tics(span.high - span.low + 2.0 * room));
    (void)fprintf(script,
                  "plot $time using 1:%zu:%zu with filledcurves fc rgb '" FIGURE_COLOUR_MOTION "' notitle, "
                  "$time using 1:%zu with lines lw 1 lc rgb '" FIGURE_COLOUR_MOTION "' notitle, "
                  "$time using 1:%zu with lines lw 1 lc rgb '" FIGURE_COLOUR_MOTION "' notitle\n",
                  low, low + 1, low, low + 1);
}

bool curves_time(const struct curves *curves, char problem[CSV_PROBLEM_MAX])
{
    FILE *script = start(problem);

    if (script == NULL) {
        return false;
    }
    envelope_write(script, curves);
    for (int i = 0; i < 2; i++) {
        char words[TITLE_SIZE];
        figure_start(script, curves->path, i == 0);
        (void)fprintf(script, "set xrange [%.9g:%.9g]\nset multiplot title \"%s\"\n", curves->t_s[0],
                      curves->t_s[curves->count - 1], figure_plain(curves->title, words, sizeof words));
        for (size_t column = 0; column < curves->columns; column++) {
            panel_write(script, curves, column);
        }
        (void)fputs("unset multiplot\n", script);
    }
    return finish(script, curves, problem);
}

static void lines_write(FILE *script, const struct spectrum *spectrum, double up_to_hz)
{
    (void)fputs("$lines << END\n", script);
    for (size_t i = 1; i < spectrum->lines && (double)i * spectrum->step_hz <= up_to_hz; i++) {
        (void)fprintf(script, "%.9g %.6g\n", (double)i * spectrum->step_hz, spectrum->amplitude[i]);
    }
    (void)fputs("END\n", script);
}

bool curves_spectrum(const struct curves *curves, char problem[CSV_PROBLEM_MAX])
{
    const double length_s = curves->t_s[curves->count - 1] - curves->t_s[0];
    struct spectrum spectrum;
    char second[TITLE_SIZE];

    if (length_s <= 0.0 ||
        !spectrum_make(&spectrum, curves->values[0], curves->count, (double)(curves->count - 1) / length_s)) {
        (void)snprintf(problem, CSV_PROBLEM_MAX, "a spectrum takes %d samples or more", SPECTRUM_SAMPLES_MIN);
        return false;
    }
    const size_t peak = spectrum_peak(&spectrum);
    const double peak_hz = (double)peak * spectrum.step_hz;
    const double half_hz = (double)spectrum.lines * spectrum.step_hz;
    FILE *script = start(problem);
    if (script == NULL) {
        free(spectrum.amplitude);
        return false;
    }
    (void)snprintf(second, sizeof second, "highest line %.6g %s at %.6g Hz, resolution %.3g Hz",
                   spectrum.amplitude[peak], curves->unit[0], peak_hz, spectrum.resolution_hz);
    printf("%s\n", second);
    lines_write(script, &spectrum, fmin(half_hz, HARMONICS_SHOWN * peak_hz));
    for (int i = 0; i < 2; i++) {
        figure_start(script, curves->path, i == 0);
        title_write(script, curves, second);
        (void)fprintf(script,
                      "set logscale y\nset format y '10^{%%L}'\nset yrange [%.6g:*]\nset xlabel 'frequency  [Hz]'\n"
                      "set ylabel 'amplitude of %s  [%s]'\n"
                      "plot $lines with lines lw 1.5 lc rgb '" FIGURE_COLOUR_MOTION "' notitle\n",
                      fmax(DEEP * spectrum.amplitude[peak], 1e-300), curves->name[0], curves->unit[0]);
    }
    free(spectrum.amplitude);
    return finish(script, curves, problem);
}
