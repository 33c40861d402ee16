/* What the pictures of the story share. */
#include "squeal/story/plot_parts.h"

#include "squeal/support/fields.h"

#include <string.h>

void plot_title_write(FILE *script, const struct act *act)
{
    char words[SESSION_LINE_MAX], class[64], frequency[64];

    (void)fields_text(act->verdict, "class", class, sizeof class);
    (void)fields_text(act->verdict, "frequency_hz", frequency, sizeof frequency);
    (void)fprintf(script, "set title offset 0,1.3 \"%s", figure_plain(act->title, words, sizeof words));
    (void)fprintf(script, "\\n{/*0.8 %s", figure_plain(class, words, sizeof words));
    if (frequency[0] != '\0' && strcmp(frequency, "nan") != 0) {
        (void)fprintf(script, ", %.5g Hz", fields_number(act->verdict, "frequency_hz"));
    }
    (void)fputs("}\"\n", script);
}

static const char *path_of(const struct story *story, char path[STORY_PATH_SIZE], const char *name, const char *suffix)
{
    char file[64];

    (void)snprintf(file, sizeof file, "%s%s", name, suffix);
    return story_path(story, path, file);
}

void plot_picture_start(FILE *script, const struct story *story, const char *name, bool is_svg)
{
    char path[STORY_PATH_SIZE];

    figure_start(script, path_of(story, path, name, ""), is_svg);
}

FILE *plot_script_open(struct story *story)
{
    FILE *script = figure_open();

    if (script == NULL) {
        story_fail(story, "gnuplot cannot be started");
    }
    return script;
}

void plot_tell(struct story *story, bool is_drawn, const char *name, const char *what)
{
    char path[STORY_PATH_SIZE];

    if (!is_drawn) {
        story_fail(story, "gnuplot could not draw %s", name);
        return;
    }
    story_wrote(story, path_of(story, path, name, ".svg"), what);
    story_wrote(story, path_of(story, path, name, ".png"), what);
}

void plot_script_close(struct story *story, FILE *script, const char *name, const char *what)
{
    char path[STORY_PATH_SIZE];

    plot_tell(story, figure_close(script, path_of(story, path, name, "")), name, what);
}

size_t plot_period_of(const struct act *act)
{
    const double spp = fields_number(act->status, "spp");
    const double period = (spp > 0.0 ? spp : 64.0) / act->every;

    return period > 1.0 ? (size_t)period : 1;
}
