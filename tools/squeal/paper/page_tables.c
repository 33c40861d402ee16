/* What the records come to: claims, score, and both as tables. */
#include "squeal/paper/page_parts.h"

#include <stdlib.h>
#include <string.h>

static void take_claim(struct page *page, const struct record_item *item)
{
    const size_t place = strtoul(item->field[0], NULL, 10);

    if (place < paper_claim_count) {
        page->claims[place] =
            (struct page_claim){(enum paper_verdict)atoi(item->field[1]), item->field[2], item->field[3]};
    }
}

static void take_record(struct page *page, const struct record *record)
{
    for (const struct record_item *item = record->items; item < record->items + record->count; item++) {
        if (item->kind == RECORD_CLAIM) {
            take_claim(page, item);
        } else if (item->kind == RECORD_NUMBER) {
            page->score.agree += strcmp(item->field[6], "agrees") == 0 ? 1 : 0;
            page->score.off += strcmp(item->field[6], "OFF") == 0 ? 1 : 0;
        } else if (item->kind == RECORD_FAILURE) {
            page->score.failed++;
        }
    }
}

void page_gather(struct page *page)
{
    page->score = (struct page_score){0};
    for (size_t i = 0; i < paper_claim_count; i++) {
        page->claims[i] = (struct page_claim){PAPER_NOT_JUDGED, "", ""};
    }
    for (size_t i = 0; i < paper_experiment_count; i++) {
        take_record(page, &page->records[i]);
    }
    for (size_t i = 0; i < paper_claim_count; i++) {
        page->score.claims[page->claims[i].verdict]++;
    }
}

/* A cell with whatever is in it, quoted as spreadsheets want it. */
static void put_cell(FILE *file, const char *text, const char *after)
{
    (void)fputc('"', file);
    for (; *text != '\0'; text++) {
        (void)fputs(*text == '"' ? "\"" : "", file);
        (void)fputc(*text, file);
    }
    (void)fprintf(file, "\"%s", after);
}

bool page_write_claims(const struct page *page, char problem[CSV_PROBLEM_MAX])
{
    char path[PAPER_PATH_MAX];

    (void)snprintf(path, sizeof path, "%s/claims.csv", page->options->out);
    FILE *file = csv_create(path, problem);
    if (file == NULL) {
        return false;
    }
    (void)fputs("id,claim,paper,measured,verdict,evidence\n", file);
    for (size_t i = 0; i < paper_claim_count; i++) {
        put_cell(file, paper_claims[i].id, ",");
        put_cell(file, paper_claims[i].claim, ",");
        put_cell(file, paper_claims[i].paper, ",");
        put_cell(file, page->claims[i].measured, ",");
        put_cell(file, paper_verdict_name(page->claims[i].verdict), ",");
        put_cell(file, page->claims[i].figure, "\n");
    }
    return csv_close(file, path, problem);
}

bool page_write_numbers(const struct page *page, char problem[CSV_PROBLEM_MAX])
{
    char path[PAPER_PATH_MAX];

    (void)snprintf(path, sizeof path, "%s/numbers.csv", page->options->out);
    FILE *file = csv_create(path, problem);
    if (file == NULL) {
        return false;
    }
    (void)fputs("experiment,subject,quantity,measured,unit,reference,tolerance,verdict\n", file);
    for (size_t i = 0; i < paper_experiment_count; i++) {
        const struct record *record = &page->records[i];
        for (const struct record_item *item = record->items; item < record->items + record->count; item++) {
            if (item->kind != RECORD_NUMBER) {
                continue;
            }
            put_cell(file, paper_experiments[i].id, "");
            for (size_t field = 0; field < RECORD_FIELDS_MAX; field++) {
                (void)fputc(',', file);
                put_cell(file, item->field[field], "");
            }
            (void)fputc('\n', file);
        }
    }
    return csv_close(file, path, problem);
}
