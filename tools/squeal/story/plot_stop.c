/* The stop: how far the pad swings while the disc slows down, and what the device says of it. */
#include "squeal/story/plot_parts.h"

#include <math.h>

enum { ENVELOPE_BINS = 1200 };

/* One rectangle over the whole height for each stretch of time with the same verdict. */
static void bands_write(FILE *script, const struct act *act)
{
    size_t start = act->start;

    for (size_t i = start + 1; i <= act->count; i++) {
        const enum detector_propensity propensity = act->samples[start].propensity;
        if (i < act->count && act->samples[i].propensity == propensity) {
            continue;
        }
        if (propensity == PROPENSITY_WATCH || propensity == PROPENSITY_SQUEAL) {
            (void)fprintf(script,
                          "set object rectangle from first %.9g, graph 0 to first %.9g, graph 1 behind fc rgb '%s' "
                          "fs solid noborder\n",
                          act->samples[start].t_s, act->samples[i < act->count ? i : i - 1].t_s,
                          propensity == PROPENSITY_WATCH ? FIGURE_COLOUR_WATCH : FIGURE_COLOUR_SQUEAL);
        }
        start = i;
    }
}

/* Smallest and largest displacement, and the disc's speed, over equal stretches of samples. */
static void envelope_data(FILE *script, const struct act *act, struct figure_unit length, struct figure_unit speed)
{
    const size_t count = act->count - act->start;
    const size_t period = 2 * plot_period_of(act);
    const size_t fine = count / ENVELOPE_BINS + 1;
    const size_t width = fine < period && count / period >= ENVELOPE_BINS / 8 ? period : fine;

    (void)fputs("$stop << END\n", script);
    for (size_t from = act->start; from < act->count; from += width) {
        const size_t to = from + width < act->count ? from + width : act->count;
        double low = act->samples[from].x_m, high = low;
        for (size_t i = from; i < to; i++) {
            low = fmin(low, act->samples[i].x_m);
            high = fmax(high, act->samples[i].x_m);
        }
        (void)fprintf(script, "%.9g %.6g %.6g %.6g\n", act->samples[from].t_s, low * length.factor,
                      high * length.factor, act->samples[from].disc_m_per_s * speed.factor);
    }
    (void)fputs("END\n", script);
}

void plot_stop(struct story *story, const struct act *act)
{
    double x_max = 0.0, v_max = 0.0;
    FILE *script = act->count > 0 ? plot_script_open(story) : NULL;

    if (script == NULL) {
        return;
    }
    for (size_t i = act->start; i < act->count; i++) {
        x_max = fmax(x_max, fabs(act->samples[i].x_m));
        v_max = fmax(v_max, fabs(act->samples[i].disc_m_per_s));
    }
    const struct figure_unit length = figure_unit_of_length(x_max);
    const struct figure_unit speed = figure_unit_of_speed(v_max);
    const double start_s = act->samples[act->start].t_s;
    const double end_s = act->samples[act->count - 1].t_s;
    envelope_data(script, act, length, speed);
    for (int i = 0; i < 2; i++) {
        plot_picture_start(script, story, "stop-envelope", i == 0);
        bands_write(script, act);
        (void)fprintf(script, "set xrange [%.9g:%.9g]\nset multiplot\n", start_s < 0.01 * end_s ? 0.0 : start_s, end_s);
        plot_title_write(script, act);
        (void)fprintf(script,
                      "set origin 0,0.32\nset size 1,0.68\nset format x ''\nset ylabel 'displacement x  [%s]'\n"
                      "plot $stop using 1:2:3 with filledcurves fc rgb '" FIGURE_COLOUR_MOTION
                      "' title 'x, least to most', "
                      "$stop using 1:2 with lines lw 1 lc rgb '" FIGURE_COLOUR_MOTION "' notitle, "
                      "$stop using 1:3 with lines lw 1 lc rgb '" FIGURE_COLOUR_MOTION "' notitle, "
                      "NaN with boxes fs solid lc rgb '" FIGURE_COLOUR_WATCH "' title 'watch', "
                      "NaN with boxes fs solid lc rgb '" FIGURE_COLOUR_SQUEAL "' title 'squeal'\n",
                      length.name);
        (void)fprintf(script,
                      "unset title\nset tmargin 1\nset origin 0,0\nset size 1,0.34\nset format x '%%g'\nset key off\n"
                      "set xlabel 'time t  [s]'\nset ylabel 'v0  [%s]'\nset yrange [0:*]\nset ytics %.9g\n"
                      "plot $stop using 1:4 with lines lw 2.5 lc rgb '" FIGURE_COLOUR_DISC "'\nunset multiplot\n",
                      speed.name, figure_tics(v_max * speed.factor));
    }
    plot_script_close(story, script, "stop-envelope", "displacement, disc speed and verdict over the stop");
}
