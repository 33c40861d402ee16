/* map.csv. Its columns are the fields that the points have, in the order in which the device sends them. */
#include "squeal/story/story.h"

#include "squeal/support/csv.h"
#include "squeal/support/fields.h"

#include <string.h>

enum { COLUMNS_MAX = 32, KEY_SIZE = 40 };

struct columns {
    char keys[COLUMNS_MAX][KEY_SIZE];
    size_t count;
};

/* Ends of keys that name a unit. */
static const struct {
    const char *end, *unit;
} units[] = {{"_mm_s", "mm/s"}, {"_per_s", "1/s"}, {"_um", "um"}, {"_hz", "Hz"}};

static bool column_is_known(const struct columns *columns, const char *key)
{
    for (size_t i = 0; i < columns->count; i++) {
        if (strcmp(columns->keys[i], key) == 0) {
            return true;
        }
    }
    return false;
}

/* Adds the keys of a line that no line before it had. */
static void columns_add(struct columns *columns, const char *line)
{
    for (const char *word = line; *word != '\0';) {
        const size_t length = strcspn(word, " ");
        const size_t key = strcspn(word, "= ");
        if (key > 0 && key < length && key < KEY_SIZE && columns->count < COLUMNS_MAX) {
            memcpy(columns->keys[columns->count], word, key);
            columns->keys[columns->count][key] = '\0';
            columns->count += column_is_known(columns, columns->keys[columns->count]) ? 0U : 1U;
        }
        word += length;
        word += strspn(word, " ");
    }
}

static void heading_write(FILE *file, const char *key)
{
    const size_t length = strlen(key);

    for (int i = 0; i < MAP_AXES; i++) {
        if (strcmp(key, map_plan.axes[i].symbol) == 0) {
            (void)fprintf(file, "%s[%s]", key, map_plan.axes[i].unit);
            return;
        }
    }
    for (size_t i = 0; i < sizeof units / sizeof units[0]; i++) {
        const size_t end = strlen(units[i].end);
        if (length > end && strcmp(key + length - end, units[i].end) == 0) {
            (void)fprintf(file, "%.*s[%s]", (int)(length - end), key, units[i].unit);
            return;
        }
    }
    (void)fputs(key, file);
}

/* A cell is empty where the point has no such field. */
static void row_write(FILE *file, const struct columns *columns, const char *line)
{
    char cell[64];

    for (size_t i = 0; i < columns->count; i++) {
        (void)fields_text(line, columns->keys[i], cell, sizeof cell);
        (void)fprintf(file, "%s%s", i > 0 ? "," : "", cell);
    }
    (void)fputc('\n', file);
}

void map_forget(const struct story *story)
{
    static const char *const names[] = {"map.csv", "map.svg", "map.png"};
    char path[STORY_PATH_SIZE];

    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        (void)remove(story_path(story, path, names[i])); /* mostly there is none */
    }
}

void map_write(struct story *story)
{
    const struct map *map = &story->map;
    struct columns columns = {.count = 0};
    char path[STORY_PATH_SIZE], problem[CSV_PROBLEM_MAX];
    FILE *file = map->came > 0 ? csv_create(story_path(story, path, "map.csv"), problem) : NULL;

    if (map->came == 0) {
        return;
    }
    if (file == NULL) {
        story_fail(story, "%s", problem);
        return;
    }
    for (size_t i = 0; i < map->side * map->side; i++) {
        if (map->points[i].line != NULL) {
            columns_add(&columns, map->points[i].line);
        }
    }
    for (size_t i = 0; i < columns.count; i++) {
        (void)fputs(i > 0 ? "," : "", file);
        heading_write(file, columns.keys[i]);
    }
    (void)fputc('\n', file);
    for (size_t i = 0; i < map->side * map->side; i++) {
        if (map->points[i].line != NULL) {
            row_write(file, &columns, map->points[i].line);
        }
    }
    if (!csv_close(file, path, problem)) {
        story_fail(story, "%s", problem);
        return;
    }
    story_wrote(story, path, "the points of the map, every field");
}
