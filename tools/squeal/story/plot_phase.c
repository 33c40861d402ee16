/* The phase portrait: displacement against velocity, the end of an act over the way there. */
#include "squeal/story/plot_parts.h"

#include <math.h>

#define DISC_NEAR 4.0 /* times the fastest motion */
#define SETTLED 0.01  /* of the motion's size: extremes this close are the same */

enum {
    PATH_SAMPLES = 30000, /* of the way to the attractor */
    PERIODS_SHOWN = 12,   /* of the attractor */
    PERIODS_COMPARED = 4  /* enough for a cycle that is slower than the normal oscillation */
};

/* What a stretch of motion covers. */
struct box {
    double x_low, x_high, v_low, v_high;
};

static struct box box_of(const struct act *act, size_t from, size_t to)
{
    const struct act_sample *first = &act->samples[from];
    struct box box = {first->x_m, first->x_m, first->xd_m_per_s, first->xd_m_per_s};

    for (size_t i = from; i < to; i++) {
        box.x_low = fmin(box.x_low, act->samples[i].x_m);
        box.x_high = fmax(box.x_high, act->samples[i].x_m);
        box.v_low = fmin(box.v_low, act->samples[i].xd_m_per_s);
        box.v_high = fmax(box.v_high, act->samples[i].xd_m_per_s);
    }
    return box;
}

static bool box_is_same(const struct box *a, const struct box *b, const struct box *all)
{
    const double x = SETTLED * (all->x_high - all->x_low);
    const double v = SETTLED * (all->v_high - all->v_low);

    return fabs(a->x_low - b->x_low) <= x && fabs(a->x_high - b->x_high) <= x && fabs(a->v_low - b->v_low) <= v &&
           fabs(a->v_high - b->v_high) <= v;
}

/* Where the way to the attractor ends: from there on the motion covers what it covers in the tail. */
static size_t path_end(const struct act *act, size_t tail_start, const struct box *all)
{
    const size_t window = PERIODS_COMPARED * plot_period_of(act);
    const struct box tail = box_of(act, tail_start, act->count);
    size_t end = tail_start;

    while (end >= act->start + window) {
        const struct box box = box_of(act, end - window, end);
        if (!box_is_same(&box, &tail, all)) {
            break;
        }
        end -= window;
    }
    return end;
}

/* Points of a line; where samples are missing the pen is lifted, which an empty line does. */
static void points_write(FILE *script, const struct act *act, size_t from, size_t to, struct figure_unit length,
                         struct figure_unit speed)
{
    for (size_t i = from; i < to && i < act->count; i++) {
        const struct act_sample *sample = &act->samples[i];
        if (i > from && sample->step - sample[-1].step > act->every) {
            (void)fputc('\n', script);
        }
        (void)fprintf(script, "%.6g %.6g\n", sample->x_m * length.factor, sample->xd_m_per_s * speed.factor);
    }
}

/* The way to the attractor, a long one thinned by whole periods. */
static void path_write(FILE *script, const struct act *act, size_t to, struct figure_unit length,
                       struct figure_unit speed)
{
    const size_t period = plot_period_of(act);
    const size_t stride = period * ((to - act->start) / PATH_SAMPLES + 1);

    (void)fputs("$path << END\n", script);
    for (size_t from = act->start; from < to; from += stride) {
        points_write(script, act, from, from + period + 1, length, speed);
        (void)fputs(stride > period ? "\n" : "", script);
    }
    (void)fputs("\n", script); /* gnuplot wants one point at least */
    points_write(script, act, act->start, act->start + 1, length, speed);
    (void)fputs("END\n", script);
}

/* The disc's speed as a line, or in words where it lies so far off that the motion would shrink to nothing. */
static void disc_write(FILE *script, double disc, const struct box *all, struct figure_unit speed)
{
    const bool is_near = fabs(disc) < DISC_NEAR * fmax(-all->v_low, all->v_high);
    const double low = is_near ? fmin(all->v_low, disc) : all->v_low;
    const double high = is_near ? fmax(all->v_high, disc) : all->v_high;
    const double margin = 0.06 * (high - low);
    const struct figure_unit unit = figure_unit_of_speed(fabs(disc));

    if (high > low) {
        (void)fprintf(script, "set yrange [%.9g:%.9g]\n", (low - margin) * speed.factor,
                      (high + margin) * speed.factor);
    }
    if (is_near) {
        (void)fprintf(script,
                      "set arrow from graph 0, first %.9g to graph 1, first %.9g nohead lw 2 dt 2 "
                      "lc rgb '" FIGURE_COLOUR_DISC "'\n",
                      disc * speed.factor, disc * speed.factor);
    }
    (void)fprintf(script, "disc = 'v_0 = %.4g %s%s'\n", disc * unit.factor, unit.name, is_near ? "" : ", far off");
}

void plot_phase(struct story *story, const struct act *act)
{
    const size_t tail = PERIODS_SHOWN * plot_period_of(act);
    const size_t tail_start = act->count > act->start + tail ? act->count - tail : act->start;
    char name[32];
    FILE *script = act->count > 0 ? plot_script_open(story) : NULL;

    if (script == NULL) {
        return;
    }
    const struct act_sample *last = &act->samples[act->count - 1];
    const struct box all = box_of(act, act->start, act->count);
    const struct box end = box_of(act, tail_start, act->count);
    const struct box point = {last->x_m, last->x_m, last->xd_m_per_s, last->xd_m_per_s};
    const struct figure_unit length = figure_unit_of_length(fmax(-all.x_low, all.x_high));
    const struct figure_unit speed = figure_unit_of_speed(fmax(-all.v_low, all.v_high));
    path_write(script, act, path_end(act, tail_start, &all), length, speed);
    (void)fputs("$motion << END\n", script);
    points_write(script, act, tail_start, act->count, length, speed);
    (void)fprintf(script, "END\n$end << END\n%.6g %.6g\nEND\n", last->x_m * length.factor,
                  last->xd_m_per_s * speed.factor);
    (void)snprintf(name, sizeof name, "phase-%d", act->number);
    for (int i = 0; i < 2; i++) {
        plot_picture_start(script, story, name, i == 0);
        plot_title_write(script, act);
        disc_write(script, last->disc_m_per_s, &all, speed);
        (void)fprintf(script,
                      "set xlabel 'displacement x  [%s]'\nset ylabel 'velocity dx/dt  [%s]'\n"
                      "set offsets graph 0.05,0.05,0,0\n"
                      "plot $path with lines lw 1 lc rgb '" FIGURE_COLOUR_PATH "' title 'the way there', "
                      "$motion with lines lw 2.5 lc rgb '" FIGURE_COLOUR_MOTION "' title 'at the end', "
                      "$end with points pt 7 ps %d lc rgb '" FIGURE_COLOUR_MOTION "' notitle, "
                      "NaN with lines lw 2 dt 2 lc rgb '" FIGURE_COLOUR_DISC "' title disc\n",
                      length.name, speed.name, box_is_same(&end, &point, &all) ? 1 : 0); /* a motion that died out */
    }
    plot_script_close(story, script, name, "phase portrait");
}
