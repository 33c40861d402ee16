/* Letters as dots twice as fine as rows: '#' both halves of a row, '^' the upper one, '_' the lower one. */
#include "squeal/monitor/letters.h"

#include <string.h>

enum { FULL = 0x2588, UPPER = 0x2580, LOWER = 0x2584, GAP = 1 };

static const struct {
    char name;
    const char *rows[LETTERS_ROWS];
} letters[] = {
    {'A', {"_#####_", "##   ##", "#######", "##   ##", "##   ##"}},
    {'C', {"_#####_", "##   ^^", "##     ", "##   __", "^#####^"}},
    {'E', {"#######", "##     ", "#####  ", "##     ", "#######"}},
    {'F', {"#######", "##     ", "#####  ", "##     ", "##     "}},
    {'H', {"##   ##", "##   ##", "#######", "##   ##", "##   ##"}},
    {'I', {"####", " ## ", " ## ", " ## ", "####"}},
    {'K', {"##  _##", "## _##^", "####^  ", "## ^##_", "##  ^##"}},
    {'L', {"##     ", "##     ", "##     ", "##     ", "#######"}},
    {'N', {"##_  ##", "###_ ##", "## ^###", "##  ^##", "##   ##"}},
    {'O', {"_#####_", "##   ##", "##   ##", "##   ##", "^#####^"}},
    {'Q', {"_#####_", "##   ##", "##   ##", "## ^_##", "^####^#"}},
    {'S', {"_#####_", "##   ^^", "^#####_", "__   ##", "^#####^"}},
    {'T', {"########", "   ##   ", "   ##   ", "   ##   ", "   ##   "}},
    {'U', {"##   ##", "##   ##", "##   ##", "##   ##", "^#####^"}},
    {'W', {"##     ##", "##     ##", "##  #  ##", "##_###_##", "^##^ ^##^"}},
};

static const char *const *find(char name)
{
    for (size_t i = 0u; i < sizeof letters / sizeof letters[0]; i++) {
        if (letters[i].name == name) {
            return letters[i].rows;
        }
    }
    return NULL;
}

int letters_width(const char *word, int scale)
{
    int width = 0;

    for (; *word != '\0'; word++) {
        const char *const *rows = find(*word);

        width += rows != NULL ? (int)strlen(rows[0]) + GAP : 0;
    }
    return width > 0 ? (width - GAP) * scale : 0;
}

/* Half a row of a letter, counted from its top. */
static bool is_dark(const char *const *rows, int half, int col)
{
    const char mark = rows[half / 2][col];

    return mark == '#' || mark == (half % 2 == 0 ? '^' : '_');
}

void letters_draw(struct screen *screen, int row, int col, int scale, enum tint tint, const char *word)
{
    for (; *word != '\0'; word++) {
        const char *const *rows = find(*word);
        const int width = rows != NULL ? (int)strlen(rows[0]) : 0;

        for (int y = 0; y < LETTERS_ROWS * scale && rows != NULL; y++) {
            for (int x = 0; x < width * scale; x++) {
                const bool upper = is_dark(rows, 2 * y / scale, x / scale);
                const bool lower = is_dark(rows, (2 * y + 1) / scale, x / scale);

                if (upper || lower) {
                    screen_put(screen, row + y, col + x, upper && lower ? FULL : upper ? UPPER : LOWER, tint);
                }
            }
        }
        col += rows != NULL ? (width + GAP) * scale : 0;
    }
}
