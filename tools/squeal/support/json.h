/* JSON: what the tool writes, and enough of reading to get it back. A value is a pointer to its first character inside
 * a text that json_read() has found whole; the values inside it are reached from there. */
#ifndef SQUEAL_JSON_H
#define SQUEAL_JSON_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#include "squeal/support/csv.h"

/* A text as a string. */
void json_write_string(FILE *file, const char *text);
void json_write_part(FILE *file, const char *text, size_t length);

/* A text that is a number as that, nan as null, anything else as a string. */
void json_write_value(FILE *file, const char *text, size_t length);

/* Reads a file that holds one value. NULL with the problem; else free() takes it back. */
char *json_read(const char *path, char problem[CSV_PROBLEM_MAX]);

/* The member of that name, NULL if there is none or the value is no object. */
const char *json_member(const char *object, const char *name);

/* The index-th of an array, NULL beyond the last; how many an array or object has, 0 of anything else. */
const char *json_element(const char *array, size_t index);
size_t json_count(const char *value);

/* A string's characters or a number's digits, cut to size; false, with an empty out, for anything else, and for
 * NULL. */
bool json_text(const char *value, char *out, size_t size);

#endif
