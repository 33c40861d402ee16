/* The set: one parameter at a time into a staged set, which goes into force as a whole. */
#include "base/crc32.h"
#include "base/mem.h"
#include "model/presets.h"
#include "protocol/link_parts.h"

static uint32_t add_f32(uint32_t crc, float value)
{
    uint8_t bytes[4];
    struct bytes_writer writer = {.bytes = bytes, .capacity = sizeof bytes};

    bytes_put_f32(&writer, value);
    return crc32_add(crc, bytes, sizeof bytes);
}

static uint32_t add_table(uint32_t crc, const struct params_points *table)
{
    const uint8_t count = (uint8_t)table->count;

    crc = crc32_add(crc, &count, sizeof count);
    for (uint32_t i = 0u; i < table->count; i++) {
        crc = add_f32(add_f32(crc, table->points[i].time_s), table->points[i].value);
    }
    return crc;
}

uint32_t link_crc(const struct params *params)
{
    uint32_t crc = 0u;

    for (size_t i = 0u; i < params_count; i++) {
        crc = add_f32(crc, params_value(params, &params_table[i]));
    }
    return add_table(add_table(crc, &params->tables[PARAMS_TABLE_LOAD]), &params->tables[PARAMS_TABLE_SPEED]);
}

struct params *link_staged(struct link *link)
{
    const struct params *in_force = executive_params(link->executive);

    if (memcmp(&link->in_force, in_force, sizeof link->in_force) != 0) {
        link->in_force = *in_force;
        link->staged = *in_force;
    }
    return &link->staged;
}

enum link_progress link_stage(struct link *link)
{
    const uint8_t index = bytes_get_u8(&link->arguments);
    const float value = bytes_get_f32(&link->arguments);
    struct params *staged = link_staged(link);
    const struct params_info *info;

    if (index >= params_count) {
        return link_refuse(link,
                           &(struct link_refusal){.error = ERROR_UNKNOWN_NAME, .high = (float)(params_count - 1u)});
    }
    info = &params_table[index];
    if (!params_accepts(info, value)) {
        return link_refuse_problem(link, &(struct params_problem){ERROR_OUT_OF_RANGE, info, info->low, info->high});
    }
    params_set(staged, info, value);
    bytes_put_u8(&link->reply, index);
    bytes_put_f32(&link->reply, value);
    bytes_put_u32(&link->reply, link_crc(staged));
    return link_answer(link);
}

enum link_progress link_revert(struct link *link)
{
    link->staged = *executive_params(link->executive);
    link->in_force = link->staged;
    bytes_put_u32(&link->reply, link_crc(&link->staged));
    return link_answer(link);
}

static uint32_t generation(const struct link *link)
{
    struct executive_report report;

    executive_report(link->executive, &report);
    return report.generation;
}

static bool is_in_fault(const struct link *link)
{
    struct executive_report report;

    executive_report(link->executive, &report);
    return report.now.is_fault != 0u;
}

/* The order has been taken. */
static enum link_progress answer_commit(struct link *link)
{
    bytes_put_u32(&link->reply, link_crc(executive_params(link->executive)));
    bytes_put_u8(&link->reply, link->was_reset ? 1u : 0u);
    bytes_put_u32(&link->reply, generation(link));
    return link_answer(link);
}

enum link_progress link_commit(struct link *link)
{
    const uint32_t crc = bytes_get_u32(&link->arguments);
    const uint8_t may_reset = bytes_get_u8(&link->arguments);
    const struct params *staged = link_staged(link);
    struct params_problem problem;

    if (link->phase != 0u) {
        return answer_commit(link);
    }
    if (crc != link_crc(staged)) {
        return link_refuse(link, &(struct link_refusal){.error = ERROR_WRONG_CRC, .expected = link_crc(staged)});
    }
    if (may_reset > 1u) {
        return link_refuse(link, &(struct link_refusal){.error = ERROR_OUT_OF_RANGE, .high = 1.0f});
    }
    if (is_in_fault(link)) {
        return link_refuse_plain(link, ERROR_IN_FAULT);
    }
    if (!turn_take(link->turn, TURN_LINK)) {
        return link_refuse_plain(link, ERROR_BUSY);
    }
    problem = executive_change(link->executive, staged, may_reset != 0u, &link->was_reset);
    if (problem.error != ERROR_OK) {
        return link_refuse_problem(link, &problem);
    }
    link->phase = 1u;
    return LINK_ADVANCES;
}

/* Stops and resets to a set: the order, or the problem. */
static enum link_progress restart(struct link *link, const struct params *params)
{
    struct params_problem problem;

    if (!turn_take(link->turn, TURN_LINK)) {
        return link_refuse_plain(link, ERROR_BUSY);
    }
    problem = executive_reset(link->executive, params);
    if (problem.error != ERROR_OK) {
        return link_refuse_problem(link, &problem);
    }
    link->phase = 1u;
    return LINK_ADVANCES;
}

enum link_progress link_preset(struct link *link)
{
    const uint8_t index = bytes_get_u8(&link->arguments);
    struct params params;

    if (link->phase != 0u) {
        bytes_put_u32(&link->reply, link_crc(executive_params(link->executive)));
        bytes_put_u32(&link->reply, generation(link));
        return link_answer(link);
    }
    if (index >= presets_count) {
        return link_refuse(link,
                           &(struct link_refusal){.error = ERROR_UNKNOWN_NAME, .high = (float)(presets_count - 1u)});
    }
    presets_load(&presets_table[index], &params);
    params.arithmetic = link->executive->arithmetic;
    return restart(link, &params);
}

enum link_progress link_reset(struct link *link)
{
    const struct params params = *executive_params(link->executive);

    if (link->phase != 0u) {
        bytes_put_u64(&link->reply, 0u);
        return link_answer(link);
    }
    return restart(link, &params);
}
