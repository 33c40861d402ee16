/* Words in large letters, five rows high. */
#ifndef SQUEAL_LETTERS_H
#define SQUEAL_LETTERS_H

#include "squeal/monitor/screen.h"

enum { LETTERS_ROWS = 5 };

/* Columns that a word takes at this scale. */
int letters_width(const char *word, int scale);

/* Draws it; capitals only, what has no letter is left out. */
void letters_draw(struct screen *screen, int row, int col, int scale, enum tint tint, const char *word);

#endif
