/* Where everything is, and all that is text. */
#include "squeal/monitor/panels_parts.h"

#include "squeal/monitor/letters.h"

#include <inttypes.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum {
    ITEM_COLS = 24, /* of the list of severity: name and value */
    NAME_COLS = 11,
    TEXT_SIZE = 512,
    ROOMY_ROWS = 24, /* from here on there are empty rows */
    LARGE_ROWS = 48, /* and letters of twice the size */
    LARGE_COLS = 150
};

static const double STILL_SHARE = 5e-4; /* a growth this small a part of the frequency is none */

int panels_width(const char *text)
{
    int width = 0;

    for (; *text != '\0'; text++) {
        width += ((unsigned char)*text & 0xc0u) != 0x80u;
    }
    return width;
}

int panels_print(struct screen *screen, int row, int col, int width, enum tint tint, const char *format, ...)
{
    char text[TEXT_SIZE];
    va_list arguments;

    va_start(arguments, format);
    (void)vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    return screen_text(screen, row, col, width, tint, text);
}

void panels_print_left_of(struct screen *screen, int row, int end, enum tint tint, const char *text)
{
    const int width = panels_width(text);

    (void)screen_text(screen, row, end - width, width, tint, text);
}

static void draw_headline(struct screen *screen, const struct picture *picture, int row, int scale, int room)
{
    const char *word = picture_headline(picture);
    const enum tint tint = picture->state == 2u ? TINT_SQUEAL : picture_tint(picture->propensity);

    if (letters_width(word, scale) <= room) {
        letters_draw(screen, row, PANELS_MARGIN, scale, tint, word);
    } else {
        (void)screen_text(screen, row + LETTERS_ROWS * scale / 2, PANELS_MARGIN, room, tint, word);
    }
}

struct item {
    const char *name;
    char value[64];
    enum tint tint;
};

/* What is known; the first five always. */
static size_t list_severity(const struct picture *picture, struct item *items)
{
    const struct picture_severity *severity = &picture->severity;
    size_t count = 5u;

    items[0] = (struct item){"level", "-", picture_tint(picture->propensity)};
    if (isfinite(severity->level_db)) {
        (void)snprintf(items[0].value, sizeof items[0].value, "%.1f dB", severity->level_db);
    }
    items[1] = (struct item){"velocity", "", TINT_PLAIN};
    picture_quantity(items[1].value, sizeof items[1].value, severity->velocity_m_per_s, "m/s");
    items[2] = (struct item){"amplitude", "", TINT_PLAIN};
    picture_quantity(items[2].value, sizeof items[2].value, severity->amplitude_m, "m");
    items[3] = (struct item){"frequency", "", TINT_PLAIN};
    picture_frequency(items[3].value, sizeof items[3].value, severity->frequency_hz);
    items[4] = (struct item){"growth", "-", TINT_PLAIN};
    if (isfinite(severity->growth_per_s)) {
        const bool is_still = fabs(severity->growth_per_s) < STILL_SHARE * severity->frequency_hz;

        (void)snprintf(items[4].value, sizeof items[4].value, is_still ? "0 1/s" : "%+.2g 1/s", severity->growth_per_s);
    }
    if (isfinite(severity->stick_share)) {
        items[count] = (struct item){"sticking", "", TINT_PLAIN};
        (void)snprintf(items[count++].value, sizeof items[0].value, "%.1f %%", 100.0 * severity->stick_share);
    }
    if (isfinite(severity->loudness_dba)) {
        items[count] = (struct item){"loudness", "", TINT_PLAIN};
        (void)snprintf(items[count++].value, sizeof items[0].value, "%.0f dB(A)", severity->loudness_dba);
    }
    return count;
}

static void draw_severity(struct screen *screen, const struct picture *picture, int row, int room)
{
    struct item items[8];
    const size_t count = list_severity(picture, items);
    const int lists = room >= 2 * ITEM_COLS && count > LETTERS_ROWS ? 2 : 1;

    for (size_t i = 0u; i < count && i < (size_t)(lists * LETTERS_ROWS); i++) {
        const int col = screen->cols - PANELS_MARGIN - (lists - (int)i / LETTERS_ROWS) * ITEM_COLS + 2;
        const int at_row = row + (int)i % LETTERS_ROWS;

        (void)screen_text(screen, at_row, col, NAME_COLS, TINT_DIM, items[i].name);
        panels_print_left_of(screen, at_row, col + ITEM_COLS - 2, items[i].tint, items[i].value);
    }
}

static void draw_plots(struct screen *screen, const struct picture *picture, int row, int rows)
{
    const int cols = screen->cols - 2 * PANELS_MARGIN;
    const int strip_rows = rows / 3 > 3 ? rows / 3 : 3;
    const int lower_rows = rows - strip_rows;
    /* A dot is about as high as wide, and the portrait about as wide as high. */
    const int wanted = 2 * lower_rows + lower_rows / 2 + PANELS_GUTTER;
    const int portrait_cols = screen->cols < 100 || wanted > cols / 2 ? cols / 2 : wanted > 45 ? wanted : 45;
    const int gap = 2;

    panels_draw_strip(screen, picture, (struct area){row, PANELS_MARGIN, strip_rows, cols});
    panels_draw_portrait(screen, picture, (struct area){row + strip_rows, PANELS_MARGIN, lower_rows, portrait_cols});
    panels_draw_spectrum(
        screen, picture,
        (struct area){row + strip_rows, PANELS_MARGIN + portrait_cols + gap, lower_rows, cols - portrait_cols - gap});
}

int panels_strip_cols(int cols) { return cols - 2 * PANELS_MARGIN - PANELS_GUTTER; }

void panels_draw(struct screen *screen, const struct picture *picture)
{
    const int gap = screen->rows >= ROOMY_ROWS ? 1 : 0;
    const int scale = screen->rows >= LARGE_ROWS && screen->cols >= LARGE_COLS ? 2 : 1;
    const char *word = picture_headline(picture);
    const int room = screen->cols - 2 * PANELS_MARGIN - ITEM_COLS;
    int row = 1 + gap;

    screen_clear(screen);
    if (screen->rows < PANELS_ROWS_MIN || screen->cols < PANELS_COLS_MIN) {
        (void)panels_print(screen, screen->rows / 2, 0, screen->cols, TINT_PLAIN, "%s  %d x %d, I need %d x %d", word,
                           screen->cols, screen->rows, PANELS_COLS_MIN, PANELS_ROWS_MIN);
        return;
    }
    panels_draw_header(screen, picture);
    draw_headline(screen, picture, row, scale, room);
    draw_severity(screen, picture, row, screen->cols - 2 * PANELS_MARGIN - letters_width("UNKNOWN", scale));
    row += LETTERS_ROWS * scale;
    panels_draw_motion(screen, picture, row++);
    panels_draw_inputs(screen, picture, row++);
    row += screen->rows >= ROOMY_ROWS + 8 ? 1 : 0;
    draw_plots(screen, picture, row, screen->rows - row - PANELS_COUNTER_ROWS - 1);
    panels_draw_counters(screen, picture, screen->rows - PANELS_COUNTER_ROWS - 1);
    panels_draw_bottom(screen, picture);
    if (picture->overlay == PICTURE_HELP) {
        panels_draw_help(screen);
    } else if (picture->overlay == PICTURE_CHOOSER) {
        panels_draw_chooser(screen, picture);
    }
}
