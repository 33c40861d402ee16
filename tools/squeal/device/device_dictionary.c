/* The device's own tables, and what its refusals mean in their words. */
#include "squeal/device/device_parts.h"

#include "base/decimal.h"
#include "model/params.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LIKE_MAX = 5, LIKE_SIZE = 160 };

static enum device_result read_row(struct device *device, enum device_table table, size_t index, struct device_row *row)
{
    uint8_t bytes[2];
    struct bytes_writer request = {.bytes = bytes, .capacity = sizeof bytes};
    struct bytes_reader reply;

    bytes_put_u8(&request, (uint8_t)table);
    bytes_put_u8(&request, (uint8_t)index);
    const enum device_result result = device_ask(device, LINK_DICTIONARY, &request, &reply);
    if (result != DEVICE_OK) {
        return result;
    }
    (void)bytes_get_block(&reply, 2); /* table, index */
    device->counts[table] = bytes_get_u8(&reply);
    row->id = bytes_get_u16(&reply);
    row->kind = bytes_get_u8(&reply);
    row->change = bytes_get_u8(&reply);
    row->standard = bytes_get_f32(&reply);
    row->low = bytes_get_f32(&reply);
    row->high = bytes_get_f32(&reply);
    device_get_text(&reply, row->symbol, LINK_SYMBOL_WIDTH);
    device_get_text(&reply, row->unit, LINK_UNIT_WIDTH);
    device_get_text(&reply, row->help, LINK_HELP_WIDTH);
    return DEVICE_OK;
}

/* HELLO does not count the rows of a table that came later: its first one does, and where there is none the table is
 * empty. */
static enum device_result count_rows(struct device *device, enum device_table table)
{
    struct device_row row;
    const enum device_result result = table == DEVICE_SELFTESTS ? read_row(device, table, 0, &row) : DEVICE_OK;

    return result == DEVICE_REFUSED ? DEVICE_OK : result;
}

static enum device_result read_one_table(struct device *device, enum device_table table)
{
    if (device->tables[table] != NULL) {
        return DEVICE_OK;
    }
    enum device_result result = count_rows(device, table);
    struct device_row *rows = calloc(device->counts[table] + 1, sizeof *rows);
    if (rows == NULL) {
        device_fail(device, "out of memory");
        return DEVICE_LOST;
    }
    for (size_t i = 0, count = device->counts[table]; i < count && result == DEVICE_OK; i++) {
        result = read_row(device, table, i, &rows[i]);
    }
    if (result == DEVICE_OK) {
        device->tables[table] = rows;
    } else {
        free(rows);
    }
    return result;
}

enum device_result device_read_table(struct device *device, enum device_table table)
{
    enum device_result result = DEVICE_OK;

    if (table != DEVICE_TABLES) {
        return read_one_table(device, table);
    }
    for (int i = 0; i < LINK_TABLE_COUNT && result == DEVICE_OK; i++) {
        result = read_one_table(device, (enum device_table)i);
    }
    return result;
}

size_t device_count(struct device *device, enum device_table table)
{
    return read_one_table(device, table) == DEVICE_OK ? device->counts[table] : 0;
}

const struct device_row *device_row(struct device *device, enum device_table table, size_t index)
{
    return index < device_count(device, table) ? &device->tables[table][index] : NULL;
}

/* Letters in which the two begin alike, but for upper and lower case. */
static size_t common_length(const char *a, const char *b)
{
    size_t length = 0;

    while (a[length] != '\0' && (a[length] | 0x20) == (b[length] | 0x20)) {
        length++;
    }
    return length;
}

static bool is_like(const char *symbol, const char *text)
{
    const size_t common = common_length(symbol, text);

    return common >= 2 ||
           (common == 1 && (symbol[1] == '\0' || text[1] == '\0') && strlen(symbol) + strlen(text) < 4) ||
           strstr(symbol, text) != NULL;
}

static void fail_unknown(struct device *device, enum device_table table, const char *symbol)
{
    static const char *const names[] = {"parameter", "signal", "preset", "self-test"};
    char like[LIKE_SIZE] = "", shown[LIKE_SIZE];
    size_t length = 0;

    for (size_t i = 0, count = 0; i < device->counts[table] && count < LIKE_MAX && length < sizeof like; i++) {
        if (is_like(device->tables[table][i].symbol, symbol)) {
            length += (size_t)snprintf(like + length, sizeof like - length, " %s", device->tables[table][i].symbol);
            count++;
        }
    }
    device_fail(device, like[0] != '\0' ? "no %s is called '%s'; there is%s" : "no %s is called '%s'; list shows all%s",
                names[table], printable_copy(shown, sizeof shown, symbol), like);
}

int device_find(struct device *device, enum device_table table, const char *symbol)
{
    const size_t count = device_count(device, table);

    if (device->tables[table] == NULL) {
        return -1;
    }
    for (size_t i = 0; i < count; i++) {
        if (strcmp(device->tables[table][i].symbol, symbol) == 0) {
            return (int)i;
        }
    }
    fail_unknown(device, table, symbol);
    return -1;
}

/* The start of a choice's name and its length, 0 beyond the last. */
static const char *choice_name(const struct device_row *row, unsigned index, size_t *length)
{
    const char *name = row->unit;

    for (; index > 0 && *name != '\0'; index--) {
        name += strcspn(name, "|");
        name += *name == '|' ? 1 : 0;
    }
    *length = strcspn(name, "|");
    return name;
}

static bool choice_parse(const struct device_row *row, const char *text, float *value)
{
    size_t length;

    for (unsigned i = 0; *choice_name(row, i, &length) != '\0'; i++) {
        if (length == strlen(text) && strncmp(choice_name(row, i, &length), text, length) == 0) {
            *value = (float)i;
            return true;
        }
    }
    return false;
}

bool device_parse(struct device *device, size_t param, const char *text, float *value)
{
    const struct device_row *row = device_row(device, DEVICE_PARAMS, param);
    char shown[DEVICE_TEXT_MAX], low[DEVICE_TEXT_MAX], high[DEVICE_TEXT_MAX];
    float parsed;

    if (row == NULL) {
        return false;
    }
    (void)printable_copy(shown, sizeof shown, text);
    if (row->kind == LINK_CHOICE) {
        if (choice_parse(row, text, value)) {
            return true;
        }
        device_fail(device, "%s=%s: one of %s is wanted", row->symbol, shown, row->unit);
        return false;
    }
    if (decimal_parse_f32(text, strlen(text), &parsed) && parsed >= row->low && parsed <= row->high &&
        (row->kind != LINK_WHOLE || parsed == floorf(parsed))) {
        *value = parsed;
        return true;
    }
    device_format(row, row->low, low);
    device_format(row, row->high, high);
    device_fail(device, "%s=%s: a %s of %s .. %s%s%s is wanted", row->symbol, shown,
                row->kind == LINK_WHOLE ? "whole number" : "number", low, high, row->unit[0] == '1' ? "" : " ",
                row->unit[0] == '1' ? "" : row->unit);
    return false;
}

void device_format(const struct device_row *row, float value, char out[DEVICE_TEXT_MAX])
{
    size_t length = 0;

    if (row->kind == LINK_CHOICE && value >= 0.0f && value < 256.0f) {
        const char *name = choice_name(row, (unsigned)value, &length);
        (void)snprintf(out, DEVICE_TEXT_MAX, "%.*s", (int)length, name);
    }
    if (length == 0) {
        (void)decimal_format_shortest(value, out);
    }
}

static const struct {
    const char *name, *text;
} errors[] = {
#define ERROR(number, field, name, sentence) [number] = {name, sentence},
#include "base/errors.def"
#undef ERROR
};

static bool is_known(unsigned error) { return error < sizeof errors / sizeof errors[0] && errors[error].name != NULL; }

const char *device_error_name(unsigned error) { return is_known(error) ? errors[error].name : "unknown-error"; }

/* What a refusal blames. */
static void blame_write(struct device *device, char *out, size_t size)
{
    const struct master_refusal *refusal = &device->refusal;
    const bool is_param = refusal->type == LINK_STAGE || refusal->type == LINK_COMMIT || refusal->type == LINK_PRESET;
    const struct device_row *params = device->tables[LINK_PARAMS];

    out[0] = '\0';
    if (is_param && params != NULL && refusal->index < device->counts[LINK_PARAMS]) {
        (void)snprintf(out, size, "%s: ", params[refusal->index].symbol);
    }
}

void device_tell_refusal(struct device *device)
{
    const struct master_refusal *refusal = &device->refusal;
    char blame[DEVICE_TEXT(LINK_SYMBOL_WIDTH) + 2], low[DECIMAL_SIZE_MAX], high[DECIMAL_SIZE_MAX];
    const bool has_range = refusal->error == ERROR_OUT_OF_RANGE || refusal->error == ERROR_OUT_OF_SCALE;

    blame_write(device, blame, sizeof blame);
    if (!is_known(refusal->error)) {
        device_fail(device, "%srefused with error %u, which is not known here", blame, refusal->error);
        return;
    }
    (void)decimal_format_shortest(refusal->low, low);
    (void)decimal_format_shortest(refusal->high, high);
    device_fail(device, has_range ? "%s%s: %s: %s .. %s" : "%s%s: %s", blame, errors[refusal->error].name,
                errors[refusal->error].text, low, high);
}
