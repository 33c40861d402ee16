/* The head of the page: looks, score, how it was made, contents, all claims. */
#include "squeal/paper/page_parts.h"

#include <string.h>

static const char style[] =
    "body{font:16px/1.5 Georgia,'DejaVu Serif',serif;color:#1c2430;background:#fff;max-width:76rem;margin:2rem "
    "auto;padding:0 1.5rem}\n"
    "h1,h2,h3,table,figcaption,.verdict,nav{font-family:Helvetica,Arial,'DejaVu Sans',sans-serif}\n"
    "h1{font-size:1.9rem;margin:0 0 .3rem}h2{font-size:1.35rem;margin:3rem 0 .6rem;border-bottom:2px solid "
    "#1f4e79;padding-bottom:.2rem}h3{font-size:1.05rem;margin:1.5rem 0 .4rem}\n"
    "a{color:#1f4e79}nav ol{columns:2;font-size:.92rem;padding-left:1.4rem}\n"
    ".block{display:flex;gap:1.6rem;align-items:flex-start;margin:1.2rem 0 2rem}\n"
    "figure{margin:0;flex:0 0 36rem;max-width:100%}figure svg{width:100%;height:auto;display:block}\n"
    "figcaption{font-size:.85rem;color:#4a5666}.side{flex:1;min-width:18rem}\n"
    "table{border-collapse:collapse;font-size:.85rem;font-variant-numeric:tabular-nums;margin:.3rem 0 1rem}\n"
    "th,td{padding:.18rem .55rem;text-align:right;border-bottom:1px solid "
    "#e3e7ec;vertical-align:top}th{color:#4a5666;font-weight:600}\n"
    "th.t,td.t{text-align:left}tr.off td{background:#f9dede;color:#8c1010;font-weight:700}\n"
    "td.subject{font-weight:600;text-align:left;padding-top:.7rem}\n"
    ".claim{border-left:5px solid #888;padding:.5rem .9rem;margin:.8rem 0;background:#f6f8fa}\n"
    ".claim p{margin:.15rem "
    "0}.verdict{font-weight:700;text-transform:uppercase;font-size:.78rem;letter-spacing:.04em}\n"
    ".v0{border-color:#2e7d32}.v1{border-color:#b26a00}.v2{border-color:#b02020}\n"
    ".v0 .verdict{color:#2e7d32}.v1 .verdict{color:#b26a00}.v2 .verdict{color:#b02020}\n"
    ".failure{background:#f9dede;color:#8c1010;padding:.6rem .9rem;font-weight:700}\n"
    ".score{font-size:1.1rem}.bad{color:#b02020;font-weight:700}\n"
    "@media(max-width:60rem){.block{display:block}nav ol{columns:1}}\n"
    "@media "
    "print{body{max-width:none;margin:0;font-size:11px}.block,.claim,figure{break-inside:avoid}figure{flex-basis:"
    "55%}a{color:inherit;text-decoration:none}}\n";

void page_escape(FILE *file, const char *text)
{
    for (; *text != '\0'; text++) {
        switch (*text) {
        case '&':
            (void)fputs("&amp;", file);
            break;
        case '<':
            (void)fputs("&lt;", file);
            break;
        case '>':
            (void)fputs("&gt;", file);
            break;
        case '"':
            (void)fputs("&quot;", file);
            break;
        default:
            (void)fputc(*text, file);
        }
    }
}

void page_put(FILE *file, const char *before, const char *text, const char *after)
{
    (void)fputs(before, file);
    page_escape(file, text);
    (void)fputs(after, file);
}

/* Board and build, as the first device said it. */
static void write_device(const struct page *page, FILE *file)
{
    for (size_t i = 0; i < paper_experiment_count; i++) {
        const struct record *record = &page->records[i];
        if (record->count > 0 && record->items[0].kind == RECORD_DEVICE) {
            page_put(file, "<tr><td class=t>board</td><td class=t>", record->items[0].field[0], "</td></tr>\n");
            page_put(file, "<tr><td class=t>firmware</td><td class=t>", record->items[0].field[1], "</td></tr>\n");
            return;
        }
    }
}

static void write_made(const struct page *page, FILE *file)
{
    const struct paper_options *options = page->options;

    (void)fputs("<table>\n", file);
    write_device(page, file);
    page_put(file, "<tr><td class=t>number format</td><td class=t>", options->arith, "</td></tr>\n");
    page_put(file, "<tr><td class=t>method</td><td class=t>", options->method, ", ");
    page_put(file, "normal direction ", options->normal, ", ");
    page_put(file, "", options->spp, " steps a normal period, where nothing else is said</td></tr>\n");
    page_put(file, "<tr><td class=t>made by</td><td class=t><code>", options->line, "</code></td></tr>\n</table>\n");
}

static void write_off(const struct page *page, FILE *file)
{
    for (size_t i = 0; i < paper_experiment_count; i++) {
        for (const struct record_item *item = page->records[i].items;
             item < page->records[i].items + page->records[i].count; item++) {
            if (item->kind == RECORD_FAILURE) {
                page_put(file, "<p class=failure>", paper_experiments[i].id, " failed: ");
                page_put(file, "", item->field[0], "</p>\n");
            } else if (item->kind == RECORD_NUMBER && strcmp(item->field[6], "OFF") == 0) {
                page_put(file, "<p class=bad>OFF: <a href=\"#", paper_experiments[i].id, "\">");
                page_put(file, "", item->field[0], "</a>, ");
                page_put(file, "", item->field[1], ": ");
                page_put(file, "", item->field[2], ", ");
                page_put(file, "reference ", item->field[4], "</p>\n");
            }
        }
    }
}

static void write_claims(const struct page *page, FILE *file)
{
    (void)fputs("<h2 id=\"claims\">The claims</h2>\n<table><tr><th class=t>claim</th><th class=t>paper</th>"
                "<th class=t>measured</th><th class=t>verdict</th></tr>\n",
                file);
    for (size_t i = 0; i < paper_claim_count; i++) {
        const struct page_claim *found = &page->claims[i];
        (void)fprintf(file, "<tr class=v%d>", (int)found->verdict);
        page_put(file, "<td class=t>", paper_claims[i].claim, "</td>");
        page_put(file, "<td class=t>", paper_claims[i].paper, "</td>");
        page_put(file, "<td class=t>", found->measured, "</td><td class=t><span class=verdict>");
        if (found->verdict == PAPER_NOT_JUDGED) {
            page_put(file, "", paper_verdict_name(found->verdict), "</span></td></tr>\n");
        } else {
            page_put(file, "<a href=\"#", found->figure[0] != '\0' ? found->figure : "claims", "\">");
            page_put(file, "", paper_verdict_name(found->verdict), "</a></span></td></tr>\n");
        }
    }
    (void)fputs("</table>\n", file);
}

void page_write_head(const struct page *page, FILE *file)
{
    const struct page_score *score = &page->score;

    (void)fprintf(file,
                  "<!DOCTYPE html>\n<html lang=en><head><meta charset=utf-8><meta name=viewport "
                  "content=\"width=device-width\"><title>The paper, reproduced</title>\n<style>\n%s</style></head>"
                  "<body>\n<h1>The paper, reproduced</h1>\n"
                  "<p>Every figure of the brake-squeal paper, run again on the firmware through its own interface. "
                  "Numbers stand beside the reference solution, claims beside their verdict.</p>\n",
                  style);
    (void)fprintf(file,
                  "<p class=score><b>%zu</b> of %zu numbers agree with the reference%s. Of %zu claims <b>%zu</b> "
                  "hold, <b>%zu</b> in part, <b>%zu</b> are refuted%s.</p>\n",
                  score->agree, score->agree + score->off,
                  score->off > 0 ? ", <span class=bad>the others are OFF</span>" : "", paper_claim_count,
                  score->claims[PAPER_HOLDS], score->claims[PAPER_IN_PART], score->claims[PAPER_REFUTED],
                  score->claims[PAPER_NOT_JUDGED] > 0 ? ", <span class=bad>the others were not judged</span>" : "");
    write_off(page, file);
    write_made(page, file);
    (void)fputs("<nav><ol>\n<li><a href=\"#claims\">The claims</a></li>\n", file);
    for (size_t i = 0; i < paper_experiment_count; i++) {
        if (paper_experiments[i].is_wanted) {
            page_put(file, "<li><a href=\"#", paper_experiments[i].id, "\">");
            page_put(file, "", paper_experiments[i].title, "</a></li>\n");
        }
    }
    (void)fputs("</ol></nav>\n", file);
    write_claims(page, file);
}
