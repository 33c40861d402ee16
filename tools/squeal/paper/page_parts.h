/* What the parts of the page share. */
#ifndef SQUEAL_PAPER_PAGE_PARTS_H
#define SQUEAL_PAPER_PAGE_PARTS_H

#include <stdbool.h>
#include <stdio.h>

#include "squeal/paper/page.h"

/* Text as HTML has it; the same between two pieces of markup. */
void page_escape(FILE *file, const char *text);
void page_put(FILE *file, const char *before, const char *text, const char *after);

/* All that comes before the first section. */
void page_write_head(const struct page *page, FILE *file);

/* Copies the picture NAME.svg of the folder into the page. */
void page_copy_svg(FILE *file, const char *folder, const char *name);

/* claims.csv and numbers.csv. */
bool page_write_claims(const struct page *page, char problem[CSV_PROBLEM_MAX]);
bool page_write_numbers(const struct page *page, char problem[CSV_PROBLEM_MAX]);

#endif
