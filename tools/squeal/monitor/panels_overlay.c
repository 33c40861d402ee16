/* What lies over the picture for a while: help, and the list of presets. */
#include "squeal/monitor/panels_parts.h"

enum { PADDING = 2, CHOOSER_NAME_COLS = 20, DIGITS = 9 };

static const struct {
    const char *keys, *what;
} help[] = {
    {"n N     down up", "brake force: N1 of a step or ramp, else N0"},
    {"v V     left right", "disc speed: v1 of a step or ramp, else v0"},
    {"a A     page down up", "slope of friction over speed, alpha"},
    {"space", "run, stop"},
    {"r", "reset: step 0, the same set"},
    {"p", "presets; 1 to 9: one of the first nine"},
    {"- +", "pace: half, twice as many steps a second"},
    {", .", "samples: twice as many, half as many"},
    {"[ ]", "time shown: half, twice as long"},
    {"h ?", "this text"},
    {"q", "quit; what was started for the port ends"},
    {"", ""},
    {NULL, "The keys change the set, live, a twentieth at a time. A preset"},
    {NULL, "runs at 8000 steps a second, by its substeps, where its own pace"},
    {NULL, "would be too slow to watch; --as-is leaves that alone. No bit of"},
    {NULL, "the motion depends on the pace. Dots fade with age; the dotted"},
    {NULL, "line is the disc's speed: on it the pad sticks."},
};

/* A blank field with a margin; returns what is inside. */
static struct area open_box(struct screen *screen, int rows, int cols, const char *title)
{
    const struct area area = {(screen->rows - rows) / 2, (screen->cols - cols) / 2, rows, cols};

    for (int row = area.row - 1; row <= area.row + rows; row++) {
        for (int col = area.col - PADDING; col < area.col + cols + PADDING; col++) {
            const bool is_edge = row == area.row - 1 || row == area.row + rows;

            screen_put(screen, row, col, is_edge ? 0x2500u : ' ', TINT_DIM);
        }
    }
    (void)screen_text(screen, area.row - 1, area.col, cols, TINT_STRONG, title);
    return area;
}

void panels_draw_help(struct screen *screen)
{
    enum { COUNT = sizeof help / sizeof help[0], KEY_COLS = 22, COLS = 66 };
    const struct area area = open_box(screen, COUNT, COLS, " keys ");

    for (int i = 0; i < COUNT; i++) {
        const int indent = help[i].keys != NULL ? KEY_COLS : 0;

        (void)screen_text(screen, area.row + i, area.col, indent, TINT_KEY, indent > 0 ? help[i].keys : "");
        (void)screen_text(screen, area.row + i, area.col + indent, COLS - indent, TINT_PLAIN, help[i].what);
    }
}

void panels_draw_chooser(struct screen *screen, const struct picture *picture)
{
    const int count = (int)picture->choice_count;
    const int chosen = (int)picture->choice;
    const int rows = count < screen->rows - 6 ? count : screen->rows - 6;
    const int first = chosen < rows / 2 || count <= rows ? 0
                      : chosen - rows / 2 > count - rows ? count - rows
                                                         : chosen - rows / 2;
    const struct area area = open_box(screen, rows, screen->cols - 8, " presets: up, down, Enter; Esc leaves ");

    for (int i = 0; i < rows; i++) {
        const struct picture_choice *choice = &picture->choices[first + i];
        const bool is_chosen = first + i == chosen;
        int col = area.col;

        if (first + i < DIGITS) {
            (void)panels_print(screen, area.row + i, col, 2, TINT_KEY, "%d", first + i + 1);
        }
        col += 2;
        (void)screen_text(screen, area.row + i, col, 2, TINT_KEY, is_chosen ? ">" : " ");
        col += 2;
        (void)screen_text(screen, area.row + i, col, CHOOSER_NAME_COLS, is_chosen ? TINT_STRONG : TINT_PLAIN,
                          choice->name);
        col += CHOOSER_NAME_COLS;
        (void)screen_text(screen, area.row + i, col, area.col + area.cols - col, is_chosen ? TINT_PLAIN : TINT_DIM,
                          choice->help);
    }
}
