/* Pictures through gnuplot. The data goes into the script, thinned to what 1200 pixels can show. */
#include "plot.h"

#include "fields.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define COLOUR_PATH "#b8c4d0"
#define COLOUR_MOTION "#1f4e79"
#define COLOUR_DISC "#b5651d"
#define COLOUR_WATCH "#fff4d6"
#define COLOUR_SQUEAL "#f9dede"

#define DISC_NEAR 4.0 /* times the fastest motion */

enum {
    PATH_SAMPLES = 20000, /* of the way to the attractor */
    PERIODS_SHOWN = 12,   /* of the attractor */
    ENVELOPE_BINS = 1200
};

/* A unit that makes a quantity of this size readable. */
struct unit {
    double factor;
    const char *name;
};

static struct unit unit_for(double size, const char *names[3])
{
    if (size < 1e-3) {
        return (struct unit){1e6, names[2]};
    }
    return size < 1.0 ? (struct unit){1e3, names[1]} : (struct unit){1.0, names[0]};
}

static struct unit unit_of_length(double size)
{
    const char *names[3] = {"m", "mm", "{/Symbol m}m"};

    return unit_for(size, names);
}

static struct unit unit_of_speed(double size)
{
    const char *names[3] = {"m/s", "mm/s", "{/Symbol m}m/s"};

    return unit_for(size, names);
}

bool plot_is_possible(void) { return system("command -v gnuplot >/dev/null 2>&1") == 0; }

/* The text as gnuplot may print it: quotes and the marks of its enhanced text are replaced. */
static const char *plain(const char *text, char out[SESSION_LINE_MAX])
{
    size_t i = 0;

    for (; text[i] != '\0' && i < SESSION_LINE_MAX - 1; i++) {
        out[i] = strchr("\"'\\`{}^_@&~$%", text[i]) != NULL ? ' ' : text[i];
    }
    out[i] = '\0';
    return out;
}

static void title_write(FILE *script, const struct act *act)
{
    char words[SESSION_LINE_MAX], class[64], frequency[64];

    (void)fields_text(act->verdict, "class", class, sizeof class);
    (void)fields_text(act->verdict, "frequency_hz", frequency, sizeof frequency);
    (void)fprintf(script, "set title offset 0,1.3 \"%s", plain(act->title, words));
    (void)fprintf(script, "\\n{/*0.8 %s", plain(class, words));
    if (frequency[0] != '\0' && strcmp(frequency, "nan") != 0) {
        (void)fprintf(script, ", %.5g Hz", fields_number(act->verdict, "frequency_hz"));
    }
    (void)fputs("}\"\n", script);
}

/* Starts the picture called name in one of its two formats. */
static void picture_start(FILE *script, const struct story *story, const char *name, bool is_svg)
{
    char path[STORY_PATH_SIZE], file[64];

    (void)snprintf(file, sizeof file, "%s.%s", name, is_svg ? "svg" : "png");
    (void)fprintf(script, "reset\nset terminal %s size 1200,900 font 'Helvetica,%d' enhanced background 'white'\n",
                  is_svg ? "svg" : "pngcairo", is_svg ? 20 : 18);
    (void)fprintf(script, "set output '%s'\n", story_path(story, path, file));
    (void)fputs("set border 3 lc rgb '#606060'\nset tics nomirror out\nset grid lc rgb '#ececec' lt 1\n"
                "set key at graph 1,1.005 right bottom horizontal maxrows 1 samplen 2\nset lmargin 12\nset tmargin "
                "5.5\nset rmargin 4\n",
                script);
}

static FILE *script_open(struct story *story)
{
    (void)fflush(NULL);
    FILE *script = popen("gnuplot", "w");

    if (script == NULL) {
        story_fail(story, "gnuplot cannot be started");
    }
    return script;
}

static void script_close(struct story *story, FILE *script, const char *name, const char *what)
{
    char path[STORY_PATH_SIZE], file[64];

    if (pclose(script) != 0) {
        story_fail(story, "gnuplot could not draw %s", name);
        return;
    }
    for (int i = 0; i < 2; i++) {
        (void)snprintf(file, sizeof file, "%s.%s", name, i == 0 ? "svg" : "png");
        story_wrote(story, story_path(story, path, file), what);
    }
}

static void phase_points(FILE *script, const struct act *act, size_t from, size_t to, struct unit length,
                         struct unit speed)
{
    for (size_t i = from; i < to && i < act->count; i++) {
        (void)fprintf(script, "%.6g %.6g\n", act->samples[i].x_m * length.factor,
                      act->samples[i].xd_m_per_s * speed.factor);
    }
}

/* Samples of one normal period. */
static size_t period_of(const struct act *act)
{
    const double spp = fields_number(act->status, "spp");

    return (size_t)fmax(1.0, (spp > 0.0 ? spp : 64.0) / act->every);
}

/* The way to the attractor. A long one is thinned by whole periods, an empty line between two of them lifts the pen. */
static void path_data(FILE *script, const struct act *act, size_t to, struct unit length, struct unit speed)
{
    const size_t period = period_of(act);
    const size_t stride = period * ((to - act->start) / PATH_SAMPLES + 1);

    (void)fputs("$path << END\n", script);
    for (size_t from = act->start; from < to; from += stride) {
        phase_points(script, act, from, from + period + 1, length, speed);
        (void)fputs(stride > period ? "\n" : "", script);
    }
    (void)fputs("END\n", script);
}

/* The disc's speed as a line, or in words where it lies so far off that the motion would shrink to nothing. */
static void disc_write(FILE *script, double disc, double v_low, double v_high, struct unit speed)
{
    const bool is_near = fabs(disc) < DISC_NEAR * fmax(fabs(v_low), fabs(v_high));
    const double low = is_near ? fmin(v_low, disc) : v_low;
    const double high = is_near ? fmax(v_high, disc) : v_high;
    const double margin = 0.06 * (high - low);

    if (high > low) {
        (void)fprintf(script, "set yrange [%.9g:%.9g]\n", (low - margin) * speed.factor,
                      (high + margin) * speed.factor);
    }
    if (is_near) {
        (void)fprintf(script,
                      "set arrow from graph 0, first %.9g to graph 1, first %.9g nohead lw 2 dt 2 lc rgb '" COLOUR_DISC
                      "'\ndisc = 'disc speed v_0'\n",
                      disc * speed.factor, disc * speed.factor);
    } else {
        (void)fprintf(script, "disc = 'disc speed v_0 = %.4g %s, far off'\n", disc * speed.factor, speed.name);
    }
}

void plot_phase(struct story *story, const struct act *act)
{
    const size_t tail = PERIODS_SHOWN * period_of(act);
    const size_t tail_start = act->count > act->start + tail ? act->count - tail : act->start;
    double x_max = 0.0, v_low = 0.0, v_high = 0.0;
    char name[32];
    FILE *script = act->count > 0 ? script_open(story) : NULL;

    if (script == NULL) {
        return;
    }
    for (size_t i = act->start; i < act->count; i++) {
        x_max = fmax(x_max, fabs(act->samples[i].x_m));
        v_low = fmin(v_low, act->samples[i].xd_m_per_s);
        v_high = fmax(v_high, act->samples[i].xd_m_per_s);
    }
    const struct unit length = unit_of_length(x_max);
    const struct unit speed = unit_of_speed(fmax(-v_low, v_high));
    path_data(script, act, tail_start, length, speed);
    (void)fputs("$motion << END\n", script);
    phase_points(script, act, tail_start, act->count, length, speed);
    (void)fputs("END\n", script);
    (void)snprintf(name, sizeof name, "phase-%d", act->number);
    for (int i = 0; i < 2; i++) {
        picture_start(script, story, name, i == 0);
        title_write(script, act);
        disc_write(script, act->samples[act->count - 1].disc_m_per_s, v_low, v_high, speed);
        (void)fprintf(script,
                      "set xlabel 'displacement x  [%s]'\nset ylabel 'velocity dx/dt  [%s]'\n"
                      "set offsets graph 0.05,0.05,0,0\n"
                      "plot $path with lines lw 1 lc rgb '" COLOUR_PATH "' title 'the way there', "
                      "$motion with lines lw 2.5 lc rgb '" COLOUR_MOTION "' title 'at the end', "
                      "NaN with lines lw 2 dt 2 lc rgb '" COLOUR_DISC "' title disc\n",
                      length.name, speed.name);
    }
    script_close(story, script, name, "phase portrait");
}

/* One rectangle over the whole height for each stretch of time with the same verdict. */
static void bands_write(FILE *script, const struct act *act)
{
    size_t start = act->start;

    for (size_t i = start + 1; i <= act->count; i++) {
        const enum propensity propensity = act->samples[start].propensity;
        if (i < act->count && act->samples[i].propensity == propensity) {
            continue;
        }
        if (propensity == PROPENSITY_WATCH || propensity == PROPENSITY_SQUEAL) {
            (void)fprintf(script,
                          "set object rectangle from first %.9g, graph 0 to first %.9g, graph 1 behind fc rgb '%s' "
                          "fs solid noborder\n",
                          act->samples[start].t_s, act->samples[i < act->count ? i : i - 1].t_s,
                          propensity == PROPENSITY_WATCH ? COLOUR_WATCH : COLOUR_SQUEAL);
        }
        start = i;
    }
}

/* Smallest and largest displacement, and the disc's speed, over equal stretches of samples. */
static void envelope_data(FILE *script, const struct act *act, struct unit length, struct unit speed)
{
    const size_t count = act->count - act->start;
    const size_t period = 2 * period_of(act);
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

/* A round distance of tics for a low picture of this height: about four of them. */
static double tics_for(double height)
{
    const double decade = height > 0.0 ? pow(10.0, floor(log10(height / 4.0))) : 1.0;
    const double rough = height / 4.0 / decade;

    return decade * (rough > 5.0 ? 10.0 : (rough > 2.0 ? 5.0 : (rough > 1.0 ? 2.0 : 1.0)));
}

void plot_stop(struct story *story, const struct act *act)
{
    double x_max = 0.0, v_max = 0.0;
    FILE *script = act->count > 0 ? script_open(story) : NULL;

    if (script == NULL) {
        return;
    }
    for (size_t i = act->start; i < act->count; i++) {
        x_max = fmax(x_max, fabs(act->samples[i].x_m));
        v_max = fmax(v_max, fabs(act->samples[i].disc_m_per_s));
    }
    const struct unit length = unit_of_length(x_max);
    const struct unit speed = unit_of_speed(v_max);
    const double start_s = act->samples[act->start].t_s;
    const double end_s = act->samples[act->count - 1].t_s;
    envelope_data(script, act, length, speed);
    for (int i = 0; i < 2; i++) {
        picture_start(script, story, "stop-envelope", i == 0);
        bands_write(script, act);
        (void)fprintf(script, "set xrange [%.9g:%.9g]\nset multiplot\n", start_s < 0.01 * end_s ? 0.0 : start_s, end_s);
        title_write(script, act);
        (void)fprintf(script,
                      "set origin 0,0.32\nset size 1,0.68\nset format x ''\nset ylabel 'displacement x  [%s]'\n"
                      "plot $stop using 1:2:3 with filledcurves fc rgb '" COLOUR_MOTION "' title 'x, least to most', "
                      "$stop using 1:2 with lines lw 1 lc rgb '" COLOUR_MOTION "' notitle, "
                      "$stop using 1:3 with lines lw 1 lc rgb '" COLOUR_MOTION "' notitle, "
                      "NaN with boxes fs solid lc rgb '" COLOUR_WATCH "' title 'watch', "
                      "NaN with boxes fs solid lc rgb '" COLOUR_SQUEAL "' title 'squeal'\n",
                      length.name);
        (void)fprintf(script,
                      "unset title\nset tmargin 1\nset origin 0,0\nset size 1,0.34\nset format x '%%g'\nset key off\n"
                      "set xlabel 'time t  [s]'\nset ylabel 'v0  [%s]'\nset yrange [0:*]\nset ytics %.9g\n"
                      "plot $stop using 1:4 with lines lw 2.5 lc rgb '" COLOUR_DISC "'\nunset multiplot\n",
                      speed.name, tics_for(v_max * speed.factor));
    }
    script_close(story, script, "stop-envelope", "displacement, disc speed and verdict over the stop");
}
