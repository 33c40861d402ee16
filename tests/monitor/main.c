/* The monitor without a device and without a terminal: its parts, and its pictures.
 *
 *     monitor                                     checks the parts
 *     monitor screen ROWS COLS SCENE [WAY...]     prints a picture: its characters, then a letter for each colour
 *     monitor word WORD                           prints a word in large letters
 *     monitor line SCENE                          prints the line for pipes
 *
 * SCENE is squeal or fault; WAY is help, presets or ascii. */
#include "tests/monitor/parts.h"
#include "tests/monitor/scene.h"
#include "tests/monitor/tap.h"

#include "squeal/monitor/letters.h"
#include "squeal/monitor/lines.h"
#include "squeal/monitor/panels.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static struct picture picture;
static struct screen screen;

static void print_row(int row, bool is_tint)
{
    static const char tints[TINT_COUNT] = " .!kqwsu321m";
    int last = screen.cols - 1;

    while (last >= 0 && screen.cells[row][last].code == ' ') {
        last--;
    }
    for (int col = 0; col <= last; col++) {
        const struct screen_cell cell = screen.cells[row][col];
        char bytes[5];

        screen_encode(screen.style, cell.code, bytes);
        if (is_tint) {
            putchar(cell.code == ' ' ? ' ' : cell.tint == TINT_PLAIN ? '-' : tints[cell.tint]);
        } else {
            (void)fputs(bytes, stdout);
        }
    }
    putchar('\n');
}

static bool set_scene(const char *name)
{
    if (strcmp(name, "squeal") == 0) {
        scene_squeal(&picture);
    } else if (strcmp(name, "fault") == 0) {
        scene_fault(&picture);
    } else {
        return false;
    }
    return true;
}

static int print_screen(int argc, char **argv)
{
    const int rows = atoi(argv[2]);
    const int cols = atoi(argv[3]);
    struct screen_style style = {256u, false};

    if (!set_scene(argv[4])) {
        return 2;
    }
    for (int i = 5; i < argc; i++) {
        style.is_ascii = style.is_ascii || strcmp(argv[i], "ascii") == 0;
        picture.overlay = strcmp(argv[i], "help") == 0      ? PICTURE_HELP
                          : strcmp(argv[i], "presets") == 0 ? PICTURE_CHOOSER
                                                            : picture.overlay;
    }
    picture_update(&picture, panels_strip_cols(cols));
    screen_open(&screen, rows, cols, style);
    panels_draw(&screen, &picture);
    for (int i = 0; i < 2 * screen.rows; i++) {
        print_row(i % screen.rows, i >= screen.rows);
    }
    return 0;
}

static int print_word(const char *word)
{
    screen_open(&screen, LETTERS_ROWS, letters_width(word, 1), (struct screen_style){0u, false});
    letters_draw(&screen, 0, 0, 1, TINT_PLAIN, word);
    for (int row = 0; row < screen.rows; row++) {
        print_row(row, false);
    }
    return 0;
}

int main(int argc, char **argv)
{
    if (argc >= 5 && strcmp(argv[1], "screen") == 0) {
        return print_screen(argc, argv);
    }
    if (argc == 3 && strcmp(argv[1], "word") == 0) {
        return print_word(argv[2]);
    }
    if (argc == 3 && strcmp(argv[1], "line") == 0 && set_scene(argv[2])) {
        picture_update(&picture, panels_strip_cols(80));
        return lines_print(stdout, &picture) ? 0 : 1;
    }
    if (argc != 1) {
        fprintf(stderr, "monitor: not so\n");
        return 2;
    }
    parts_check_canvas();
    parts_check_screen();
    parts_check_keys();
    parts_check_spectrum();
    parts_check_trace();
    parts_check_words();
    return tap_end() == 0 ? 0 : 1;
}
