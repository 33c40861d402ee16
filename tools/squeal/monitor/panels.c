/* Where everything is, and all that is text. */
#include "squeal/monitor/panels_parts.h"

#include "squeal/monitor/letters.h"

#include <inttypes.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum {
    MARGIN = 1,
    ITEM_COLS = 24, /* of the list of severity: name and value */
    NAME_COLS = 11,
    TEXT_SIZE = 512,
    COUNTER_ROWS = 2,
    ROOMY_ROWS = 24, /* from here on there are empty rows */
    LARGE_ROWS = 48, /* and letters of twice the size */
    LARGE_COLS = 150,
    DOT = 0x25cf
};

static const double STILL_SHARE = 1e-4; /* a growth this small a part of the frequency is none */

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

static void tell_pace(char *out, size_t size, const struct picture *picture)
{
    const double pace = picture->pace;

    if (picture->state != 1u || !(pace > 0.0)) {
        (void)snprintf(out, size, "%s", picture->state == 1u ? "running" : picture->state == 2u ? "fault" : "stopped");
    } else if (pace < 0.95) {
        (void)snprintf(out, size, "running, slow motion 1:%.*f", pace > 0.1 ? 1 : 0, 1.0 / pace);
    } else if (pace > 1.05) {
        (void)snprintf(out, size, "running, %.*f times as fast", pace < 10.0 ? 1 : 0, pace);
    } else {
        (void)snprintf(out, size, "running, real time");
    }
}

static void draw_header(struct screen *screen, const struct picture *picture)
{
    const int end = screen->cols - MARGIN;
    char pace[TEXT_SIZE];
    int state_col, col = MARGIN;

    tell_pace(pace, sizeof pace, picture);
    state_col = end - panels_width(pace) - 2;
    col += screen_text(screen, 0, col, state_col - 2 - col, TINT_STRONG, "squeal") + 2;
    col += screen_text(screen, 0, col, state_col - 2 - col, TINT_PLAIN, picture->preset) + 2;
    col += screen_text(screen, 0, col, state_col - 2 - col, TINT_DIM, picture->board) + 2;
    (void)screen_text(screen, 0, col, state_col - 2 - col, TINT_DIM, picture->port);
    screen_put(screen, 0, state_col, DOT,
               picture->state == 1u   ? TINT_QUIET
               : picture->state == 2u ? TINT_SQUEAL
                                      : TINT_DIM);
    panels_print_left_of(screen, 0, end, TINT_PLAIN, pace);
}

static void draw_headline(struct screen *screen, const struct picture *picture, int row, int scale, int room)
{
    const char *word = picture_headline(picture);
    const enum tint tint = picture->state == 2u ? TINT_SQUEAL : picture_tint(picture->propensity);

    if (letters_width(word, scale) <= room) {
        letters_draw(screen, row, MARGIN, scale, tint, word);
    } else {
        (void)screen_text(screen, row + LETTERS_ROWS * scale / 2, MARGIN, room, tint, word);
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
        const int col = screen->cols - MARGIN - (lists - (int)i / LETTERS_ROWS) * ITEM_COLS + 2;
        const int at_row = row + (int)i % LETTERS_ROWS;

        (void)screen_text(screen, at_row, col, NAME_COLS, TINT_DIM, items[i].name);
        panels_print_left_of(screen, at_row, col + ITEM_COLS - 2, items[i].tint, items[i].value);
    }
}

static void draw_motion(struct screen *screen, const struct picture *picture, int row)
{
    const int end = screen->cols - MARGIN;
    const int taken = screen_text(screen, row, MARGIN, end - MARGIN, TINT_PLAIN, picture->motion);

    if (panels_width(picture->forecast) + taken + 4 < end - MARGIN) {
        panels_print_left_of(screen, row, end, TINT_DIM, picture->forecast);
    }
}

/* A value and the keys that turn it: "n/N  N 3000 N". */
static int draw_input(struct screen *screen, int row, int col, char key, const struct picture_input *input)
{
    const int begin = col;
    const int room = screen->cols - MARGIN - col;
    const bool differs = isfinite(input->held) && fabs(input->held - input->set) > 0.005 * fabs(input->set) + 1e-9;

    col += panels_print(screen, row, col, room, TINT_KEY, "%c/%c", key, key - 'a' + 'A') + 1;
    col += panels_print(screen, row, col, room, TINT_DIM, "%s ", input->name);
    col += isfinite(input->set) ? panels_print(screen, row, col, room, TINT_STRONG, "%.5g %s", input->set, input->unit)
                                : panels_print(screen, row, col, room, TINT_DIM, "-");
    col += differs ? panels_print(screen, row, col, room, TINT_DIM, " now %.4g", input->held) : 0;
    return col - begin;
}

static void draw_inputs(struct screen *screen, const struct picture *picture, int row)
{
    static const char keys[PICTURE_INPUTS] = {'n', 'v', 'a'};
    int col = MARGIN;

    for (size_t i = 0u; i < PICTURE_INPUTS; i++) {
        col += draw_input(screen, row, col, keys[i], &picture->input[i]) + 3;
    }
    if (isfinite(picture->steps_per_s)) {
        col += screen_text(screen, row, col, screen->cols - MARGIN - col, TINT_KEY, "-/+") + 1;
        (void)panels_print(screen, row, col, screen->cols - MARGIN - col, TINT_DIM, "%g steps/s", picture->steps_per_s);
    }
}

/* Text that goes on in the next row when one is full; what has no room in the last one is left out. */
struct flow {
    struct screen *screen;
    int row, col, last_row;
};

static void flow_put(struct flow *flow, const char *name, const char *value, enum tint tint)
{
    const int width = panels_width(name) + 1 + panels_width(value);
    const int end = flow->screen->cols - MARGIN;

    if (flow->col + width > end && flow->row < flow->last_row) {
        flow->row++;
        flow->col = MARGIN;
    }
    if (flow->col + width > end) {
        return;
    }
    flow->col += screen_text(flow->screen, flow->row, flow->col, end - flow->col, TINT_DIM, name) + 1;
    flow->col += screen_text(flow->screen, flow->row, flow->col, end - flow->col, tint, value) + 2;
}

/* What should be 0 stands out where it is not. */
static void flow_count(struct flow *flow, const char *name, uint64_t count, bool is_loss)
{
    char value[32];

    picture_count(value, sizeof value, count);
    flow_put(flow, name, value, is_loss && count > 0u ? TINT_WATCH : TINT_PLAIN);
}

static void draw_counters(struct screen *screen, const struct picture *picture, int row)
{
    const struct picture_counters *counters = &picture->counters;
    struct flow flow = {screen, row, MARGIN, row + COUNTER_ROWS - 1};
    char text[32];
    char offered[32];
    char both[72];

    flow_count(&flow, "step", picture->step, false);
    picture_quantity(text, sizeof text, (double)picture->step * picture->trace.step_s, "s");
    flow_put(&flow, "t", text, TINT_PLAIN);
    (void)snprintf(text, sizeof text, "%.3g", picture->sigma);
    flow_put(&flow, "sigma", text, TINT_PLAIN);
    flow_count(&flow, "every", picture->trace.every, false);
    picture_count(text, sizeof text, counters->sent);
    picture_count(offered, sizeof offered, counters->offered);
    (void)snprintf(both, sizeof both, "%s of %s", text, offered);
    flow_put(&flow, "sent", both, TINT_PLAIN);
    flow_count(&flow, "dropped", counters->dropped, true);
    flow_count(&flow, "lost", picture->trace.lost, true);
    flow_count(&flow, "overruns", counters->overruns, true);
    flow_count(&flow, "shed", counters->shed, true);
    flow_count(&flow, "caps", counters->caps, true);
    flow_count(&flow, "saturated", counters->saturations, true);
    flow_count(&flow, "refused", counters->refused, true);
    flow_count(&flow, "CRC", counters->bad_crc, true);
}

/* A long one takes the row above as well. */
static void draw_message(struct screen *screen, const struct picture *picture, int row)
{
    const enum tint tint = picture->is_refusal ? TINT_WATCH : TINT_PLAIN;
    const int room = screen->cols - 2 * MARGIN;
    const char *text = picture->message;
    size_t length = strlen(text);

    if (panels_width(text) > room) {
        for (length = (size_t)room; length > 0u && text[length] != ' '; length--) {
        }
        length = length > 0u ? length : (size_t)room;
        for (int col = 0; col < screen->cols; col++) {
            screen_put(screen, row - 1, col, ' ', TINT_PLAIN);
        }
        (void)panels_print(screen, row - 1, MARGIN, room, tint, "%.*s", (int)length, text);
        text += length + (text[length] == ' ' ? 1u : 0u);
    }
    (void)screen_text(screen, row, MARGIN, room, tint, text);
}

static void draw_bottom(struct screen *screen, const struct picture *picture)
{
    static const struct {
        const char *key, *name;
    } hints[] = {{"space", "run or stop"}, {"r", "reset"}, {"p", "presets"},
                 {"[ ]", "time shown"},    {"h", "help"},  {"q", "quit"}};
    const int row = screen->rows - 1;
    const int end = screen->cols - MARGIN;
    int col = MARGIN;

    if (picture->message[0] != '\0') {
        draw_message(screen, picture, row);
        return;
    }
    for (size_t i = 0u; i < sizeof hints / sizeof hints[0]; i++) {
        col += screen_text(screen, row, col, end - col, TINT_KEY, hints[i].key) + 1;
        col += screen_text(screen, row, col, end - col, TINT_DIM, hints[i].name) + 3;
    }
}

static void draw_plots(struct screen *screen, const struct picture *picture, int row, int rows)
{
    const int cols = screen->cols - 2 * MARGIN;
    const int strip_rows = rows / 3 > 3 ? rows / 3 : 3;
    const int lower_rows = rows - strip_rows;
    /* A dot is about as high as wide, and the portrait about as wide as high. */
    const int wanted = 2 * lower_rows + lower_rows / 2 + PANELS_GUTTER;
    const int portrait_cols = screen->cols < 100 || wanted > cols / 2 ? cols / 2 : wanted > 45 ? wanted : 45;
    const int gap = 2;

    panels_draw_strip(screen, picture, (struct area){row, MARGIN, strip_rows, cols});
    panels_draw_portrait(screen, picture, (struct area){row + strip_rows, MARGIN, lower_rows, portrait_cols});
    panels_draw_spectrum(
        screen, picture,
        (struct area){row + strip_rows, MARGIN + portrait_cols + gap, lower_rows, cols - portrait_cols - gap});
}

int panels_strip_cols(int cols) { return cols - 2 * MARGIN - PANELS_GUTTER; }

void panels_draw(struct screen *screen, const struct picture *picture)
{
    const int gap = screen->rows >= ROOMY_ROWS ? 1 : 0;
    const int scale = screen->rows >= LARGE_ROWS && screen->cols >= LARGE_COLS ? 2 : 1;
    const char *word = picture_headline(picture);
    const int room = screen->cols - 2 * MARGIN - ITEM_COLS;
    int row = 1 + gap;

    screen_clear(screen);
    if (screen->rows < PANELS_ROWS_MIN || screen->cols < PANELS_COLS_MIN) {
        (void)panels_print(screen, screen->rows / 2, 0, screen->cols, TINT_PLAIN, "%s  %d x %d, I need %d x %d", word,
                           screen->cols, screen->rows, PANELS_COLS_MIN, PANELS_ROWS_MIN);
        return;
    }
    draw_header(screen, picture);
    draw_headline(screen, picture, row, scale, room);
    draw_severity(screen, picture, row, screen->cols - 2 * MARGIN - letters_width("UNKNOWN", scale));
    row += LETTERS_ROWS * scale;
    draw_motion(screen, picture, row++);
    draw_inputs(screen, picture, row++);
    row += screen->rows >= ROOMY_ROWS + 8 ? 1 : 0;
    draw_plots(screen, picture, row, screen->rows - row - COUNTER_ROWS - 1);
    draw_counters(screen, picture, screen->rows - COUNTER_ROWS - 1);
    draw_bottom(screen, picture);
    if (picture->overlay == PICTURE_HELP) {
        panels_draw_help(screen);
    } else if (picture->overlay == PICTURE_CHOOSER) {
        panels_draw_chooser(screen, picture);
    }
}
