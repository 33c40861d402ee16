/* Cells, and the shortest way to tell a terminal about those that changed. Cursor, colours and UTF-8 are all that it
 * must know: ECMA-48 as every terminal of today has it. */
#include "squeal/monitor/screen.h"

#include <string.h>

enum { BRAILLE = 0x2800, BRAILLE_DOTS = 8, LEAST_CODE = 0x20, DELETE_CODE = 0x7f };

/* Without colours weight has to do. */
static const char *const looks[TINT_COUNT][3] = {
    [TINT_PLAIN] = {"", "", ""},
    [TINT_DIM] = {"2", "90", "38;5;244"},
    [TINT_STRONG] = {"1", "1", "1"},
    [TINT_KEY] = {"1", "36", "38;5;37"},
    [TINT_QUIET] = {"1", "32", "38;5;35"},
    [TINT_WATCH] = {"1", "33", "38;5;178"},
    [TINT_SQUEAL] = {"1", "31", "38;5;196"},
    [TINT_UNKNOWN] = {"", "37", "38;5;246"},
    [TINT_FRESH] = {"1", "96", "38;5;81"},
    [TINT_FADING] = {"", "36", "38;5;32"},
    [TINT_FADED] = {"2", "34", "38;5;25"},
    [TINT_MARK] = {"", "33", "38;5;172"},
};

static const struct screen_cell blank = {' ', TINT_PLAIN};

void screen_clear(struct screen *screen)
{
    for (int row = 0; row < screen->rows; row++) {
        for (int col = 0; col < screen->cols; col++) {
            screen->cells[row][col] = blank;
        }
    }
}

void screen_open(struct screen *screen, int rows, int cols, struct screen_style style)
{
    screen->rows = rows < SCREEN_ROWS_MAX ? rows : SCREEN_ROWS_MAX;
    screen->cols = cols < SCREEN_COLS_MAX ? cols : SCREEN_COLS_MAX;
    screen->style = style;
    screen->is_known = false;
    screen_clear(screen);
}

bool screen_has_size(const struct screen *screen, int rows, int cols)
{
    return screen->rows == (rows < SCREEN_ROWS_MAX ? rows : SCREEN_ROWS_MAX) &&
           screen->cols == (cols < SCREEN_COLS_MAX ? cols : SCREEN_COLS_MAX);
}

void screen_put(struct screen *screen, int row, int col, uint32_t code, enum tint tint)
{
    if (row >= 0 && row < screen->rows && col >= 0 && col < screen->cols) {
        screen->cells[row][col] = (struct screen_cell){code, (uint8_t)tint};
    }
}

/* The next character of UTF-8 that we wrote ourselves; what is none counts byte by byte. */
static const char *decode(const char *text, uint32_t *code)
{
    const unsigned char lead = (unsigned char)*text++;
    const int more = lead >= 0xf0u ? 3 : lead >= 0xe0u ? 2 : lead >= 0xc0u ? 1 : 0;

    *code = more == 0 ? lead : lead & (0x3fu >> more);
    for (int i = 0; i < more && ((unsigned char)*text & 0xc0u) == 0x80u; i++) {
        *code = *code << 6 | ((unsigned char)*text++ & 0x3fu);
    }
    if (*code < LEAST_CODE || (*code >= DELETE_CODE && *code < 0xa0u)) {
        *code = '?';
    }
    return text;
}

int screen_text(struct screen *screen, int row, int col, int width, enum tint tint, const char *text)
{
    int taken = 0;

    while (*text != '\0' && taken < width) {
        uint32_t code;

        text = decode(text, &code);
        screen_put(screen, row, col + taken, code, tint);
        taken++;
    }
    return taken;
}

/* Something like it. */
static uint32_t ascii_of(uint32_t code)
{
    static const struct {
        uint32_t code;
        char like;
    } likes[] = {{0x2588u, '#'}, {0x2580u, '"'}, {0x2584u, 'o'}, {0x2500u, '-'}, {0xb5u, 'u'},
                 {0xd7u, 'x'},   {0xb1u, '~'},   {0x2026u, '.'}, {0xb7u, '.'},   {0x25cfu, '*'}};

    if (code >= BRAILLE && code <= BRAILLE + 0xffu) {
        const uint32_t upper = code & 0x1bu;
        const uint32_t lower = code & 0xe4u;

        return (unsigned char)(upper == 0u ? (lower == 0u ? ' ' : '.') : (lower == 0u ? '\'' : ':'));
    }
    for (size_t i = 0; i < sizeof likes / sizeof likes[0]; i++) {
        if (likes[i].code == code) {
            return (unsigned char)likes[i].like;
        }
    }
    return code < DELETE_CODE ? code : '?';
}

void screen_encode(struct screen_style style, uint32_t code, char out[5])
{
    int more;

    if (style.is_ascii) {
        code = ascii_of(code);
    }
    more = code >= 0x10000u ? 3 : code >= 0x800u ? 2 : code >= 0x80u ? 1 : 0;
    out[0] = (char)(more == 0 ? code : ((0xff80u >> more) & 0xffu) | code >> (6 * more));
    for (int i = 1; i <= more; i++) {
        out[i] = (char)(0x80u | (code >> (6 * (more - i)) & 0x3fu));
    }
    out[more + 1] = '\0';
}

static void send_cell(const struct screen *screen, struct screen_cell cell, int *tint, FILE *out)
{
    const struct screen_style style = screen->style;
    char bytes[5];

    if (cell.tint != *tint) {
        const char *look = looks[cell.tint][style.colours >= 256u ? 2 : style.colours > 0u ? 1 : 0];

        fprintf(out, look[0] == '\0' ? "\033[m" : "\033[0;%sm", look);
        *tint = cell.tint;
    }
    screen_encode(style, cell.code, bytes);
    (void)fputs(bytes, out);
}

static bool is_same(struct screen_cell a, struct screen_cell b)
{
    return a.code == b.code && (a.tint == b.tint || a.code == ' ');
}

bool screen_show(struct screen *screen, FILE *out)
{
    int at_row = -1;
    int at_col = -1;
    int tint = -1;

    for (int row = 0; row < screen->rows; row++) {
        for (int col = 0; col < screen->cols; col++) {
            const struct screen_cell cell = screen->cells[row][col];

            if (screen->is_known && is_same(cell, screen->shown[row][col])) {
                continue;
            }
            if (tint < 0) {
                /* One update for the eye, where the terminal knows how: others pass over this. */
                (void)fputs(screen->is_known ? "\033[?2026h" : "\033[?2026h\033[m\033[2J", out);
            }
            if (row != at_row || col != at_col) {
                fprintf(out, "\033[%d;%dH", row + 1, col + 1);
            }
            send_cell(screen, cell, &tint, out);
            at_row = row;
            at_col = col + 1;
            screen->shown[row][col] = cell;
        }
    }
    screen->is_known = true;
    if (tint >= 0) {
        (void)fputs("\033[m\033[?2026l", out);
    }
    return tint >= 0;
}
