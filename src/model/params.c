/* The table of parameters and what can be done with one of its rows. */
#include "model/params.h"

#include "base/decimal.h"
#include "base/mem.h"

const struct params_info params_table[] = {
#define PARAM(id, field, symbol, unit, standard, low, high, change, help) \
    {id, offsetof(struct params, field), #field, #symbol, unit, help, standard, low, high, PARAMS_##change},
#include "model/params.def"
#undef PARAM
};

static const struct params_problem no_problem = {ERROR_OK, NULL, 0.0f, 0.0f};

const size_t params_count = sizeof params_table / sizeof params_table[0];

void params_default(struct params *params)
{
#define PARAM(id, field, symbol, unit, standard, low, high, change, help) params->field = standard;
#include "model/params.def"
#undef PARAM
    memset(params->tables, 0, sizeof params->tables);
}

static bool is_named(const char *known, const char *name, size_t length)
{
    size_t i = 0u;

    while (i < length && known[i] != '\0' && known[i] == name[i]) {
        i++;
    }
    return i == length && known[i] == '\0';
}

const struct params_info *params_find(const char *name, size_t length)
{
    for (const struct params_info *info = params_table; info < params_table + params_count; info++) {
        if (is_named(info->symbol, name, length) || is_named(info->field, name, length)) {
            return info;
        }
    }
    return NULL;
}

float params_value(const struct params *params, const struct params_info *info)
{
    float value;

    memcpy(&value, (const char *)params + info->offset, sizeof value);
    return value;
}

void params_set(struct params *params, const struct params_info *info, float value)
{
    memcpy((char *)params + info->offset, &value, sizeof value);
}

bool params_is_choice(const struct params_info *info)
{
    for (const char *c = info->unit; *c != '\0'; c++) {
        if (*c == '|') {
            return true;
        }
    }
    return false;
}

const char *params_choice_name(const struct params_info *info, unsigned index, size_t *length)
{
    const char *name = info->unit;

    for (; index > 0u; index--) {
        while (*name != '|') {
            if (*name == '\0') {
                return NULL;
            }
            name++;
        }
        name++;
    }
    *length = 0u;
    while (name[*length] != '\0' && name[*length] != '|') {
        (*length)++;
    }
    return name;
}

static enum error parse_choice(const struct params_info *info, const char *text, size_t length, float *value)
{
    const char *name;
    size_t name_length = 0u;

    for (unsigned i = 0u; (name = params_choice_name(info, i, &name_length)) != NULL; i++) {
        if (name_length == length && memcmp(name, text, length) == 0) {
            *value = (float)i;
            return ERROR_OK;
        }
    }
    return ERROR_OUT_OF_RANGE;
}

enum error params_parse(const struct params_info *info, const char *text, size_t length, float *value)
{
    if (params_is_choice(info)) {
        return parse_choice(info, text, length, value);
    }
    return decimal_parse_f32(text, length, value) ? ERROR_OK : ERROR_BAD_NUMBER;
}

bool params_is_whole(const struct params_info *info)
{
    const char *unit = info->unit;

    while (*unit != '\0' && *unit != ',') {
        unit++;
    }
    return params_is_choice(info) || is_named(info->unit, "count", 5u) || is_named(unit, ", whole", 7u);
}

bool params_accepts(const struct params_info *info, float value)
{
    /* Asks "is it inside?", so that NaN, which is neither below nor above, is refused. */
    return value >= info->low && value <= info->high && (!params_is_whole(info) || (float)(int32_t)value == value);
}

struct params_problem params_blame(enum error error, const char *symbol, float low, float high)
{
    size_t length = 0u;

    while (symbol[length] != '\0') {
        length++;
    }
    return (struct params_problem){error, params_find(symbol, length), low, high};
}

const struct params_info *params_table_values(enum params_table_index index)
{
    return index == PARAMS_TABLE_LOAD ? params_find("N0", 2u) : params_find("v0", 2u);
}

float params_table_end_s(const struct params_points *table)
{
    return table->count > 0u ? table->points[table->count - 1u].time_s : 0.0f;
}

struct params_problem params_check_point(enum params_table_index index, float end_s, const struct params_point *point)
{
    const struct params_info *info = params_table_values(index);

    if (!(point->time_s >= end_s && point->time_s <= PARAMS_TIME_MAX)) {
        return params_blame(ERROR_OUT_OF_RANGE, index == PARAMS_TABLE_LOAD ? "t1" : "tv1", end_s, PARAMS_TIME_MAX);
    }
    if (!params_accepts(info, point->value)) {
        return (struct params_problem){ERROR_OUT_OF_RANGE, info, info->low, info->high};
    }
    return no_problem;
}

/* As if its points came one after the other. */
static struct params_problem check_table(const struct params *params, enum params_table_index index)
{
    const struct params_points *table = &params->tables[index];
    struct params_problem problem = no_problem;
    float end_s = 0.0f;

    if (table->count > PARAMS_POINTS_MAX) {
        return params_blame(ERROR_TABLE_FULL, index == PARAMS_TABLE_LOAD ? "load" : "speed", 0.0f, 0.0f);
    }
    for (uint32_t i = 0u; i < table->count && problem.error == ERROR_OK; i++) {
        problem = params_check_point(index, end_s, &table->points[i]);
        end_s = table->points[i].time_s;
    }
    return problem;
}

struct params_problem params_check(const struct params *params)
{
    struct params_problem problem = no_problem;

    for (const struct params_info *info = params_table; info < params_table + params_count; info++) {
        if (!params_accepts(info, params_value(params, info))) {
            problem = (struct params_problem){ERROR_OUT_OF_RANGE, info, info->low, info->high};
            return problem;
        }
    }
    problem = check_table(params, PARAMS_TABLE_LOAD);
    return problem.error != ERROR_OK ? problem : check_table(params, PARAMS_TABLE_SPEED);
}

const struct params_info *params_restart_change(const struct params *from, const struct params *to)
{
    for (const struct params_info *info = params_table; info < params_table + params_count; info++) {
        if (info->change == PARAMS_RESTART && params_value(from, info) != params_value(to, info)) {
            return info;
        }
    }
    return NULL;
}
