/* The tables of breakpoints over the link, a piece at a time. */
#include "base/mem.h"
#include "protocol/link_parts.h"

enum { FIELD_ACT, FIELD_TABLE, FIELD_FIRST, FIELD_COUNT, FIELD_POINTS }; /* of the request */

static enum link_progress tell(struct link *link, const struct params *params, uint8_t index, uint8_t first)
{
    const struct params_points *table = &params->tables[index];
    const uint32_t left = table->count - first;
    const uint32_t count = left < LINK_TABLE_PIECE ? left : LINK_TABLE_PIECE;

    bytes_put_u8(&link->reply, index);
    bytes_put_u8(&link->reply, first);
    bytes_put_u8(&link->reply, (uint8_t)count);
    bytes_put_u8(&link->reply, (uint8_t)table->count);
    bytes_put_u32(&link->reply, link_crc(link_staged(link)));
    for (uint32_t i = 0u; i < LINK_TABLE_PIECE; i++) {
        const struct params_point point = i < count ? table->points[first + i] : (struct params_point){0.0f, 0.0f};

        bytes_put_f32(&link->reply, point.time_s);
        bytes_put_f32(&link->reply, point.value);
    }
    return link_answer(link);
}

/* So many points behind the first of the table's, in place of all that came there; or which field is wrong. */
static struct params_problem put(struct link *link, uint8_t index, uint8_t first, uint8_t count, uint8_t *field)
{
    struct params_points table = link_staged(link)->tables[index];
    struct params_problem problem = {ERROR_OK, NULL, 0.0f, 0.0f};

    memset(&table.points[first], 0, (PARAMS_POINTS_MAX - first) * sizeof table.points[0]);
    table.count = first;
    for (uint8_t i = 0u; i < count && problem.error == ERROR_OK; i++) {
        struct params_point point;

        point.time_s = bytes_get_f32(&link->arguments);
        point.value = bytes_get_f32(&link->arguments);
        problem = params_check_point(index, params_table_end_s(&table), &point);
        *field = (uint8_t)(FIELD_POINTS + 2u * i + (problem.info == params_table_values(index) ? 1u : 0u));
        table.points[table.count++] = point;
    }
    if (problem.error == ERROR_OK) {
        link_staged(link)->tables[index] = table;
    }
    return problem;
}

enum link_progress link_table(struct link *link)
{
    const uint8_t act = bytes_get_u8(&link->arguments);
    const uint8_t index = bytes_get_u8(&link->arguments);
    const uint8_t first = bytes_get_u8(&link->arguments);
    const uint8_t count = bytes_get_u8(&link->arguments);
    const struct params *params = act == LINK_TABLE_IN_FORCE ? executive_params(link->executive) : link_staged(link);
    struct params_problem problem;
    uint8_t field = FIELD_POINTS;

    if (act >= LINK_TABLE_ACTS) {
        return link_refuse_field(link, FIELD_ACT, 0.0f, (float)(LINK_TABLE_ACTS - 1));
    }
    if (index >= PARAMS_TABLES) {
        return link_refuse_field(link, FIELD_TABLE, 0.0f, (float)(PARAMS_TABLES - 1));
    }
    if (first > params->tables[index].count) {
        return link_refuse_field(link, FIELD_FIRST, 0.0f, (float)params->tables[index].count);
    }
    if (act != LINK_TABLE_PUT) {
        return tell(link, params, index, first);
    }
    if (count > LINK_TABLE_PIECE || first + count > PARAMS_POINTS_MAX) {
        const uint32_t room = (uint32_t)PARAMS_POINTS_MAX - first;

        return link_refuse_field(link, FIELD_COUNT, 0.0f, (float)(room < LINK_TABLE_PIECE ? room : LINK_TABLE_PIECE));
    }
    problem = put(link, index, first, count, &field);
    return problem.error == ERROR_OK ? tell(link, link_staged(link), index, first)
                                     : link_refuse_field(link, field, problem.low, problem.high);
}
