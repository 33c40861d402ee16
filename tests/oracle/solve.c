/* The orbit is walked once; three windows look at it: the first 20 periods, 80 to 100, and the attractor. */
#include "solve.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "floquet.h"
#include "orbit.h"
#include "spectrum.h"
#include "window.h"

enum { SAMPLES_PER_PERIOD = 32, TRANSIENT_MAX = 24000 };

static const double window_default = 400.0;

struct run {
    const struct plant *plant;
    struct result *result;
    struct orbit orbit;
    struct window early, middle, late;
    long transient, window; /* periods */
    struct classify_strobe *strobe;
    size_t strobes;
    double *sample; /* of x, over the attractor's window */
    size_t samples;
    double stretch_start;
};

void result_clear(struct result *result)
{
#define INPUT(field, column)
#define OUTPUT(column) result->column = (double)NAN;
#include "columns.def"
#undef INPUT
#undef OUTPUT
    strcpy(result->name, "none");
}

/* A disturbance must have died (or the motion grown and settled) at the rate of permanent slip, which is the slowest
 * there is as long as the pad does not stick; counted from the end of the load's changes. */
static double choose_transient(const struct plant *plant, double rate_per_s)
{
    const double period_s = plant_period_s(plant);
    const double rate = rate_per_s * period_s;
    const double wait = rate < 0.0 ? fmax(3000.0, -20.0 / rate) : fmax(6000.0, 80.0 / rate);

    return ceil(fmin(wait, TRANSIENT_MAX) + plant_load_settled_s(plant) / period_s);
}

static void sample_piece(struct run *run, const struct orbit_piece *piece)
{
    const size_t most = (size_t)run->window * SAMPLES_PER_PERIOD;
    const double end_s = piece->start_s + piece->duration_s;

    while (run->samples < most) {
        const double periods = (double)run->transient + (double)run->samples / SAMPLES_PER_PERIOD;
        const double t_s = periods * run->orbit.period_s;

        if (t_s > end_s) {
            return;
        }
        run->sample[run->samples] = polynomial_value(&piece->phase.x, fmax(0.0, t_s - piece->start_s));
        run->samples++;
    }
}

/* The first instant with |v| > 10 |v0|. */
static void watch_speed(struct run *run, const struct orbit_piece *piece)
{
    const double limit = 10.0 * fabs(run->plant->disc_m_per_s);

    if (!isnan(run->result->t_v10) || !(limit > 0.0)) {
        return;
    }
    for (int sign = 1; sign >= -1; sign -= 2) {
        const struct polynomial spare = polynomial_affine(&piece->phase.v, -(double)sign, limit);
        double t;

        if (polynomial_first_negative(&spare, piece->duration_s, &t)) {
            run->result->t_v10 = piece->start_s + t;
            return;
        }
    }
}

/* From one strobe to the next. */
static bool walk_period(struct run *run, long period)
{
    const double until_s = (double)(period + 1) * run->orbit.period_s;
    const bool is_late = period >= run->transient && period < run->transient + run->window;

    while (run->orbit.state.t_s < until_s) {
        struct orbit_piece piece;
        const bool goes_on = orbit_advance(&run->orbit, until_s, &piece);

        watch_speed(run, &piece);
        if (!goes_on) {
            return false;
        }
        if (period < 20) {
            window_add(&run->early, &piece);
        }
        if (period >= 80 && period < 100) {
            window_add(&run->middle, &piece);
        }
        if (is_late) {
            window_add(&run->late, &piece);
            sample_piece(run, &piece);
        }
    }
    orbit_renormalise(&run->orbit);
    return true;
}

static void note_strobe(struct run *run)
{
    run->strobe[run->strobes] = (struct classify_strobe){run->orbit.state.x_m, run->orbit.state.v_m_per_s};
    run->strobes++;
}

static void open_windows(struct run *run, long period)
{
    const struct plant_state *state = &run->orbit.state;

    if (period == 0) {
        window_start(&run->early, run->plant, state);
    }
    if (period == 80) {
        window_start(&run->middle, run->plant, state);
    }
    if (period == run->transient) {
        window_start(&run->late, run->plant, state);
        run->stretch_start = run->orbit.stretch;
        note_strobe(run);
    }
    if (period == run->transient + run->window / 4) {
        window_set_level(&run->late);
    }
}

static void report_early(const struct run *run)
{
    struct result *result = run->result;
    const struct window *window = &run->early;

    result->x_20 = run->orbit.state.x_m;
    result->v_20 = run->orbit.state.v_m_per_s;
    result->y_20 = run->orbit.state.y_m;
    result->xmax_20 = window->x_max;
    result->xmin_20 = window->x_min;
    result->vmax_20 = window->v_max;
    result->vmin_20 = window->v_min;
    result->stick_20 = window_share(window, window->stick_s);
}

static void report_middle(const struct run *run)
{
    struct result *result = run->result;
    const struct window *window = &run->middle;

    result->x_100 = run->orbit.state.x_m;
    result->v_100 = run->orbit.state.v_m_per_s;
    result->xpp_80_100 = window->x_max - window->x_min;
    result->vmin_80_100 = window->v_min;
    result->stick_80_100 = window_share(window, window->stick_s);
}

static void report_late(const struct run *run)
{
    struct result *result = run->result;
    const struct window *window = &run->late;
    const struct spectrum_tone tone = spectrum_strongest(run->sample, run->samples);
    const double stretch = (run->orbit.stretch - run->stretch_start) / (double)run->window;

    result->xmax = window->x_max;
    result->xmin = window->x_min;
    result->xpp = window->x_max - window->x_min;
    result->xmean = window_mean(window);
    result->xrms = window_rms(window);
    result->vmax = window->v_max;
    result->vmin = window->v_min;
    result->stick = window_share(window, window->stick_s);
    result->slipminus = window_share(window, window->slip_minus_s);
    result->nstick_per_T = (double)window->sticks / (double)run->window;
    result->f_up = window_passage_hz(window);
    result->f_dom = tone.cycles_per_sample * SAMPLES_PER_PERIOD / run->orbit.period_s;
    result->a_dom = tone.amplitude;
    result->poincare_mult = classify_multiplicity(run->strobe, run->strobes, window);
    result->lle = stretch / run->orbit.period_s;
    result->ymin = window->y_min;
    result->ymax = window->y_max;
    result->tneg_frac = window_share(window, window->pulling_s);
    result->mu_min_seen = fmin(window->mu_min, run->plant->friction_static_ratio);
    classify_name(window, (int)result->poincare_mult, stretch, result->name);
    if (strcmp(result->name, "rest") == 0) {
        /* What is left are the digits' rounding or the last of a decay: no tone, no repetition. */
        result->f_up = result->f_dom = result->a_dom = result->poincare_mult = 0.0;
    }
}

static void walk(struct run *run, long horizon)
{
    const long end = run->transient + run->window > 100 ? run->transient + run->window : 100;

    for (long period = 0; period < end && period < horizon; period++) {
        open_windows(run, period);
        if (!walk_period(run, period)) {
            strcpy(run->result->name, run->orbit.has_diverged ? "diverging" : "unresolved");
            run->result->t_diverge = run->orbit.state.t_s;
            return;
        }
        if (period + 1 == 20) {
            report_early(run);
        }
        if (period + 1 == 100) {
            report_middle(run);
        }
        if (period >= run->transient && period < run->transient + run->window) {
            note_strobe(run);
        }
        if (period + 1 == run->transient + run->window) {
            report_late(run);
        }
    }
}

bool solve_case(const struct plant *plant, struct solve_span span, long horizon, struct result *result)
{
    struct run *run = calloc(1, sizeof *run);
    bool has_memory = false;

    result_clear(result);
    if (run == NULL) {
        return false;
    }
    result->T_n = plant_period_s(plant);
    result->slip_floquet_rate = floquet_slip_rate_per_s(plant);
    result->ntrans = isnan(span.transient) ? choose_transient(plant, result->slip_floquet_rate) : span.transient;
    result->nwin = isnan(span.window) ? window_default : span.window;
    result->t_diverge = 0.0;
    run->plant = plant;
    run->result = result;
    run->transient = (long)result->ntrans;
    run->window = (long)result->nwin;
    run->strobe = calloc((size_t)run->window + 1u, sizeof *run->strobe);
    run->sample = calloc((size_t)run->window * SAMPLES_PER_PERIOD + 1u, sizeof *run->sample);
    if (run->strobe != NULL && run->sample != NULL) {
        has_memory = true;
        orbit_start(&run->orbit, plant);
        walk(run, horizon);
    }
    free(run->strobe);
    free(run->sample);
    free(run);
    return has_memory;
}
