/* Dots, lines and scales. */
#include "squeal/monitor/canvas.h"

#include <math.h>
#include <stdlib.h>

enum { BRAILLE = 0x2800, FAR_AWAY = 1 << 20 };

static const double FAIR_SHARE = 0.6; /* of an axis that what is shown must fill */

void canvas_dot(const struct canvas *canvas, int x, int y, enum tint tint)
{
    static const unsigned char bits[CANVAS_DOWN][CANVAS_ACROSS] = {
        {0x01, 0x08}, {0x02, 0x10}, {0x04, 0x20}, {0x40, 0x80}};
    const struct screen *screen = canvas->screen;
    const int row = canvas->row + y / CANVAS_DOWN;
    const int col = canvas->col + x / CANVAS_ACROSS;
    uint32_t code;

    if (x < 0 || y < 0 || x >= canvas->cols * CANVAS_ACROSS || y >= canvas->rows * CANVAS_DOWN || row >= screen->rows ||
        col >= screen->cols) {
        return;
    }
    code = screen->cells[row][col].code;
    code = code >= BRAILLE && code <= BRAILLE + 0xffu ? code : BRAILLE;
    screen_put(canvas->screen, row, col, code | bits[y % CANVAS_DOWN][x % CANVAS_ACROSS], tint);
}

void canvas_line(const struct canvas *canvas, int x0, int y0, int x1, int y1, enum tint tint)
{
    const int across = abs(x1 - x0);
    const int down = abs(y1 - y0);
    const int count = across > down ? across : down;

    if (count > FAR_AWAY / 2) {
        return; /* to somewhere outside */
    }
    canvas_dot(canvas, x0, y0, tint);
    for (int i = 1; i <= count; i++) {
        const double share = (double)i / count;

        canvas_dot(canvas, x0 + (int)lround(share * (x1 - x0)), y0 + (int)lround(share * (y1 - y0)), tint);
    }
}

static int dot_of(const struct axis *axis, double value, int dots)
{
    const double place = (value - axis->low) / (axis->high - axis->low) * (dots - 1);

    return place > -FAR_AWAY && place < FAR_AWAY ? (int)lround(place) : FAR_AWAY;
}

int canvas_across(const struct canvas *canvas, const struct axis *axis, double value)
{
    return dot_of(axis, value, canvas->cols * CANVAS_ACROSS);
}

int canvas_down(const struct canvas *canvas, const struct axis *axis, double value)
{
    const int dots = canvas->rows * CANVAS_DOWN;
    const int up = dot_of(axis, value, dots);

    return up == FAR_AWAY ? FAR_AWAY : dots - 1 - up;
}

double axis_round_down(double value)
{
    double round = pow(10.0, floor(log10(value)));

    if (!(round <= value)) {
        round /= 10.0; /* log10 of a power of ten may come out short */
    }
    return value >= 5.0 * round ? 5.0 * round : value >= 2.0 * round ? 2.0 * round : round;
}

bool axis_follow(struct axis *axis, double low, double high, double least_span)
{
    const double lacking = least_span - (high - low);
    double step;

    if (!(low <= high) || !(high - low < 1e300)) {
        return false;
    }
    if (lacking > 0.0) {
        low -= 0.5 * lacking;
        high += 0.5 * lacking;
    }
    if (low >= axis->low && high <= axis->high && high - low >= FAIR_SHARE * (axis->high - axis->low)) {
        return true;
    }
    step = axis_round_down((high - low) / 4.0);
    axis->low = step * floor(low / step);
    axis->high = step * ceil(high / step);
    return true;
}
