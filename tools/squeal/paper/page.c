/* The page: one file that needs no other, and no network. The records item by item, in their order. */
#include "squeal/paper/page.h"

#include "squeal/paper/page_parts.h"

#include <stdlib.h>
#include <string.h>

/* --- Parts of a section ------------------------------------------------------------------------------------------- */

/* What is open while the items of a record are written one after the other. */
struct writing {
    const struct page *page;
    FILE *file;
    bool has_block, has_table;
    const char *subject; /* of the table's last row */
};

static void table_end(struct writing *writing)
{
    if (writing->has_table) {
        (void)fputs("</table>\n", writing->file);
        writing->has_table = false;
    }
}

static void block_end(struct writing *writing)
{
    table_end(writing);
    if (writing->has_block) {
        (void)fputs("</div></div>\n", writing->file);
        writing->has_block = false;
    }
}

static void write_figure(struct writing *writing, const struct record_item *item)
{
    const char *name = item->field[0];

    block_end(writing);
    page_put(writing->file, "<div class=block><figure id=\"", name, "\">\n");
    page_copy_svg(writing->file, writing->page->options->out, name);
    page_put(writing->file, "<figcaption>", item->field[1], "");
    page_put(writing->file, " (<a href=\"", name, ".svg\">SVG</a>,");
    page_put(writing->file, " <a href=\"", name, ".png\">PNG</a>)</figcaption></figure><div class=side>\n");
    writing->has_block = true;
}

static void write_number(struct writing *writing, const struct record_item *item)
{
    char *const *field = item->field;

    if (!writing->has_table) {
        (void)fputs("<table><tr><th class=t></th><th>measured</th><th class=t>unit</th><th>reference</th>"
                    "<th>within</th><th class=t></th></tr>\n",
                    writing->file);
        writing->has_table = true;
        writing->subject = "";
    }
    if (strcmp(writing->subject, field[0]) != 0) {
        page_put(writing->file, "<tr><td class=subject colspan=6>", field[0], "</td></tr>\n");
        writing->subject = field[0];
    }
    (void)fputs(strcmp(field[6], "OFF") == 0 ? "<tr class=off>" : "<tr>", writing->file);
    page_put(writing->file, "<td class=t>", field[1], "</td>");
    page_put(writing->file, "<td>", field[2], "</td>");
    page_put(writing->file, "<td class=t>", strcmp(field[3], "1") == 0 ? "" : field[3], "</td>");
    page_put(writing->file, "<td>", field[4], "</td>");
    page_put(writing->file, "<td>", field[5], "</td>");
    page_put(writing->file, "<td class=t>", field[6], "</td></tr>\n");
}

static void write_claim(struct writing *writing, const struct record_item *item)
{
    const struct claim *claim = &paper_claims[strtoul(item->field[0], NULL, 10)];
    const enum paper_verdict verdict = (enum paper_verdict)atoi(item->field[1]);

    table_end(writing);
    (void)fprintf(writing->file, "<div class=\"claim v%d\" id=\"claim-%s\">", (int)verdict, claim->id);
    page_put(writing->file, "<p><span class=verdict>", paper_verdict_name(verdict), "</span> ");
    page_put(writing->file, "", claim->claim, "</p>");
    page_put(writing->file, "<p>Paper: ", claim->paper, "</p>");
    page_put(writing->file, "<p>Measured: ", item->field[3], "</p></div>\n");
}

static void write_item(struct writing *writing, const struct record_item *item)
{
    switch (item->kind) {
    case RECORD_FIGURE:
        write_figure(writing, item);
        break;
    case RECORD_NUMBER:
        write_number(writing, item);
        break;
    case RECORD_CLAIM:
        write_claim(writing, item);
        break;
    case RECORD_NOTE:
        table_end(writing);
        page_put(writing->file, "<p>", item->field[0], "</p>\n");
        break;
    case RECORD_DATA:
        table_end(writing);
        page_put(writing->file, "<p>Data: <a href=\"", item->field[0], ".csv\">");
        page_put(writing->file, "", item->field[0], ".csv</a></p>\n");
        break;
    case RECORD_FAILURE:
        block_end(writing);
        page_put(writing->file, "<p class=failure>Failed: ", item->field[0], "</p>\n");
        break;
    case RECORD_DEVICE:
    case RECORD_KINDS:
    default:
        break;
    }
}

static void write_section(const struct page *page, FILE *file, size_t index)
{
    struct writing writing = {.page = page, .file = file};

    page_put(file, "<section id=\"", paper_experiments[index].id, "\"><h2>");
    page_put(file, "", paper_experiments[index].title, "</h2>\n");
    for (size_t i = 0; i < page->records[index].count; i++) {
        write_item(&writing, &page->records[index].items[i]);
    }
    block_end(&writing);
    (void)fputs("</section>\n", file);
}

bool page_write(const struct page *page, char problem[CSV_PROBLEM_MAX])
{
    char path[PAPER_PATH_MAX];

    (void)snprintf(path, sizeof path, "%s/index.html", page->options->out);
    FILE *file = csv_create(path, problem);
    if (file == NULL) {
        return false;
    }
    page_write_head(page, file);
    for (size_t i = 0; i < paper_experiment_count; i++) {
        if (paper_experiments[i].is_wanted) {
            write_section(page, file, i);
        }
    }
    (void)fputs("</body></html>\n", file);
    return csv_close(file, path, problem) && page_write_claims(page, problem) && page_write_numbers(page, problem);
}
