/* The set: what is in force, and how to change it. */
#include "squeal/device/device_parts.h"

#include <string.h>

static enum device_result read_word(struct device *device, enum link_place place, int index, uint32_t *word)
{
    uint8_t bytes[2];
    struct bytes_writer request = {.bytes = bytes, .capacity = sizeof bytes};
    struct bytes_reader reply;

    bytes_put_u8(&request, (uint8_t)place);
    bytes_put_u8(&request, (uint8_t)index);
    const enum device_result result = device_ask(device, LINK_READ, &request, &reply);
    if (result == DEVICE_OK) {
        (void)bytes_get_block(&reply, 2);
        *word = bytes_get_u32(&reply);
    }
    return result;
}

static float float_of(uint32_t word)
{
    uint8_t bytes[4];
    struct bytes_writer writer = {.bytes = bytes, .capacity = sizeof bytes};
    struct bytes_reader reader = {.bytes = bytes, .size = sizeof bytes};

    bytes_put_u32(&writer, word);
    return bytes_get_f32(&reader);
}

enum device_result device_get(struct device *device, int param, float *value)
{
    uint32_t word;
    const enum device_result result = read_word(device, LINK_IN_FORCE, param, &word);

    if (result == DEVICE_OK) {
        *value = float_of(word);
    }
    return result;
}

double device_number(const struct device *device, int signal, uint32_t word)
{
    const struct device_row *rows = device->tables[LINK_SIGNALS];

    return rows != NULL && rows[signal].kind == LINK_BITS ? (double)word : (double)float_of(word);
}

enum device_result device_look(struct device *device, int signal, double *value)
{
    uint32_t word;
    enum device_result result = device_read_table(device, DEVICE_SIGNALS);

    result = result == DEVICE_OK ? read_word(device, LINK_NOW, signal, &word) : result;
    if (result == DEVICE_OK) {
        *value = device_number(device, signal, word);
    }
    return result;
}

static enum device_result stage(struct device *device, const struct device_value *value, uint32_t *crc)
{
    uint8_t bytes[5];
    struct bytes_writer request = {.bytes = bytes, .capacity = sizeof bytes};
    struct bytes_reader reply;

    bytes_put_u8(&request, (uint8_t)value->index);
    bytes_put_f32(&request, value->value);
    const enum device_result result = device_ask(device, LINK_STAGE, &request, &reply);
    if (result == DEVICE_OK) {
        (void)bytes_get_block(&reply, 5);
        *crc = bytes_get_u32(&reply);
    }
    return result;
}

static enum device_result ask_table(struct device *device, struct bytes_writer *request, struct bytes_reader *reply)
{
    while (request->size < LINK_TABLE_REQUEST) {
        bytes_put_u8(request, 0);
    }
    return device_ask(device, LINK_TABLE, request, reply);
}

static bool has_tables(const struct device *device) { return device_identity(device)->minor >= 2; }

enum device_result device_get_table(struct device *device, enum params_table_index index, struct params_points *table)
{
    enum device_result result = DEVICE_OK;
    uint32_t length = 1;

    memset(table, 0, sizeof *table);
    while (has_tables(device) && result == DEVICE_OK && table->count < length) {
        uint8_t bytes[LINK_TABLE_REQUEST];
        struct bytes_writer request = {.bytes = bytes, .capacity = sizeof bytes};
        struct bytes_reader reply;
        uint32_t count;
        bytes_put_u8(&request, LINK_TABLE_IN_FORCE);
        bytes_put_u8(&request, (uint8_t)index);
        bytes_put_u8(&request, (uint8_t)table->count);
        result = ask_table(device, &request, &reply);
        if (result != DEVICE_OK) {
            return result;
        }
        (void)bytes_get_block(&reply, 2);
        count = bytes_get_u8(&reply);
        length = bytes_get_u8(&reply);
        (void)bytes_get_u32(&reply);
        if ((count == 0 && length > table->count) || length > PARAMS_POINTS_MAX || table->count + count > length) {
            return DEVICE_LOST;
        }
        for (uint32_t i = 0; i < count; i++) {
            table->points[table->count].time_s = bytes_get_f32(&reply);
            table->points[table->count++].value = bytes_get_f32(&reply);
        }
    }
    return result;
}

/* One request at least: that of an empty table clears it. */
static enum device_result stage_table(struct device *device, enum params_table_index index,
                                      const struct params_points *table, uint32_t *crc)
{
    enum device_result result = DEVICE_OK;
    uint32_t first = 0;

    do {
        const uint32_t left = table->count - first;
        const uint32_t count = left < LINK_TABLE_PIECE ? left : LINK_TABLE_PIECE;
        uint8_t bytes[LINK_TABLE_REQUEST];
        struct bytes_writer request = {.bytes = bytes, .capacity = sizeof bytes};
        struct bytes_reader reply;
        bytes_put_u8(&request, LINK_TABLE_PUT);
        bytes_put_u8(&request, (uint8_t)index);
        bytes_put_u8(&request, (uint8_t)first);
        bytes_put_u8(&request, (uint8_t)count);
        for (uint32_t i = 0; i < count; i++) {
            bytes_put_f32(&request, table->points[first + i].time_s);
            bytes_put_f32(&request, table->points[first + i].value);
        }
        first += count;
        result = ask_table(device, &request, &reply);
        if (result == DEVICE_OK) {
            (void)bytes_get_block(&reply, 4);
            *crc = bytes_get_u32(&reply);
        }
    } while (result == DEVICE_OK && first < table->count);
    return result;
}

/* An older device has no tables, which are as good as empty ones. */
static enum device_result stage_tables(struct device *device, const struct device_tables *tables, uint32_t *crc)
{
    enum device_result result = DEVICE_OK;

    for (int i = 0; tables != NULL && i < PARAMS_TABLES && result == DEVICE_OK; i++) {
        const struct params_points *table = tables->table[i];
        if (table != NULL && (has_tables(device) || table->count > 0)) {
            result = stage_table(device, (enum params_table_index)i, table, crc);
        }
    }
    return result;
}

static enum device_result commit_staged(struct device *device, uint32_t crc, bool may_reset,
                                        struct device_commit *commit)
{
    uint8_t bytes[5];
    struct bytes_writer request = {.bytes = bytes, .capacity = sizeof bytes};
    struct bytes_reader reply;

    bytes_put_u32(&request, crc);
    bytes_put_u8(&request, may_reset ? 1u : 0u);
    const enum device_result result = device_ask(device, LINK_COMMIT, &request, &reply);
    if (result == DEVICE_OK) {
        commit->crc = bytes_get_u32(&reply);
        commit->was_reset = bytes_get_u8(&reply) != 0;
        commit->generation = bytes_get_u32(&reply);
        device->step = commit->was_reset ? 0 : device->step;
    }
    return result;
}

static enum device_result revert(struct device *device, uint32_t *crc)
{
    struct bytes_reader reply;
    const enum device_result result = device_ask(device, LINK_REVERT, NULL, &reply);

    if (result == DEVICE_OK) {
        *crc = bytes_get_u32(&reply);
    }
    return result;
}

enum device_result device_set(struct device *device, const struct device_value *values, size_t count,
                              const struct device_tables *tables, bool may_reset, struct device_commit *commit)
{
    struct device_commit unread;
    uint32_t crc = 0;
    enum device_result result = device_read_table(device, DEVICE_PARAMS); /* for the words of a refusal */

    result = result == DEVICE_OK ? revert(device, &crc) : result;
    for (size_t i = 0; i < count && result == DEVICE_OK; i++) {
        result = stage(device, &values[i], &crc);
    }
    result = result == DEVICE_OK ? stage_tables(device, tables, &crc) : result;
    if (result == DEVICE_OK) {
        result = commit_staged(device, crc, may_reset, commit != NULL ? commit : &unread);
    }
    if (result == DEVICE_REFUSED) {
        /* What was staged must not go into force with somebody's next change. */
        const struct master_refusal refusal = device->refusal;
        char problem[DEVICE_PROBLEM_MAX];
        memcpy(problem, device->problem, sizeof problem);
        if (revert(device, &crc) == DEVICE_LOST) {
            return DEVICE_LOST;
        }
        device->refusal = refusal;
        memcpy(device->problem, problem, sizeof problem);
    }
    return result;
}

enum device_result device_preset(struct device *device, int preset, struct device_commit *commit)
{
    uint8_t bytes[1] = {(uint8_t)preset};
    const struct bytes_writer request = {.bytes = bytes, .capacity = sizeof bytes, .size = sizeof bytes};
    struct bytes_reader reply;
    const enum device_result result = device_ask(device, LINK_PRESET, &request, &reply);

    if (result == DEVICE_OK) {
        device->step = 0;
        if (commit != NULL) {
            commit->crc = bytes_get_u32(&reply);
            commit->generation = bytes_get_u32(&reply);
            commit->was_reset = true;
        }
    }
    return result;
}
