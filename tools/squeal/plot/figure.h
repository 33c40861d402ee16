/* Pictures drawn by gnuplot, which is asked for nothing but lines: every number comes from the caller. Each picture is
 * made twice, as SVG and as PNG:
 *
 *     FILE *script = figure_open();
 *     write the data
 *     for (int i = 0; i < 2; i++) {
 *         figure_start(script, "build/run/phase", i == 0);
 *         write what is to be plotted
 *     }
 *     if (!figure_close(script, "build/run/phase")) ...
 */
#ifndef SQUEAL_FIGURE_H
#define SQUEAL_FIGURE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#define FIGURE_COLOUR_PATH "#b8c4d0"
#define FIGURE_COLOUR_MOTION "#1f4e79"
#define FIGURE_COLOUR_DISC "#b5651d"
#define FIGURE_COLOUR_WATCH "#fff4d6"
#define FIGURE_COLOUR_SQUEAL "#f9dede"

/* In UTF-8. A letter of a symbol font would be read as another one where that font is missing: mm for micrometres. */
#define FIGURE_MICRO "\302\265"
#define FIGURE_ALPHA "\316\261"

/* A unit that makes a quantity readable. */
struct figure_unit {
    double factor;
    const char *name;
};

/* The unit for quantities up to this size in SI. */
struct figure_unit figure_unit_of_length(double size);
struct figure_unit figure_unit_of_speed(double size);

/* The same by the unit in SI; one that is neither of these stays as it is. */
struct figure_unit figure_unit_of(const char *unit, double size);

/* A round distance of tics for a low picture of this height: about four of them. */
double figure_tics(double height);

/* Is gnuplot at hand? */
bool figure_is_possible(void);

/* Starts gnuplot; NULL if that fails. */
FILE *figure_open(void);

/* Begins the picture in one of its two formats, with the look that all share. The path lacks its .svg or .png. */
void figure_start(FILE *script, const char *path, bool is_svg);

/* Ends gnuplot. Are both formats there? */
bool figure_close(FILE *script, const char *path);

/* The text as gnuplot may print it, from wherever it comes: the marks of its enhanced text, and what could end the
 * quotes around it, become blanks; in single quotes it must be a label. */
const char *figure_plain(const char *text, char *out, size_t size);
const char *figure_label(const char *text, char *out, size_t size);

#endif
