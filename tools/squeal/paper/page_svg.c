/* A picture of gnuplot's inside a page: its own names get the picture's before them, so that no two are alike. */
#include "squeal/paper/page_parts.h"

#include <stdlib.h>
#include <string.h>

/* Behind these a name begins. */
static const char *const before_names[] = {"id='", "id=\"", "href='#", "href=\"#", "url(#"};

static size_t before_name(const char *at)
{
    for (size_t i = 0; i < sizeof before_names / sizeof before_names[0]; i++) {
        const size_t length = strlen(before_names[i]);
        if (strncmp(at, before_names[i], length) == 0) {
            return length;
        }
    }
    return 0;
}

void page_copy_svg(FILE *file, const char *folder, const char *name)
{
    char path[PAPER_PATH_MAX], problem[CSV_PROBLEM_MAX];

    (void)snprintf(path, sizeof path, "%s/%s.svg", folder, name);
    char *text = csv_read_text(path, problem);
    const char *at = text != NULL ? strstr(text, "<svg") : NULL; /* what comes before is for a file of its own */
    if (at == NULL) {
        (void)fputs("<p class=failure>The picture is missing.</p>", file);
    }
    while (at != NULL && *at != '\0') {
        const size_t length = before_name(at);
        (void)fwrite(at, 1, length > 0 ? length : 1, file);
        if (length > 0) {
            (void)fprintf(file, "%s-", name);
        }
        at += length > 0 ? length : 1;
    }
    free(text);
}
