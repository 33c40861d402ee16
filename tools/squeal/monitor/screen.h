/* A screen of cells: what is drawn is compared with what the terminal shows, and only the differences are sent. A frame
 * is cleared, drawn and shown; a frame that is like the one before costs no byte. */
#ifndef SQUEAL_SCREEN_H
#define SQUEAL_SCREEN_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

/* What a colour means; what it looks like is decided when it is sent. */
enum tint {
    TINT_PLAIN,
    TINT_DIM,
    TINT_STRONG,
    TINT_KEY,
    TINT_QUIET,
    TINT_WATCH,
    TINT_SQUEAL,
    TINT_UNKNOWN,
    TINT_FRESH, /* the newest part of a trail */
    TINT_FADING,
    TINT_FADED,
    TINT_MARK,
    TINT_COUNT
};

enum { SCREEN_COLS_MAX = 320, SCREEN_ROWS_MAX = 100 };

struct screen_cell {
    uint32_t code; /* Unicode; takes one column */
    uint8_t tint;
};

/* How it is sent. */
struct screen_style {
    unsigned colours; /* 0, 16 or 256 */
    bool is_ascii;    /* no character beyond ASCII: what is drawn in others is drawn roughly */
};

struct screen {
    int rows, cols;
    struct screen_style style;
    bool is_known; /* shown is what the terminal shows */
    struct screen_cell cells[SCREEN_ROWS_MAX][SCREEN_COLS_MAX];
    struct screen_cell shown[SCREEN_ROWS_MAX][SCREEN_COLS_MAX];
};

/* Blank, of this size (larger ones are cut to the largest), and unknown what the terminal shows: the next frame is sent
 * whole. */
void screen_open(struct screen *screen, int rows, int cols, struct screen_style style);

/* Would screen_open() make it of this size? */
bool screen_has_size(const struct screen *screen, int rows, int cols);

/* All cells blank. */
void screen_clear(struct screen *screen);

/* One character; nothing outside the screen. */
void screen_put(struct screen *screen, int row, int col, uint32_t code, enum tint tint);

/* UTF-8 text within width columns from there; returns the columns taken. Control characters become '?'. */
int screen_text(struct screen *screen, int row, int col, int width, enum tint tint, const char *text);

/* What the terminal must be told to show the cells; returns whether that was anything. The caller flushes. */
bool screen_show(struct screen *screen, FILE *out);

/* The character as it is sent, as UTF-8. */
void screen_encode(struct screen_style style, uint32_t code, char out[5]);

#endif
