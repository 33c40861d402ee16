/* The fields of an answer line. A key counts only at the start of a word, so "x" is never found inside "xmax". */
#include "squeal/support/fields.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { FIELD_SIZE_MAX = 128 };

bool fields_text(const char *line, const char *key, char *out, size_t size)
{
    const size_t key_length = strlen(key);
    const char *word = line;

    out[0] = '\0';
    while (*word != '\0') {
        const size_t length = strcspn(word, " ");
        if (length > key_length && strncmp(word, key, key_length) == 0 && word[key_length] == '=') {
            size_t count = length - key_length - 1;
            if (count >= size) {
                count = size - 1;
            }
            memcpy(out, word + key_length + 1, count);
            out[count] = '\0';
            return true;
        }
        word += length;
        word += strspn(word, " ");
    }
    return false;
}

bool fields_parse(const char *text, double *value)
{
    char *end = NULL;
    const double number = strtod(text, &end);

    if (end == text || *end != '\0') {
        return false;
    }
    *value = number;
    return true;
}

double fields_number(const char *line, const char *key)
{
    char text[FIELD_SIZE_MAX];
    double value = (double)NAN;

    if (!fields_text(line, key, text, sizeof text) || !fields_parse(text, &value)) {
        return (double)NAN;
    }
    return value;
}

void fields_append_line(char **text, const char *line)
{
    const size_t used = *text == NULL ? 0 : strlen(*text);
    char *longer = realloc(*text, used + strlen(line) + 2);

    if (longer != NULL) {
        (void)sprintf(longer + used, "%s%s", used > 0 ? "\n" : "", line);
        *text = longer;
    }
}
