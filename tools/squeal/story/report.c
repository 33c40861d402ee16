/* The record of a run as JSON. What the device says is passed on field by field; the dimensionless groups are derived
 * by the model's own code from the parameters that the device lists. */
#include "squeal/story/report.h"

#include "squeal/support/fields.h"
#include "squeal/support/json.h"

#include <string.h>

/* As a number where it is one. A word of hexadecimal digits only looks like a number now and then, so what is called a
 * hash or a build stays a string. */
static void value_write(FILE *file, const char *key, const char *text, size_t length)
{
    const bool is_name = strstr(key, "hash") == key || strstr(key, "build") == key || strstr(key, "version") == key;

    if (is_name) {
        json_write_part(file, text, length);
    } else {
        json_write_value(file, text, length);
    }
}

/* The key=value fields of a line as a JSON object. */
static void fields_write(FILE *file, const char *line)
{
    bool is_first = true;

    (void)fputc('{', file);
    for (const char *word = line; *word != '\0';) {
        const size_t length = strcspn(word, " ");
        const char *sign = memchr(word, '=', length);
        if (sign != NULL) {
            const size_t key_length = (size_t)(sign - word);
            (void)fputs(is_first ? "" : ", ", file);
            json_write_part(file, word, key_length);
            (void)fputs(": ", file);
            value_write(file, word, sign + 1, length - key_length - 1);
            is_first = false;
        }
        word += length;
        word += strspn(word, " ");
    }
    (void)fputc('}', file);
}

/* Reads "<symbol> = <value> <unit> ..." of list. Lengths are those of symbol and value; false if the line is no such.
 */
static bool parameter_cut(const char *line, size_t *symbol, const char **value, size_t *value_length)
{
    *symbol = strcspn(line, " \n");
    if (strncmp(line + *symbol, " = ", 3) != 0) {
        return false;
    }
    *value = line + *symbol + 3;
    *value_length = strcspn(*value, " \n");
    return true;
}

static void parameters_write(FILE *file, const char *lines)
{
    bool is_first = true;

    (void)fputc('{', file);
    for (const char *line = lines; line != NULL && *line != '\0';) {
        size_t symbol, length;
        const char *value;
        if (parameter_cut(line, &symbol, &value, &length)) {
            (void)fputs(is_first ? "" : ", ", file);
            json_write_part(file, line, symbol);
            (void)fputs(": ", file);
            value_write(file, "", value, length);
            is_first = false;
        }
        line = strchr(line, '\n');
        line = line == NULL ? NULL : line + 1;
    }
    (void)fputc('}', file);
}

/* The dimensionless groups of the paper, which status carries among its counters. */
static void groups_write(FILE *file, const char *status)
{
    static const char *const groups[] = {"C", "Z2", "eps", "mu", "V0"};
    char value[32];

    for (size_t i = 0; i < sizeof groups / sizeof groups[0]; i++) {
        if (!fields_text(status, groups[i], value, sizeof value)) {
            (void)strcpy(value, "nan");
        }
        (void)fprintf(file, "%s\"%s\": ", i == 0 ? "{" : ", ", groups[i]);
        value_write(file, groups[i], value, strlen(value));
    }
    (void)fputc('}', file);
}

/* The title alone: the device says "act <number>: <title>", and the number is a field of its own. */
static const char *title_of(const struct act *act)
{
    char start[32];
    const int length = snprintf(start, sizeof start, "act %d: ", act->number);

    return strncmp(act->title, start, (size_t)length) == 0 ? act->title + length : act->title;
}

static void act_write(FILE *file, const struct act *act)
{
    const char *title = title_of(act);

    (void)fprintf(file, "    {\"act\": %d, \"title\": ", act->number);
    json_write_string(file, title);
    (void)fprintf(file, ", \"complete\": %s,\n     \"parameters_si\": ", act->is_done ? "true" : "false");
    parameters_write(file, act->parameters);
    (void)fputs(",\n     \"groups\": ", file);
    groups_write(file, act->status);
    (void)fputs(",\n     \"verdict\": ", file);
    fields_write(file, act->verdict);
    (void)fputs(",\n     \"status\": ", file);
    fields_write(file, act->status);
    (void)fprintf(file, ",\n     \"samples\": %zu, \"steps_a_sample\": %.0f, \"samples_missing\": %.0f", act->count,
                  act->every, act->missing);
    (void)fputs(", \"hash_before\": ", file);
    value_write(file, "hash", act->first_hash, strlen(act->first_hash));
    (void)fputc('}', file);
}

static void rule_write(FILE *file, const char *name, const struct map_rule *rule)
{
    (void)fprintf(file, ",\n    \"%s\": {\"agree\": %zu, \"differ\": %zu}", name, rule->agree, rule->differ);
}

static void map_record(FILE *file, const struct map *map)
{
    const struct map_counts counts = map_count(map);

    (void)fputs("{\"preset\": ", file);
    json_write_string(file, map_plan.preset);
    (void)fputs(", \"command\": ", file);
    json_write_string(file, map->command);
    (void)fprintf(file, ", \"complete\": %s,\n    \"axes\": [", map->is_whole ? "true" : "false");
    for (int i = 0; i < MAP_AXES; i++) {
        const struct map_axis *axis = &map_plan.axes[i];
        (void)fprintf(file, "%s{\"symbol\": \"%s\", \"unit\": \"%s\", \"from\": %g, \"to\": %g, \"points\": %zu}",
                      i > 0 ? ", " : "", axis->symbol, axis->unit, axis->from, axis->to, map->side);
    }
    (void)fprintf(file, "], \"transient_periods\": %d,\n    \"points\": %zu, \"points_missing\": %zu",
                  map_plan.transient_periods, map->came, map_missing(map));
    (void)fprintf(file, ", \"quiet\": %zu, \"watch\": %zu, \"squeal\": %zu, \"unknown\": %zu, \"refused\": %zu",
                  counts.by_propensity[PROPENSITY_QUIET], counts.by_propensity[PROPENSITY_WATCH],
                  counts.by_propensity[PROPENSITY_SQUEAL], counts.by_propensity[PROPENSITY_UNKNOWN], counts.refused);
    (void)fputs(",\n    \"counted_by_the_device\": ", file);
    fields_write(file, map->answer);
    rule_write(file, "alpha_N_above_c", &counts.line);
    rule_write(file, "predictor", &counts.predictor);
    (void)fprintf(file, ",\n    \"wall_s\": %.3f, \"wall_s_a_point\": ", map->wall_s);
    (void)fprintf(file, map->came > 0 ? "%.5f" : "null", map->wall_s / (double)map->came);
    (void)fputs(",\n    \"parameters_si\": ", file);
    parameters_write(file, map->parameters);
    (void)fputs(",\n    \"status\": ", file);
    fields_write(file, map->status);
    (void)fputc('}', file);
}

void report_write(struct story *story)
{
    char path[STORY_PATH_SIZE], problem[CSV_PROBLEM_MAX];
    FILE *file = csv_create(story_path(story, path, "run.json"), problem);

    if (file == NULL) {
        story_fail(story, "%s", problem);
        return;
    }
    (void)fputs("{\n  \"firmware\": ", file);
    fields_write(file, story->id);
    (void)fputs(",\n  \"board\": ", file);
    json_write_string(file, story->board);
    (void)fputs(",\n  \"emulator\": ", file);
    if (story->emulator[0] == '\0') {
        (void)fputs("null", file);
    } else {
        json_write_string(file, story->emulator);
    }
    (void)fputs(",\n  \"seed\": null,\n  \"acts\": [\n", file);
    for (size_t i = 0; i < story->act_count; i++) {
        act_write(file, &story->acts[i]);
        (void)fputs(i + 1 < story->act_count ? ",\n" : "\n", file);
    }
    (void)fputs("  ],\n  \"map\": ", file);
    if (story->map.points == NULL) {
        (void)fputs("null", file);
    } else {
        map_record(file, &story->map);
    }
    (void)fputs("\n}\n", file);
    if (!csv_close(file, path, problem)) {
        story_fail(story, "%s", problem);
        return;
    }
    story_wrote(story, path, "parameters, versions, verdicts, counters");
}
