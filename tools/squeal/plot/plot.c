/* What all pictures share: gnuplot itself, their look, their title, their units. */
#include "squeal/plot/plot_parts.h"

#include "squeal/support/fields.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static struct plot_unit unit_for(double size, const char *names[3])
{
    if (size < 1e-3) {
        return (struct plot_unit){1e6, names[2]};
    }
    return size < 1.0 ? (struct plot_unit){1e3, names[1]} : (struct plot_unit){1.0, names[0]};
}

struct plot_unit plot_unit_of_length(double size)
{
    const char *names[3] = {"m", "mm", PLOT_MICRO "m"};

    return unit_for(size, names);
}

struct plot_unit plot_unit_of_speed(double size)
{
    const char *names[3] = {"m/s", "mm/s", PLOT_MICRO "m/s"};

    return unit_for(size, names);
}

bool plot_is_possible(void) { return system("command -v gnuplot >/dev/null 2>&1") == 0; }

const char *plot_plain(const char *text, char out[SESSION_LINE_MAX])
{
    size_t i = 0;

    for (; text[i] != '\0' && i < SESSION_LINE_MAX - 1; i++) {
        out[i] = strchr("\"\\`{}^_@&~$%", text[i]) != NULL ? ' ' : text[i];
    }
    out[i] = '\0';
    return out;
}

void plot_title_write(FILE *script, const struct act *act)
{
    char words[SESSION_LINE_MAX], class[64], frequency[64];

    (void)fields_text(act->verdict, "class", class, sizeof class);
    (void)fields_text(act->verdict, "frequency_hz", frequency, sizeof frequency);
    (void)fprintf(script, "set title offset 0,1.3 \"%s", plot_plain(act->title, words));
    (void)fprintf(script, "\\n{/*0.8 %s", plot_plain(class, words));
    if (frequency[0] != '\0' && strcmp(frequency, "nan") != 0) {
        (void)fprintf(script, ", %.5g Hz", fields_number(act->verdict, "frequency_hz"));
    }
    (void)fputs("}\"\n", script);
}

/* A path between single quotes, in which gnuplot wants such a quote twice. */
static void path_write(FILE *script, const char *path)
{
    (void)fputc('\'', script);
    for (; *path != '\0'; path++) {
        (void)fputs(*path == '\'' ? "'" : "", script);
        (void)fputc(*path, script);
    }
    (void)fputc('\'', script);
}

void plot_picture_start(FILE *script, const struct story *story, const char *name, bool is_svg)
{
    char path[STORY_PATH_SIZE], file[64];

    (void)snprintf(file, sizeof file, "%s.%s", name, is_svg ? "svg" : "png");
    (void)fprintf(
        script,
        "reset\nset encoding utf8\nset terminal %s size 1200,900 font 'Helvetica,%d' enhanced background 'white'\n",
        is_svg ? "svg" : "pngcairo", is_svg ? 20 : 18);
    (void)fputs("set output ", script);
    path_write(script, story_path(story, path, file));
    (void)fputs("\nset border 3 lc rgb '#606060'\nset tics nomirror out\nset grid lc rgb '#ececec' lt 1\n"
                "set key at graph 1,1.005 right bottom horizontal maxrows 1 samplen 2\nset lmargin 12\nset tmargin "
                "5.5\nset rmargin 4\n",
                script);
}

FILE *plot_script_open(struct story *story)
{
    (void)fflush(NULL);
    FILE *script = popen("gnuplot", "w");

    if (script == NULL) {
        story_fail(story, "gnuplot cannot be started");
    }
    return script;
}

void plot_script_close(struct story *story, FILE *script, const char *name, const char *what)
{
    char path[STORY_PATH_SIZE], file[64];

    bool is_drawn = pclose(script) == 0;
    for (int i = 0; i < 2 && is_drawn; i++) {
        struct stat status;
        (void)snprintf(file, sizeof file, "%s.%s", name, i == 0 ? "svg" : "png");
        is_drawn = stat(story_path(story, path, file), &status) == 0 && status.st_size > 0;
        if (is_drawn) {
            story_wrote(story, path, what);
        }
    }
    if (!is_drawn) {
        story_fail(story, "gnuplot could not draw %s", name);
    }
}

size_t plot_period_of(const struct act *act)
{
    const double spp = fields_number(act->status, "spp");
    const double period = (spp > 0.0 ? spp : 64.0) / act->every;

    return period > 1.0 ? (size_t)period : 1;
}
