/* What is made of the records: the page, the tables of claims and numbers, and the score. */
#ifndef SQUEAL_PAPER_PAGE_H
#define SQUEAL_PAPER_PAGE_H

#include <stdbool.h>
#include <stddef.h>

#include "squeal/paper/paper.h"
#include "squeal/paper/record.h"

/* What a claim came to; points into a record. */
struct page_claim {
    enum paper_verdict verdict;
    const char *figure, *measured;
};

struct page_score {
    size_t agree, off, failed;
    size_t claims[PAPER_NOT_JUDGED + 1]; /* by verdict */
};

/* records[i] is that of paper_experiments[i], empty where it was not wanted. claims has room for all of claims.def. */
struct page {
    const struct paper_options *options;
    const struct record *records;
    struct page_claim *claims;
    struct page_score score;
};

/* Gathers claims and score from the records. */
void page_gather(struct page *page);

/* Writes index.html, claims.csv and numbers.csv. False with the problem. */
bool page_write(const struct page *page, char problem[CSV_PROBLEM_MAX]);

#endif
