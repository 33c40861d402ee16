/* The strip, the phase portrait and the spectrum. */
#include "squeal/monitor/panels_parts.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum {
    TRAIL_PERIODS = 24,    /* of the portrait */
    CURVE_DOTS = 2,        /* dots between two points of a curve, about */
    CURVE_PARTS_MAX = 24,  /* of the curve from one sample to the next */
    CURVE_SAMPLES_MIN = 6, /* in a normal period; with fewer there are only dots */
    LABEL_SIZE = 48,
    RULE = 0x2500
};

/* "title ------ info" across the area. */
static void draw_title(struct screen *screen, struct area area, const char *title, const char *info)
{
    const int room = area.cols - panels_width(title) - 3;
    const int width = panels_width(info) <= room ? panels_width(info) : 0;
    int col = area.col;

    col += screen_text(screen, area.row, col, area.cols, TINT_STRONG, title) + 1;
    for (; col < area.col + area.cols - (width > 0 ? width + 1 : 0); col++) {
        screen_put(screen, area.row, col, RULE, TINT_DIM);
    }
    (void)screen_text(screen, area.row, area.col + area.cols - width, width, TINT_DIM, info);
}

/* The numbers at the upper and lower end of a plot's left side. */
static void draw_ends(struct screen *screen, const struct canvas *canvas, const struct axis *axis, const char *unit)
{
    char text[LABEL_SIZE];

    picture_round(text, sizeof text, axis->high, unit);
    panels_print_left_of(screen, canvas->row, canvas->col - 1, TINT_DIM, text);
    picture_round(text, sizeof text, axis->low, unit);
    panels_print_left_of(screen, canvas->row + canvas->rows - 1, canvas->col - 1, TINT_DIM, text);
}

/* The same below it, with what they are in between. */
static void draw_ends_below(struct screen *screen, const struct canvas *canvas, const struct axis *axis,
                            const char *unit)
{
    const int row = canvas->row + canvas->rows;
    char text[LABEL_SIZE];

    picture_round(text, sizeof text, axis->low, unit);
    (void)screen_text(screen, row, canvas->col, canvas->cols, TINT_DIM, text);
    picture_round(text, sizeof text, axis->high, unit);
    panels_print_left_of(screen, row, canvas->col + canvas->cols, TINT_DIM, text);
}

void panels_draw_strip(struct screen *screen, const struct picture *picture, struct area area)
{
    const struct trace *trace = &picture->trace;
    const struct trace_point *latest = trace_point(trace, 0u);
    const struct canvas canvas = {screen, area.row + 1, area.col + PANELS_GUTTER, area.rows - 1,
                                  area.cols - PANELS_GUTTER};
    const int columns = canvas.cols * CANVAS_ACROSS;
    const double span_s = (double)columns * picture->merged * trace->steps_per_period * trace->step_s;
    char span[LABEL_SIZE];
    char info[2 * LABEL_SIZE];

    picture_quantity(span, sizeof span, span_s, "s");
    (void)snprintf(info, sizeof info, "%s of the brake's time", span);
    draw_title(screen, area, "displacement x, from least to most", latest != NULL ? info : "");
    if (latest == NULL || !(picture->strip.high > picture->strip.low)) {
        return;
    }
    draw_ends(screen, &canvas, &picture->strip, "m");
    for (int x = 0; x < columns; x++) {
        const uint64_t newest = latest->step / trace->steps_per_period / picture->merged;
        const uint64_t back = (uint64_t)(columns - 1 - x);
        double low = INFINITY;
        double high = -(double)INFINITY;
        uint8_t propensity = 0u;

        for (unsigned i = 0u; back <= newest && i < picture->merged; i++) {
            const struct trace_period *period = trace_period(trace, (newest - back) * picture->merged + i);

            if (period != NULL) {
                low = fmin(low, (double)period->low_m);
                high = fmax(high, (double)period->high_m);
                propensity = period->propensity;
            }
        }
        if (low <= high) {
            canvas_line(&canvas, x, canvas_down(&canvas, &picture->strip, low), x,
                        canvas_down(&canvas, &picture->strip, high), picture_tint(propensity));
        }
    }
}

/* x and its velocity are known at both ends: a cubic, and its slope. */
static void draw_curve(const struct canvas *canvas, const struct picture *picture, const struct trace_point *from,
                       const struct trace_point *to, enum tint tint)
{
    const double span_s = (double)(to->step - from->step) * picture->trace.step_s;
    const double rise_m = to->x_m - from->x_m;
    const double a = from->xd_m_per_s * span_s;
    const double b = to->xd_m_per_s * span_s;
    int last_x = canvas_across(canvas, &picture->x, from->x_m);
    int last_y = canvas_down(canvas, &picture->xd, from->xd_m_per_s);
    const int length = abs(canvas_across(canvas, &picture->x, to->x_m) - last_x) +
                       abs(canvas_down(canvas, &picture->xd, to->xd_m_per_s) - last_y);
    const int parts = length / CURVE_DOTS < CURVE_PARTS_MAX ? length / CURVE_DOTS + 1 : CURVE_PARTS_MAX;

    for (int i = 1; i <= parts; i++) {
        const double s = (double)i / parts;
        const double x_m = from->x_m + s * (a + s * (3.0 * rise_m - 2.0 * a - b + s * (a + b - 2.0 * rise_m)));
        const double xd = (a + s * (2.0 * (3.0 * rise_m - 2.0 * a - b) + 3.0 * s * (a + b - 2.0 * rise_m))) / span_s;
        const int x = canvas_across(canvas, &picture->x, x_m);
        const int y = canvas_down(canvas, &picture->xd, xd);

        canvas_line(canvas, last_x, last_y, x, y, tint);
        last_x = x;
        last_y = y;
    }
}

/* Oldest first, so that the newest are on top. */
static void draw_trail(const struct canvas *canvas, const struct picture *picture)
{
    static const enum tint tints[] = {TINT_FRESH, TINT_FADING, TINT_FADED};
    const struct trace *trace = &picture->trace;
    const struct trace_point *latest = trace_point(trace, 0u);
    const uint64_t span = (uint64_t)TRAIL_PERIODS * trace->steps_per_period;
    const bool is_curve = trace->every * (uint32_t)CURVE_SAMPLES_MIN <= trace->steps_per_period;
    uint64_t age = 0u;

    while (trace_point(trace, age + 1u) != NULL && latest->step - trace_point(trace, age + 1u)->step <= span) {
        age++;
    }
    for (; age > 0u; age--) {
        const struct trace_point *from = trace_point(trace, age);
        const struct trace_point *to = trace_point(trace, age - 1u);
        const enum tint tint = tints[(latest->step - to->step) * 3u / (span + 1u)];

        if (is_curve && to->is_next) {
            draw_curve(canvas, picture, from, to, tint);
        } else {
            canvas_dot(canvas, canvas_across(canvas, &picture->x, to->x_m),
                       canvas_down(canvas, &picture->xd, to->xd_m_per_s), tint);
        }
    }
}

void panels_draw_portrait(struct screen *screen, const struct picture *picture, struct area area)
{
    const struct canvas canvas = {screen, area.row + 1, area.col + PANELS_GUTTER, area.rows - 2,
                                  area.cols - PANELS_GUTTER};
    const double disc_m_per_s = picture->input[1].held;

    draw_title(screen, area, "velocity over displacement", "");
    if (trace_point(&picture->trace, 0u) == NULL || !(picture->x.high > picture->x.low)) {
        return;
    }
    draw_ends(screen, &canvas, &picture->xd, "m/s");
    draw_ends_below(screen, &canvas, &picture->x, "m");
    if (disc_m_per_s >= picture->xd.low && disc_m_per_s <= picture->xd.high) {
        const int y = canvas_down(&canvas, &picture->xd, disc_m_per_s);

        for (int x = 0; x < canvas.cols * CANVAS_ACROSS; x += 3) {
            canvas_dot(&canvas, x, y, TINT_MARK);
        }
        if (y / CANVAS_DOWN > 0 && y / CANVAS_DOWN < canvas.rows - 1) {
            panels_print_left_of(screen, canvas.row + y / CANVAS_DOWN, canvas.col - 1, TINT_MARK, "v0");
        }
    }
    draw_trail(&canvas, picture);
}

void panels_draw_spectrum(struct screen *screen, const struct picture *picture, struct area area)
{
    const struct canvas canvas = {screen, area.row + 1, area.col + PANELS_GUTTER, area.rows - 2,
                                  area.cols - PANELS_GUTTER};
    const struct trace *trace = &picture->trace;
    const double sampling_hz = 1.0 / (trace->every * trace->step_s);
    const double normal_hz = 1.0 / (trace->steps_per_period * trace->step_s);
    const struct axis axis = {0.0, axis_round_down(fmin(0.5 * sampling_hz, 4.0 * normal_hz))};
    const int columns = canvas.cols * CANVAS_ACROSS;
    char info[LABEL_SIZE] = "";

    if (picture->lines > 0u && picture->peak_hz > 0.0) {
        char peak[LABEL_SIZE / 2];

        picture_frequency(peak, sizeof peak, picture->peak_hz);
        (void)snprintf(info, sizeof info, "peak %s", peak);
    }
    draw_title(screen, area, "spectrum of velocity", info);
    if (picture->lines == 0u || !(picture->level_db.high > picture->level_db.low)) {
        return;
    }
    (void)panels_print(screen, canvas.row, area.col, PANELS_GUTTER, TINT_DIM, "%5.0f dB", picture->level_db.high);
    (void)panels_print(screen, canvas.row + canvas.rows - 1, area.col, PANELS_GUTTER, TINT_DIM, "%5.0f dB",
                       picture->level_db.low);
    draw_ends_below(screen, &canvas, &axis, "Hz");
    for (int x = 0; x < columns; x++) {
        const double from = axis.high * x / columns / picture->line_hz;
        const double to = axis.high * (x + 1) / columns / picture->line_hz;
        double power = 0.0;
        int y;

        for (size_t k = (size_t)lround(from); k <= (size_t)lround(to) && k < picture->lines; k++) {
            power = fmax(power, picture->power[k]);
        }
        y = canvas_down(&canvas, &picture->level_db, picture_level_db(sqrt(power)));
        if (y < canvas.rows * CANVAS_DOWN) {
            canvas_line(&canvas, x, canvas.rows * CANVAS_DOWN - 1, x, y < 0 ? 0 : y, TINT_FADING);
        }
    }
}
