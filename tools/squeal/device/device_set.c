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

enum device_result device_set(struct device *device, const struct device_value *values, size_t count, bool may_reset,
                              struct device_commit *commit)
{
    struct device_commit unread;
    uint32_t crc = 0;
    enum device_result result = device_read_table(device, DEVICE_PARAMS); /* for the words of a refusal */

    result = result == DEVICE_OK ? revert(device, &crc) : result;
    for (size_t i = 0; i < count && result == DEVICE_OK; i++) {
        result = stage(device, &values[i], &crc);
    }
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
