/* Error against steps per period: ours, the naive method and a smoothed sign, in double, single precision and fixed
 * point.
 *
 *   converge --out FOLDER     writes converge.csv and converge.gp there, and prints the table */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "walk.h"

enum { STEPS_FIRST = 16, STEPS_LAST = 4096, STEPS_LAST_FIRMWARE = 1024, STEPS_COUNT = 9 };

static const struct walk_case cases[] = {{"slip", "N = 1 N: slips on", 1.0, -0.002},
                                         {"stick", "N = 10 N: sticks and slips", 10.0, -0.002},
                                         {"cross", "N = 5 N: sticks, slips and overtakes the disc", 5.0, -0.002},
                                         {"tori", "N = 1 N, alpha = -0.1 s/m: never repeats", 1.0, -0.1}};

enum { CASE_COUNT = sizeof cases / sizeof cases[0] };

/* A row of the table. A textbook method has no arith. */
static const struct method {
    const char *name, *title;
    enum walk_textbook textbook;
    const char *arith, *normal, *scheme;
} methods[] = {
    {"event-double", "events located, double", WALK_EVENT, NULL, NULL, NULL},
    {"naive-double", "raw sign, double", WALK_NAIVE, NULL, NULL, NULL},
    {"tanh-double", "tanh(vr/(v0/100)), double", WALK_TANH, NULL, NULL, NULL},
    {"f32", "firmware, f32", WALK_EVENT, "f32", "rk4", "event"},
    {"q27", "firmware, q27", WALK_EVENT, "q27", "rk4", "event"},
    {"f32-exact", "firmware, f32, normal exact", WALK_EVENT, "f32", "exact", "event"},
    {"f32-naive", "firmware, f32, method naive", WALK_EVENT, "f32", "rk4", "naive"},
};

enum { METHOD_COUNT = sizeof methods / sizeof methods[0] };

/* NaN where there is none: the firmware takes up to 1024 steps. */
static double error_of(const struct walk_case *which, const struct method *method, long steps, const struct walk *truth)
{
    static struct walk walk;

    if (method->arith == NULL) {
        walk_textbook(which, method->textbook, steps, &walk);
    } else if (steps > STEPS_LAST_FIRMWARE ||
               !walk_firmware(which, method->arith, method->normal, method->scheme, steps, &walk)) {
        return (double)NAN;
    }
    return walk_error(&walk, truth);
}

static double errors[METHOD_COUNT][STEPS_COUNT];

static void print_row(const struct method *method, const double *row)
{
    /* From 64 to 256 steps, where the method rules and not yet the rounding. */
    const double order = log2(row[2] / row[4]) / 2.0;

    printf("%-28s", method->title);
    for (int i = 0; i < STEPS_COUNT; i++) {
        printf(isnan(row[i]) ? "        -" : "  %7.1e", row[i]);
    }
    printf("  %5.2f\n", order);
}

static bool run_case(const struct walk_case *which, FILE *csv)
{
    static struct walk truth;

    if (!walk_reference(which, &truth)) {
        fprintf(stderr, "converge: %s: the reference solver gave up\n", which->name);
        return false;
    }
    printf("\n%s\n%-28s", which->title, "steps a period");
    for (int i = 0; i < STEPS_COUNT; i++) {
        printf("  %7d", STEPS_FIRST << i);
    }
    printf("  order\n");
    for (int m = 0; m < METHOD_COUNT; m++) {
        for (int i = 0; i < STEPS_COUNT; i++) {
            errors[m][i] = error_of(which, &methods[m], STEPS_FIRST << i, &truth);
        }
        print_row(&methods[m], errors[m]);
    }
    for (int i = 0; i < STEPS_COUNT; i++) {
        fprintf(csv, "%s,%d", which->name, STEPS_FIRST << i);
        for (int m = 0; m < METHOD_COUNT; m++) {
            fprintf(csv, isnan(errors[m][i]) ? ",nan" : ",%.4e", errors[m][i]);
        }
        fprintf(csv, "\n");
    }
    fprintf(csv, "\n\n"); /* gnuplot counts its blocks by these */
    return true;
}

static void write_script(FILE *script, const char *folder)
{
    static const char *const styles[METHOD_COUNT] = {
        "lc rgb '#1f4e79' pt 7", "lc rgb '#b03a2e' pt 5 dt 2", "lc rgb '#b5651d' pt 9 dt 2", "lc rgb '#2e86c1' pt 6",
        "lc rgb '#1e8449' pt 4", "lc rgb '#7fb3d5' pt 12",     "lc rgb '#e6a09a' pt 10"};

    for (int is_svg = 0; is_svg < 2; is_svg++) {
        fprintf(script,
                "reset\nset terminal %s\nset output '%s/converge.%s'\nset datafile separator ','\n"
                "set multiplot layout 2,2 title 'Error after up to 20 periods, over the largest |x|, against steps per "
                "period'\n"
                "set logscale xy\nset format y '10^{%%T}'\nset xrange [12:5500]\nset yrange [1e-14:10]\nset grid\n"
                "set xtics (16, 32, 64, 128, 256, 512, 1024, 2048, 4096) font ',10'\n"
                "set xlabel 'steps per normal period'\nset ylabel 'error / max |x|'\n",
                is_svg ? "svg size 1400,1000 font 'sans,13' background rgb 'white'"
                       : "pngcairo size 1400,1000 font 'sans,13'",
                folder, is_svg ? "svg" : "png");
        for (int c = 0; c < CASE_COUNT; c++) {
            fprintf(script, "set title '%s'\nset key %s\nplot ", cases[c].title,
                    c == 0 ? "bottom left font ',10' opaque" : "off");
            for (int m = 0; m < METHOD_COUNT; m++) {
                fprintf(script, "'%s/converge.csv' index %d using 2:%d with linespoints lw 2 %s title '%s', ", folder,
                        c, m + 3, styles[m], methods[m].title);
            }
            fprintf(script, "2.0*x**-4 with lines lc rgb '#999999' dt 3 title 'fourth order'\n");
        }
        fprintf(script, "unset multiplot\n");
    }
}

static FILE *create(const char *folder, const char *name)
{
    char path[512];
    FILE *file;

    (void)snprintf(path, sizeof path, "%s/%s", folder, name);
    file = fopen(path, "w");
    if (file == NULL) {
        perror(path);
    }
    return file;
}

int main(int argc, char **argv)
{
    FILE *csv, *script;
    bool is_good = true;

    if (argc != 3 || strcmp(argv[1], "--out") != 0) {
        fprintf(stderr, "usage: converge --out FOLDER\n");
        return 2;
    }
    csv = create(argv[2], "converge.csv");
    script = csv != NULL ? create(argv[2], "converge.gp") : NULL;
    if (script == NULL) {
        return 1;
    }
    fprintf(csv, "# case,steps");
    for (int m = 0; m < METHOD_COUNT; m++) {
        fprintf(csv, ",%s", methods[m].name);
    }
    fprintf(csv, "\n");
    for (int c = 0; c < CASE_COUNT; c++) {
        is_good = run_case(&cases[c], csv) && is_good;
    }
    write_script(script, argv[2]);
    return fclose(csv) == 0 && fclose(script) == 0 && is_good ? 0 : 1;
}
