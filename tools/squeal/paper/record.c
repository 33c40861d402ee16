/* A line an item: the kind's number, then its fields, tabs between. */
#include "squeal/paper/record.h"

#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

void record_write(FILE *file, enum record_kind kind, ...)
{
    va_list fields;

    (void)fprintf(file, "%d", (int)kind);
    va_start(fields, kind);
    for (const char *field; (field = va_arg(fields, const char *)) != NULL;) {
        (void)fputc('\t', file);
        for (; *field != '\0'; field++) {
            (void)fputc(*field == '\t' || *field == '\n' ? ' ' : *field, file);
        }
    }
    va_end(fields);
    (void)fputc('\n', file);
    (void)fflush(file); /* what is there stays there, however the process ends */
}

/* Cuts a line into the item's fields. */
static void item_read(struct record_item *item, char *line)
{
    static char none[] = "";
    char *at = strchr(line, '\t');

    item->kind = (enum record_kind)atoi(line);
    for (size_t i = 0; i < RECORD_FIELDS_MAX; i++) {
        item->field[i] = at != NULL ? at + 1 : none;
        at = at != NULL ? strchr(at + 1, '\t') : NULL;
        if (at != NULL) {
            *at = '\0';
        }
    }
}

static char *text_read(FILE *file)
{
    const long size = fseek(file, 0, SEEK_END) == 0 ? ftell(file) : -1;
    char *text = size >= 0 ? calloc((size_t)size + 1, 1) : NULL;

    rewind(file);
    if (text != NULL && fread(text, 1, (size_t)size, file) != (size_t)size) {
        free(text);
        return NULL;
    }
    return text;
}

bool record_read(struct record *record, FILE *file)
{
    size_t lines = 0;

    *record = (struct record){.text = text_read(file)};
    for (const char *at = record->text; at != NULL && (at = strchr(at, '\n')) != NULL; at++) {
        lines++;
    }
    record->items = calloc(lines + 1, sizeof *record->items);
    if (record->text == NULL || record->items == NULL) {
        record_free(record);
        return false;
    }
    for (char *at = record->text; record->count < lines; record->count++) {
        char *end = strchr(at, '\n');
        *end = '\0';
        item_read(&record->items[record->count], at);
        at = end + 1;
    }
    return true;
}

void record_free(struct record *record)
{
    free(record->text);
    free(record->items);
    *record = (struct record){0};
}
