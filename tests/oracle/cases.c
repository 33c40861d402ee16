/* Reading and writing by the one list of columns. */
#include "cases.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static int split(char *text, char **cell)
{
    int count = 0;

    text[strcspn(text, "\r\n")] = '\0';
    for (char *next = text; next != NULL && count < CASES_COLUMNS_MAX; count++) {
        cell[count] = next;
        next = strchr(next, ',');
        if (next != NULL) {
            *next = '\0';
            next++;
        }
    }
    return count;
}

static int find(const struct cases_header *header, const char *name)
{
    for (int i = 0; i < header->count; i++) {
        if (strcmp(header->name[i], name) == 0) {
            return i;
        }
    }
    return -1;
}

const char *cases_read_header(FILE *file, struct cases_header *header)
{
    static const char *const needed[] = {
        "case",
#define INPUT(field, name) #name,
#define OUTPUT(name)
#include "columns.def"
#undef INPUT
#undef OUTPUT
    };

    if (fgets(header->text, sizeof header->text, file) == NULL) {
        return "no header line";
    }
    header->count = split(header->text, header->name);
    for (size_t i = 0; i < sizeof needed / sizeof *needed; i++) {
        if (find(header, needed[i]) < 0) {
            return needed[i];
        }
    }
    return NULL;
}

/* Not a number where the column is absent or empty. */
static double number(const struct cases_header *header, const struct cases_row *row, const char *name)
{
    const int column = find(header, name);
    char *end = NULL;
    double value;

    if (column < 0 || *row->cell[column] == '\0') {
        return (double)NAN;
    }
    value = strtod(row->cell[column], &end);
    return *end == '\0' ? value : (double)NAN;
}

static bool is_choice(double value, double most) { return value >= 0.0 && value <= most && floor(value) >= value; }

static const char *check(const struct cases_row *row)
{
    const struct plant *plant = &row->plant;

#define INPUT(field, name)         \
    if (!isfinite(plant->field)) { \
        return #name;              \
    }
#define OUTPUT(name)
#include "columns.def"
#undef INPUT
#undef OUTPUT
    if (!(plant->mass_kg > 0.0) || !(plant->normal_n_per_m > 0.0) || !(plant_stiffness_n_per_m(plant) >= 0.0)) {
        return "m, ke or kt + k";
    }
    if (!is_choice(plant->load_kind, LOAD_SINE) || !is_choice(plant->contact_kind, CONTACT_LIFT)) {
        return "ntype or contact";
    }
    if (plant->load_kind == LOAD_RAMP && plant->load_end_s < plant->load_start_s) {
        return "t2";
    }
    if (row->span.transient < 0.0 || row->span.transient > 1e7) {
        return "ntrans";
    }
    return row->span.window < 1.0 || row->span.window > 1e5 ? "nwin" : NULL;
}

const char *cases_read_row(FILE *file, const struct cases_header *header, struct cases_row *row)
{
    if (fgets(row->text, sizeof row->text, file) == NULL) {
        return "";
    }
    if (split(row->text, row->cell) < header->count) {
        return "too few cells";
    }
#define INPUT(field, name) row->plant.field = number(header, row, #name);
#define OUTPUT(name)
#include "columns.def"
#undef INPUT
#undef OUTPUT
    row->span.transient = number(header, row, "ntrans");
    row->span.window = number(header, row, "nwin");
    return check(row);
}

void cases_write_header(FILE *file)
{
#define INPUT(field, name) "," #name
#define OUTPUT(name) "," #name
    fputs("case"
#include "columns.def"
          ",class\n",
          file);
#undef INPUT
#undef OUTPUT
}

static void write_number(FILE *file, double value)
{
    if (isnan(value)) {
        fputs(",nan", file);
    } else {
        fprintf(file, ",%.9g", value);
    }
}

void cases_write_row(FILE *file, const struct cases_header *header, const struct cases_row *row,
                     const struct result *result)
{
    fputs(row->cell[find(header, "case")], file);
#define INPUT(field, name) fprintf(file, ",%s", row->cell[find(header, #name)]);
#define OUTPUT(name) write_number(file, result->name);
#include "columns.def"
#undef INPUT
#undef OUTPUT
    fprintf(file, ",%s\n", result->name);
}
