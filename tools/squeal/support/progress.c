/* The bar of a long task. */
#include "squeal/support/progress.h"

#include "squeal/support/clock.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#define AGAIN_S 0.1 /* between two sights of the bar */

enum { BAR_WIDTH = 32, LINE_SIZE = 78, REST_SIZE = 32, PARTS = 10 };

void progress_start(struct progress *progress, size_t of, const char *what)
{
    *progress = (struct progress){.of = of, .what = what, .start_s = clock_now_s()};
    progress->is_terminal = isatty(STDERR_FILENO) == 1;
}

/* Where this many are done, the rest will take as long each as they took on average. */
static void rest_write(char out[REST_SIZE], const struct progress *progress, double now_s)
{
    const double rest_s = (now_s - progress->start_s) * (double)(progress->of - progress->done) /
                          (double)(progress->done > 0 ? progress->done : 1);

    if (rest_s < 100.0) {
        (void)snprintf(out, REST_SIZE, "%.0f s left", ceil(rest_s));
    } else {
        (void)snprintf(out, REST_SIZE, "%.0f min left", ceil(rest_s / 60.0));
    }
}

static void bar_show(struct progress *progress, double now_s)
{
    char bar[BAR_WIDTH + 1], rest[REST_SIZE];
    const size_t full = progress->done * BAR_WIDTH / progress->of;

    memset(bar, '.', BAR_WIDTH);
    memset(bar, '#', full);
    bar[BAR_WIDTH] = '\0';
    rest_write(rest, progress, now_s);
    const int width =
        fprintf(stderr, "\r[%s] %zu of %zu %s, %s", bar, progress->done, progress->of, progress->what, rest);
    (void)fprintf(stderr, "%*s", width < LINE_SIZE ? LINE_SIZE - width : 0, ""); /* over a longer line before it */
    (void)fflush(stderr);
    progress->shown_s = now_s;
}

void progress_show(struct progress *progress, size_t done)
{
    const double now_s = clock_now_s();
    const size_t parts_before = progress->done * PARTS / progress->of;
    char rest[REST_SIZE];

    progress->done = done;
    if (progress->is_terminal) {
        if (now_s - progress->shown_s >= AGAIN_S) {
            bar_show(progress, now_s);
        }
    } else if (done * PARTS / progress->of > parts_before && done < progress->of) {
        rest_write(rest, progress, now_s);
        printf("    %zu of %zu %s, %s\n", done, progress->of, progress->what, rest);
        (void)fflush(stdout);
    }
}

double progress_end(struct progress *progress)
{
    if (progress->is_terminal) {
        (void)fprintf(stderr, "\r%*s\r", LINE_SIZE - 1, "");
        (void)fflush(stderr);
    }
    return clock_now_s() - progress->start_s;
}
