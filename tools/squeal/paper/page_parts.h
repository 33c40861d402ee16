/* What the parts of the page share. */
#ifndef SQUEAL_PAPER_PAGE_PARTS_H
#define SQUEAL_PAPER_PAGE_PARTS_H

#include <stdbool.h>
#include <stdio.h>

#include "squeal/paper/page.h"

/* Text as HTML has it. */
void page_escape(FILE *file, const char *text);

/* Copies the picture NAME.svg of the folder into the page. */
void page_copy_svg(FILE *file, const char *folder, const char *name);

/* claims.csv and numbers.csv. */
bool page_write_claims(const struct page *page, char problem[CSV_PROBLEM_MAX]);
bool page_write_numbers(const struct page *page, char problem[CSV_PROBLEM_MAX]);

#endif
