/* What an experiment leaves: files, and the lines of its record. */
#include "squeal/paper/lab_parts.h"

#include "squeal/paper/record.h"
#include "squeal/plot/figure.h"

#include <math.h>
#include <stdarg.h>
#include <string.h>

enum { TEXT_SIZE = 4096, WORD_SIZE = 64 };

/* --- The reference ------------------------------------------------------------------------------------------------ */

const char *lab_reference_text(struct lab *lab, const char *name, const char *column)
{
    const struct csv *table = lab->options->reference;
    const int names = csv_column(table, "case"), wanted = csv_column(table, column);
    size_t row = 0;

    while (row < table->rows && strcmp(csv_cell(table, row, names), name) != 0) {
        row++;
    }
    if (row == table->rows || wanted < 0) {
        lab_fail(lab, "the reference table has no %s", wanted < 0 ? column : name);
    }
    return csv_cell(table, row, wanted);
}

double lab_reference(struct lab *lab, const char *name, const char *column)
{
    const char *text = lab_reference_text(lab, name, column);
    double value;

    return sscanf(text, "%lf", &value) == 1 ? value : (double)NAN;
}

/* --- Files -------------------------------------------------------------------------------------------------------- */

static void path_make(struct lab *lab, char path[PAPER_PATH_MAX], const char *name, const char *suffix)
{
    (void)snprintf(path, PAPER_PATH_MAX, "%s/%s%s", lab->options->out, name, suffix);
}

FILE *lab_csv_open(struct lab *lab, const char *name, const char *header)
{
    char path[PAPER_PATH_MAX], problem[CSV_PROBLEM_MAX];

    path_make(lab, path, name, ".csv");
    FILE *file = csv_create(path, problem);
    if (file == NULL) {
        lab_fail(lab, "%s", problem);
    }
    (void)fprintf(file, "%s\n", header);
    return file;
}

void lab_csv_close(struct lab *lab, FILE *file, const char *name)
{
    char path[PAPER_PATH_MAX], problem[CSV_PROBLEM_MAX];

    path_make(lab, path, name, ".csv");
    if (!csv_close(file, path, problem)) {
        lab_fail(lab, "%s", problem);
    }
    record_write(lab->record, RECORD_DATA, name, NULL);
}

void lab_csv_tracks(struct lab *lab, const char *name, const struct lab_track *tracks, size_t count)
{
    FILE *file = lab_csv_open(lab, name, "# every sample as the device sent it");

    (void)fputs("step,t[s]", file);
    for (size_t i = 0; i < tracks->columns; i++) {
        (void)fprintf(file, strcmp(tracks->unit[i], "1") == 0 ? ",%s" : ",%s[%s]", tracks->name[i], tracks->unit[i]);
    }
    for (const struct lab_track *track = tracks; track < tracks + count; track++) {
        for (size_t row = 0; row < track->count; row++) {
            (void)fprintf(file, "\n%llu,%.9g", (unsigned long long)track->step[row], track->t_s[row]);
            for (size_t i = 0; i < track->columns; i++) {
                (void)fprintf(file, ",%.9g", track->value[i][row]);
            }
        }
    }
    (void)fputc('\n', file);
    lab_csv_close(lab, file, name);
}

FILE *lab_figure_open(struct lab *lab)
{
    FILE *script = figure_open();

    if (script == NULL) {
        lab_fail(lab, "gnuplot cannot be started");
    }
    return script;
}

void lab_figure_block(FILE *script, const char *block, const struct lab_track *track, size_t across, size_t up)
{
    (void)fprintf(script, "$%s << END\n", block);
    for (size_t i = 0; i < track->count; i++) {
        (void)fprintf(script, "%.6g %.6g\n", track->value[across][i], track->value[up][i]);
    }
    (void)fputs("END\n", script);
}

void lab_figure_close(struct lab *lab, FILE *script, const char *name, const char *caption, const char *commands)
{
    char path[PAPER_PATH_MAX];

    path_make(lab, path, name, "");
    for (int i = 0; i < 2; i++) {
        figure_start(script, path, i == 0);
        (void)fprintf(script, "%s\n", commands);
    }
    if (!figure_close(script, path)) {
        lab_fail(lab, "gnuplot could not draw %s", path);
    }
    record_write(lab->record, RECORD_FIGURE, name, caption, NULL);
}

/* --- The record --------------------------------------------------------------------------------------------------- */

void lab_note(struct lab *lab, const char *format, ...)
{
    char text[TEXT_SIZE];
    va_list values;

    va_start(values, format);
    (void)vsnprintf(text, sizeof text, format, values);
    va_end(values);
    record_write(lab->record, RECORD_NOTE, text, NULL);
}

static void number_format(char out[WORD_SIZE], const char *format, double value)
{
    (void)snprintf(out, WORD_SIZE, isnan(value) ? "-" : format, value);
}

void lab_number(struct lab *lab, const char *subject, const char *quantity, double value, const char *unit)
{
    char text[WORD_SIZE];

    number_format(text, "%.6g", value);
    record_write(lab->record, RECORD_NUMBER, subject, quantity, text, unit, "", "", "", NULL);
}

void lab_compare(struct lab *lab, const char *subject, const char *quantity, double value, const char *unit,
                 double reference, double tolerance)
{
    char text[WORD_SIZE], expected[WORD_SIZE], within[WORD_SIZE];
    const bool agrees = fabs(value - reference) <= tolerance || (isnan(value) && isnan(reference));

    number_format(text, "%.6g", value);
    number_format(expected, "%.6g", reference);
    number_format(within, "%.2g", tolerance);
    record_write(lab->record, RECORD_NUMBER, subject, quantity, text, unit, expected, within, agrees ? "agrees" : "OFF",
                 NULL);
}

void lab_compare_words(struct lab *lab, const char *subject, const char *quantity, const char *words,
                       const char *reference)
{
    record_write(lab->record, RECORD_NUMBER, subject, quantity, words, "", reference, "",
                 strcmp(words, reference) == 0 ? "agrees" : "OFF", NULL);
}

void lab_claim(struct lab *lab, const char *id, enum paper_verdict verdict, const char *figure, const char *measured,
               ...)
{
    const size_t place = paper_claim_find(id);
    char text[TEXT_SIZE], number[WORD_SIZE], word[WORD_SIZE];
    va_list values;

    if (place == paper_claim_count) {
        lab_fail(lab, "claims.def has no %s", id);
    }
    va_start(values, measured);
    (void)vsnprintf(text, sizeof text, measured, values);
    va_end(values);
    (void)snprintf(number, sizeof number, "%zu", place);
    (void)snprintf(word, sizeof word, "%d", (int)verdict);
    record_write(lab->record, RECORD_CLAIM, number, word, figure, text, NULL);
}
