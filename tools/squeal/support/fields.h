/* Reads the key=value fields of an answer line, such as "ok measure periods=20 step=1280 x=-0.16". */
#ifndef SQUEAL_FIELDS_H
#define SQUEAL_FIELDS_H

#include <stdbool.h>
#include <stddef.h>

/* Copies the value of the field named key, 0-terminated and cut to size. Returns false, with an empty out, where the
 * line has no such field. */
bool fields_text(const char *line, const char *key, char *out, size_t size);

/* The field as a number; NaN where it is missing, "nan" or no number. */
double fields_number(const char *line, const char *key);

/* Reads all of text as one number; false for anything else, an empty text included. nan counts as a number. */
bool fields_parse(const char *text, double *value);

/* Adds a line to a growing text on the heap, with LF before it unless it is the first. Out of memory the text stays as
 * it was. */
void fields_append_line(char **text, const char *line);

#endif
