/* gnuplot, the look of all pictures, and their units. */
#include "squeal/plot/figure.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum { PATH_SIZE = 1024 };

static struct figure_unit unit_for(double size, const char *names[3])
{
    if (size < 1e-3) {
        return (struct figure_unit){1e6, names[2]};
    }
    return size < 1.0 ? (struct figure_unit){1e3, names[1]} : (struct figure_unit){1.0, names[0]};
}

struct figure_unit figure_unit_of_length(double size)
{
    const char *names[3] = {"m", "mm", FIGURE_MICRO "m"};

    return unit_for(size, names);
}

struct figure_unit figure_unit_of_speed(double size)
{
    const char *names[3] = {"m/s", "mm/s", FIGURE_MICRO "m/s"};

    return unit_for(size, names);
}

struct figure_unit figure_unit_of(const char *unit, double size)
{
    if (strcmp(unit, "m") == 0) {
        return figure_unit_of_length(size);
    }
    return strcmp(unit, "m/s") == 0 ? figure_unit_of_speed(size) : (struct figure_unit){1.0, unit};
}

double figure_tics(double height)
{
    const double decade = height > 0.0 ? pow(10.0, floor(log10(height / 4.0))) : 1.0;
    const double rough = height / 4.0 / decade;

    return decade * (rough > 5.0 ? 10.0 : (rough > 2.0 ? 5.0 : (rough > 1.0 ? 2.0 : 1.0)));
}

bool figure_is_possible(void) { return system("command -v gnuplot >/dev/null 2>&1") == 0; }

static const char *clean(const char *text, char *out, size_t size, const char *unwanted)
{
    size_t i = 0;

    for (; text[i] != '\0' && i + 1 < size; i++) {
        const bool is_control = (unsigned char)text[i] < ' ';
        out[i] = is_control || strchr(unwanted, text[i]) != NULL ? ' ' : text[i];
    }
    out[i] = '\0';
    return out;
}

const char *figure_plain(const char *text, char *out, size_t size) { return clean(text, out, size, "\"\\`{}^_@&~$%"); }
const char *figure_label(const char *text, char *out, size_t size) { return clean(text, out, size, "'\"\\`{}^_@&~$%"); }

FILE *figure_open(void)
{
    (void)fflush(NULL);
    return popen("gnuplot", "w");
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

static void file_name(char out[PATH_SIZE], const char *path, bool is_svg)
{
    (void)snprintf(out, PATH_SIZE, "%s.%s", path, is_svg ? "svg" : "png");
}

void figure_start(FILE *script, const char *path, bool is_svg)
{
    char file[PATH_SIZE];

    file_name(file, path, is_svg);
    (void)fprintf(
        script,
        "reset\nset encoding utf8\nset terminal %s size 1200,900 font 'Helvetica,%d' enhanced background 'white'\n",
        is_svg ? "svg" : "pngcairo", is_svg ? 20 : 18);
    (void)fputs("set output ", script);
    path_write(script, file);
    (void)fputs("\nset border 3 lc rgb '#606060'\nset tics nomirror out\nset grid lc rgb '#ececec' lt 1\n"
                "set key at graph 1,1.005 right bottom horizontal maxrows 1 samplen 2\nset lmargin 12\nset tmargin "
                "5.5\nset rmargin 4\n",
                script);
}

bool figure_close(FILE *script, const char *path)
{
    bool is_drawn = pclose(script) == 0;

    for (int i = 0; i < 2 && is_drawn; i++) {
        char file[PATH_SIZE];
        struct stat status;
        file_name(file, path, i == 0);
        is_drawn = stat(file, &status) == 0 && status.st_size > 0;
    }
    return is_drawn;
}
