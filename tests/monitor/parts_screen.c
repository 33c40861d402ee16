/* Canvas, screen, keys. */
#include "tests/monitor/emulator.h"
#include "tests/monitor/parts.h"
#include "tests/monitor/tap.h"

#include "squeal/monitor/canvas.h"
#include "squeal/monitor/keys.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { ROWS = 24, COLS = 80, FRAMES = 60, CHANGES = 200 };

static struct screen screen;
static struct emulator emulator;
static const struct screen_style rich = {256u, false};

static uint32_t code_at(int row, int col) { return screen.cells[row][col].code; }

void parts_check_canvas(void)
{
    const struct canvas canvas = {&screen, 1, 2, 3, 4};
    const struct axis axis = {-1.0, 3.0};
    struct axis followed = {0.0, 0.0};

    screen_open(&screen, 5, 8, rich);
    canvas_dot(&canvas, 0, 0, TINT_FADED);
    tap_check(code_at(1, 2) == 0x2801u, "the first dot of a character is that of Unicode");
    canvas_dot(&canvas, 1, 3, TINT_FRESH);
    tap_check(code_at(1, 2) == 0x2881u && screen.cells[1][2].tint == TINT_FRESH,
              "a later dot joins it and lends its colour");
    canvas_dot(&canvas, 7, 11, TINT_FRESH);
    tap_check(code_at(3, 5) == 0x2880u, "the last dot of a canvas");
    canvas_dot(&canvas, 8, 0, TINT_FRESH);
    canvas_dot(&canvas, 0, 12, TINT_FRESH);
    canvas_dot(&canvas, -1, 0, TINT_FRESH);
    tap_check(code_at(1, 6) == ' ' && code_at(4, 2) == ' ' && code_at(1, 1) == ' ', "nothing is drawn beside it");
    screen_clear(&screen);
    canvas_line(&canvas, 0, 0, 0, 11, TINT_FRESH);
    tap_check(code_at(1, 2) == 0x2847u && code_at(2, 2) == 0x2847u && code_at(3, 2) == 0x2847u, "a line has no gaps");
    canvas_line(&canvas, 0, 0, canvas_across(&canvas, &axis, (double)NAN), 3, TINT_FRESH);
    tap_check(code_at(1, 3) == ' ', "none is drawn to what is no number");

    tap_check(canvas_across(&canvas, &axis, -1.0) == 0 && canvas_across(&canvas, &axis, 3.0) == 7,
              "an axis from left to right");
    tap_check(canvas_down(&canvas, &axis, 3.0) == 0 && canvas_down(&canvas, &axis, -1.0) == 11,
              "and from the top down");

    tap_check(axis_follow(&followed, -0.13, 9.2, 0.1) && followed.low == -2.0 && followed.high == 10.0,
              "an axis ends at round numbers");
    tap_check(axis_follow(&followed, 0.0, 9.9, 0.1) && followed.low == -2.0, "and stays while it fits");
    tap_check(axis_follow(&followed, 4.0, 5.0, 0.1) && followed.low == 4.0 && followed.high == 5.0,
              "it shrinks to what is much smaller");
    tap_check(axis_follow(&followed, 5.0, 5.0, 0.1) && followed.low < 5.0 && followed.high > 5.0,
              "one value has room about it");
    tap_check(!axis_follow(&followed, (double)NAN, 1.0, 0.1) && followed.high > 5.0,
              "what is no number changes nothing");
    tap_check(axis_round_down(0.07) == 0.05 && axis_round_down(199.0) == 100.0 && axis_round_down(1000.0) == 1000.0,
              "1, 2, 5");
}

/* A frame is shown, and what it was told goes to the emulator. Returns its bytes. */
static size_t show(void)
{
    char *bytes = NULL;
    size_t size = 0u;
    FILE *out = open_memstream(&bytes, &size);

    (void)screen_show(&screen, out);
    (void)fclose(out);
    emulator_take(&emulator, bytes, size);
    free(bytes);
    return size;
}

static bool is_shown(void)
{
    static char looks[TINT_COUNT][EMULATOR_LOOK];
    static bool is_seen[TINT_COUNT];

    for (int row = 0; row < screen.rows; row++) {
        for (int col = 0; col < screen.cols; col++) {
            const struct screen_cell cell = screen.cells[row][col];
            const char *look = emulator.looks[row][col];

            if (emulator.codes[row][col] != cell.code) {
                return false;
            }
            if (cell.code != ' ' && is_seen[cell.tint] && strcmp(looks[cell.tint], look) != 0) {
                return false;
            }
            for (int tint = 0; cell.code != ' ' && tint < TINT_COUNT; tint++) {
                if (tint != cell.tint && is_seen[tint] && strcmp(looks[tint], look) == 0) {
                    return false; /* two that look the same */
                }
            }
            if (cell.code != ' ') {
                is_seen[cell.tint] = true;
                (void)strcpy(looks[cell.tint], look);
            }
        }
    }
    return true;
}

void parts_check_screen(void)
{
    static const uint32_t codes[] = {' ', 'a', '~', 0xb5u, 0x2500u, 0x28ffu, 0x2588u, 0x1f600u};
    bool always = true;
    size_t whole, part;

    srand(1);
    screen_open(&screen, ROWS, COLS, rich);
    emulator_open(&emulator, ROWS, COLS);
    whole = show();
    for (int frame = 0; frame < FRAMES; frame++) {
        for (int i = 0; i < CHANGES; i++) {
            screen_put(&screen, rand() % (ROWS + 2) - 1, rand() % (COLS + 2) - 1, codes[rand() % 8],
                       (enum tint)(rand() % TINT_COUNT));
        }
        (void)show();
        always = always && is_shown();
    }
    tap_check(whole > ROWS * COLS, "the first frame is sent whole");
    tap_check(always && emulator.unknown == 0u, "differences alone make the terminal show every frame");
    tap_check(show() == 0u, "a frame like the one before costs no byte");
    screen_put(&screen, 3, 3, 'x', TINT_SQUEAL);
    part = show();
    tap_check(part > 0u && part < 60u, "one character costs few");
    screen_open(&screen, 10, 40, rich);
    emulator_open(&emulator, 10, 40);
    tap_check(show() > 400u && is_shown(), "another size: all of it anew");
    tap_check(screen_text(&screen, 0, 30, 4, TINT_PLAIN, "\xc2\xb5 and more") == 4 && code_at(0, 30) == 0xb5u &&
                  code_at(0, 34) == ' ',
              "text is cut by columns, not bytes");
    (void)screen_text(&screen, 1, 0, 9, TINT_PLAIN, "a\033[31mb");
    tap_check(code_at(1, 1) == '?', "a control character does not get through");
    screen_open(&screen, 10, 40, (struct screen_style){0u, true});
    screen_put(&screen, 0, 0, 0x28ffu, TINT_SQUEAL);
    screen_put(&screen, 0, 1, 0x2588u, TINT_SQUEAL);
    (void)show();
    tap_check(emulator.codes[0][0] == ':' && emulator.codes[0][1] == '#', "ASCII where nothing else is understood");
    tap_check(strstr(emulator.looks[0][0], "3") == NULL, "and no colour where none is wanted");
}

/* The keys that these bytes make, the pause after them included. */
static const char *keys_of(const char *bytes)
{
    static char text[128];
    struct keys keys = {{0}, 0u};
    size_t length = 0u;

    text[0] = '\0';
    for (const char *at = bytes;; at++) {
        const int key = *at != '\0' ? keys_take(&keys, *at) : keys_pause(&keys);

        if (key != KEY_NONE) {
            length += (size_t)snprintf(text + length, sizeof text - length, "%d ", key);
        }
        if (*at == '\0') {
            return text;
        }
    }
}

void parts_check_keys(void)
{
    tap_check(strcmp(keys_of("q+\r\n"), "113 43 13 13 ") == 0, "characters are keys");
    tap_check(strcmp(keys_of("\033[A\033OB\033[C\033[D"), "256 257 258 259 ") == 0,
              "arrows, in both ways to send them");
    tap_check(strcmp(keys_of("\033[5~\033[6~\033OP\033[11~\033[[A"), "260 261 264 264 264 ") == 0, "pages and F1");
    tap_check(strcmp(keys_of("\033"), "27 ") == 0, "escape on its own");
    tap_check(strcmp(keys_of("\033\033[A"), "27 256 ") == 0, "and before an arrow");
    tap_check(strcmp(keys_of("\033[1;5Ax\033[200~y\033[?1;2cz"), "120 121 122 ") == 0,
              "what nobody knows is dropped as a whole");
    tap_check(strcmp(keys_of("\033[99999999999999999999999~a"), "97 ") == 0, "however long it is");
    tap_check(strcmp(keys_of("\303\274"), "") == 0, "no key beyond ASCII");
}
