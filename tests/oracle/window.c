/* Measurement on the series themselves: extremes are roots of derivatives, so no sampling error enters. */
#include "window.h"

#include <math.h>

enum { PARTS = 4 }; /* of a piece; at most one extreme of x, v or y in each */

static const double pulling_noise = 1e-12; /* P reaches zero once a period: rounding below it is not pulling */

void window_start(struct window *window, const struct plant *plant, const struct plant_state *state)
{
    *window = (struct window){.plant = plant, .mu_min = HUGE_VAL};
    window->x_max = window->x_min = window->x_reference = state->x_m;
    window->v_max = window->v_min = state->v_m_per_s;
    window->y_max = window->y_min = state->y_m;
}

void window_set_level(struct window *window)
{
    window->has_level = true;
    window->level = 0.5 * (window->x_max + window->x_min);
}

static void widen(double *low, double *high, double value)
{
    *low = fmin(*low, value);
    *high = fmax(*high, value);
}

static void note_speed(struct window *window, const struct phase *phase, double v)
{
    widen(&window->v_min, &window->v_max, v);
    if (phase->mode != MODE_STICK) {
        window->mu_min = fmin(window->mu_min, plant_friction_ratio(window->plant, v));
    }
}

static bool changes_sign(double a, double b) { return (a > 0.0 && b <= 0.0) || (a < 0.0 && b >= 0.0); }

static void note_maximum(struct window *window, double t_s, double x_m)
{
    if (window->maxima < WINDOW_MAXIMA) {
        window->maximum_s[window->maxima] = t_s;
        window->maximum_m[window->maxima] = x_m;
        window->maxima++;
    }
}

static void note_passage(struct window *window, const struct orbit_piece *piece, double a, double b)
{
    const struct polynomial above = polynomial_affine(&piece->phase.x, 1.0, -window->level);

    if (!(polynomial_value(&above, a) < 0.0 && polynomial_value(&above, b) >= 0.0)) {
        return;
    }
    window->last_passage_s = piece->start_s + polynomial_root(&above, a, b);
    if (window->passages == 0) {
        window->first_passage_s = window->last_passage_s;
    }
    window->passages++;
}

/* Gauss's rule with three points: exact for the fifth degree. */
static void add_integrals(struct window *window, const struct polynomial *x, double a, double b)
{
    static const double point[3] = {-0.7745966692414834, 0.0, 0.7745966692414834};
    static const double weight[3] = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};

    for (int i = 0; i < 3; i++) {
        const double t = 0.5 * (a + b) + 0.5 * (b - a) * point[i];
        const double distance = polynomial_value(x, t) - window->x_reference;

        window->x_sum += weight[i] * (b - a) * distance;
        window->x_square_sum += weight[i] * (b - a) * distance * distance;
    }
}

/* The part [a, b] of a piece. */
static void add_part(struct window *window, const struct orbit_piece *piece, const struct polynomial *acceleration,
                     double a, double b)
{
    const struct phase *phase = &piece->phase;
    const double v_a = polynomial_value(&phase->v, a);
    const double v_b = polynomial_value(&phase->v, b);

    widen(&window->x_min, &window->x_max, polynomial_value(&phase->x, b));
    widen(&window->y_min, &window->y_max, polynomial_value(&phase->y, b));
    note_speed(window, phase, v_a);
    note_speed(window, phase, v_b);
    if (changes_sign(polynomial_value(&phase->w, a), polynomial_value(&phase->w, b))) {
        widen(&window->y_min, &window->y_max, polynomial_value(&phase->y, polynomial_root(&phase->w, a, b)));
    }
    if (phase->mode != MODE_STICK) {
        if (changes_sign(v_a, v_b)) {
            const double t = polynomial_root(&phase->v, a, b);

            widen(&window->x_min, &window->x_max, polynomial_value(&phase->x, t));
            if (v_a > 0.0) {
                note_maximum(window, piece->start_s + t, polynomial_value(&phase->x, t));
            }
        }
        if (changes_sign(polynomial_value(acceleration, a), polynomial_value(acceleration, b))) {
            note_speed(window, phase, polynomial_value(&phase->v, polynomial_root(acceleration, a, b)));
        }
    }
    if (window->has_level) {
        note_passage(window, piece, a, b);
    }
    add_integrals(window, &phase->x, a, b);
}

/* Time with y < 0; without a passage of y through zero inside the piece both ends tell. */
static double pulling_time(const struct window *window, const struct orbit_piece *piece)
{
    const double noise = pulling_noise * fmax(fabs(window->y_max), fabs(window->y_min));
    const double first = polynomial_value(&piece->phase.y, 0.0) + noise;
    const double last = polynomial_value(&piece->phase.y, piece->duration_s) + noise;
    double passage;

    if ((first < 0.0) == (last < 0.0)) {
        return first < 0.0 ? piece->duration_s : 0.0;
    }
    passage = polynomial_root(&piece->phase.y, 0.0, piece->duration_s);
    return first < 0.0 ? passage : piece->duration_s - passage;
}

void window_add(struct window *window, const struct orbit_piece *piece)
{
    const struct polynomial acceleration = polynomial_slope(&piece->phase.v);

    for (int i = 0; i < PARTS; i++) {
        add_part(window, piece, &acceleration, piece->duration_s * i / PARTS, piece->duration_s * (i + 1) / PARTS);
    }
    window->time_s += piece->duration_s;
    window->stick_s += piece->phase.mode == MODE_STICK ? piece->duration_s : 0.0;
    window->slip_minus_s += piece->phase.mode == MODE_SLIP_MINUS ? piece->duration_s : 0.0;
    window->pulling_s += pulling_time(window, piece);
    window->sticks += piece->enters_stick;
}

double window_share(const struct window *window, double part_s) { return part_s / window->time_s; }

double window_mean(const struct window *window) { return window->x_reference + window->x_sum / window->time_s; }

double window_rms(const struct window *window)
{
    const double mean = window->x_sum / window->time_s;

    return sqrt(fmax(0.0, window->x_square_sum / window->time_s - mean * mean));
}

double window_passage_hz(const struct window *window)
{
    const double time_s = window->last_passage_s - window->first_passage_s;

    return window->passages > 1 ? (double)(window->passages - 1) / time_s : 0.0;
}
