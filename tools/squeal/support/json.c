/* JSON. The reader recurses as deep as the text, up to a limit. */
#include "squeal/support/json.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

enum { DEPTH_MAX = 32 };

void json_write_part(FILE *file, const char *text, size_t length)
{
    (void)fputc('"', file);
    for (size_t i = 0; i < length; i++) {
        const unsigned char byte = (unsigned char)text[i];
        if (byte == '"' || byte == '\\') {
            (void)fputc('\\', file);
        }
        if (byte < ' ') {
            (void)fprintf(file, "\\u%04x", byte);
        } else {
            (void)fputc(byte, file);
        }
    }
    (void)fputc('"', file);
}

void json_write_string(FILE *file, const char *text) { json_write_part(file, text, strlen(text)); }

void json_write_value(FILE *file, const char *text, size_t length)
{
    const size_t digits = strspn(text, "0123456789+-.eE");
    const bool starts_well = isdigit((unsigned char)text[0]) || (text[0] == '-' && isdigit((unsigned char)text[1]));

    if (length == 3 && strncmp(text, "nan", 3) == 0) {
        (void)fputs("null", file);
    } else if (length > 0 && digits >= length && starts_well) {
        (void)fwrite(text, 1, length, file);
    } else {
        json_write_part(file, text, length);
    }
}

static const char *skip_blanks(const char *text) { return text + strspn(text, " \t\r\n"); }

/* Each of these returns what follows, or NULL if the text is no such. */
static const char *skip_string(const char *text)
{
    if (*text != '"') {
        return NULL;
    }
    for (text++; *text != '"'; text++) {
        if (*text == '\\') {
            text++;
        }
        if (*text == '\0') {
            return NULL;
        }
    }
    return text + 1;
}

static const char *skip_word(const char *text)
{
    static const char *const words[] = {"true", "false", "null"};

    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++) {
        if (strncmp(text, words[i], strlen(words[i])) == 0) {
            return text + strlen(words[i]);
        }
    }
    const size_t digits = strspn(text, "0123456789+-.eE");
    return digits > 0 ? text + digits : NULL;
}

static const char *skip_value(const char *text, int depth);

/* The value of the next member or element, whose name begins at *name for a member. NULL: what follows is no such. */
static const char *enter(const char *text, bool is_object, const char **name)
{
    text = skip_blanks(text);
    *name = text;
    if (!is_object) {
        return text;
    }
    text = skip_string(text);
    text = text != NULL ? skip_blanks(text) : NULL;
    return text != NULL && *text == ':' ? skip_blanks(text + 1) : NULL;
}

static const char *skip_container(const char *text, int depth)
{
    const bool is_object = *text == '{';
    const char end = is_object ? '}' : ']', *name;

    text = skip_blanks(text + 1);
    if (*text == end) {
        return text + 1;
    }
    for (;;) {
        const char *value = enter(text, is_object, &name);
        text = value != NULL ? skip_value(value, depth + 1) : NULL;
        text = text != NULL ? skip_blanks(text) : NULL;
        if (text == NULL || (*text != ',' && *text != end)) {
            return NULL;
        }
        text++;
        if (text[-1] == end) {
            return text;
        }
    }
}

static const char *skip_value(const char *text, int depth)
{
    if (depth > DEPTH_MAX) {
        return NULL;
    }
    if (*text == '{' || *text == '[') {
        return skip_container(text, depth);
    }
    return *text == '"' ? skip_string(text) : skip_word(text);
}

char *json_read(const char *path, char problem[CSV_PROBLEM_MAX])
{
    char *text = csv_read_text(path, problem);

    if (text == NULL) {
        return NULL;
    }
    const char *start = skip_blanks(text);
    const char *end = skip_value(start, 0);
    if (end == NULL || *skip_blanks(end) != '\0') {
        (void)snprintf(problem, CSV_PROBLEM_MAX, "%s: no JSON, or cut short", path);
        free(text);
        return NULL;
    }
    memmove(text, start, strlen(start) + 1);
    return text;
}

/* The index-th value of a container, or of an object the one called name where name is not NULL. */
static const char *find(const char *container, const char *wanted, size_t index)
{
    if (container == NULL || (*container != '{' && *container != '[')) {
        return NULL;
    }
    const char *text = skip_blanks(container + 1), *name;
    while (*text != '}' && *text != ']') {
        const char *value = enter(text, *container == '{', &name);
        if (wanted == NULL ? index-- == 0
                           : strncmp(name + 1, wanted, strlen(wanted)) == 0 && name[strlen(wanted) + 1] == '"') {
            return value;
        }
        text = skip_blanks(skip_value(value, 0));
        text = *text == ',' ? skip_blanks(text + 1) : text;
    }
    return NULL;
}

const char *json_member(const char *object, const char *name)
{
    return object != NULL && *object == '{' ? find(object, name, 0) : NULL;
}

const char *json_element(const char *array, size_t index)
{
    return array != NULL && *array == '[' ? find(array, NULL, index) : NULL;
}

size_t json_count(const char *value)
{
    size_t count = 0;

    while (find(value, NULL, count) != NULL) {
        count++;
    }
    return count;
}

bool json_text(const char *value, char *out, size_t size)
{
    size_t length = 0;

    out[0] = '\0';
    if (value == NULL || (*value != '"' && strchr("-0123456789", *value) == NULL)) {
        return false;
    }
    const char *end = skip_value(value, 0);
    const char *last = *value == '"' ? end - 1 : end;
    for (const char *at = *value == '"' ? value + 1 : value; at < last && length + 1 < size; at++) {
        at += *at == '\\' ? 1 : 0;
        out[length++] = *at;
    }
    out[length] = '\0';
    return true;
}
