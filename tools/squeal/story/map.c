/* The conversation of the map, and what becomes of each of its points. */
#include "squeal/story/map.h"

#include "squeal/story/play.h"
#include "squeal/story/tell.h"
#include "squeal/support/children.h"
#include "squeal/support/fields.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The border |alpha| N = c of the preset crosses this rectangle from its top to its right side. With MAP_SIDE points
 * along an axis they are 250 N and 0.006 s/m apart, and none lies on the border itself, where nothing ever settles. */
const struct map_plan map_plan = {
    .preset = "brake",
    .axes = {{"N1", "N", 650.0, 5400.0}, {"alpha", "s/m", -0.12, -0.006}},
    .transient_periods = 1000,
};

/* The point of this line, put at its place; false if it is none of this map or came before. */
static bool point_take(struct map *map, const char *line)
{
    const double done = fields_number(line, "done");
    const size_t total = map->side * map->side;
    struct map_point point = {0};
    char text[32];

    if (!(done >= 1.0 && done <= (double)total)) {
        return false;
    }
    const size_t place = (size_t)done - 1;
    const bool is_here = fields_number(line, "i") == (double)(place % map->side) &&
                         fields_number(line, "j") == (double)(place / map->side);
    if (!is_here || map->points[place].line != NULL) {
        return false;
    }
    for (int i = 0; i < MAP_AXES; i++) {
        point.at[i] = fields_number(line, map_plan.axes[i].symbol);
        if (isnan(point.at[i])) {
            return false;
        }
    }
    point.is_refused = fields_text(line, "error", text, sizeof text);
    if (!point.is_refused) {
        if (!fields_text(line, "predicted", text, sizeof text) || !record_propensity(text, &point.predicted) ||
            !fields_text(line, "propensity", text, sizeof text) || !record_propensity(text, &point.propensity)) {
            return false;
        }
        point.is_growing = fields_text(line, "class", text, sizeof text) && strcmp(text, "growing") == 0;
        point.amplitude_um = fields_number(line, "amplitude_um");
    }
    point.line = malloc(strlen(line) + 1);
    if (point.line != NULL) {
        (void)strcpy(point.line, line);
        map->points[place] = point;
    }
    return point.line != NULL;
}

void map_listen(struct map *map, enum session_line kind, const char *text)
{
    if (kind != SESSION_BODY) {
        return;
    }
    if (strncmp(text, "point ", 6) != 0) {
        fields_append_line(&map->parameters, text);
    } else if (point_take(map, text + 6)) {
        map->came++;
        progress_show(&map->progress, map->came);
    } else {
        map->unreadable++;
    }
}

size_t map_missing(const struct map *map) { return map->side * map->side - map->came; }

/* What |alpha| N = c says of a point. */
static enum detector_propensity line_propensity(const struct map *map, const struct map_point *point)
{
    const bool is_above = -point->at[MAP_SLOPE] * point->at[MAP_FORCE] > map->damping_n_s_per_m;

    return is_above ? PROPENSITY_SQUEAL : PROPENSITY_QUIET;
}

static bool is_decided(enum detector_propensity propensity)
{
    return propensity == PROPENSITY_SQUEAL || propensity == PROPENSITY_QUIET;
}

/* Holds a point against a rule; where one of them says neither squeal nor quiet there is nothing to hold. */
static void rule_count(struct map_rule *rule, enum detector_propensity found, enum detector_propensity said)
{
    if (is_decided(found) && is_decided(said)) {
        rule->agree += found == said ? 1U : 0U;
        rule->differ += found != said ? 1U : 0U;
    }
}

static void point_count(const struct map *map, const struct map_point *point, struct map_counts *counts)
{

    if (point->is_refused) {
        counts->refused++;
        return;
    }
    counts->by_propensity[point->propensity]++;
    counts->growing += point->is_growing ? 1U : 0U;
    if (point->propensity == PROPENSITY_SQUEAL && !point->is_growing) {
        counts->least_um = fmin(counts->least_um, point->amplitude_um);
        counts->most_um = fmax(counts->most_um, point->amplitude_um);
    }
    rule_count(&counts->line, point->propensity, line_propensity(map, point));
    rule_count(&counts->predictor, point->propensity, point->predicted);
}

struct map_counts map_count(const struct map *map)
{
    struct map_counts counts = {.least_um = (double)NAN, .most_um = (double)NAN};

    for (size_t i = 0; map->points != NULL && i < map->side * map->side; i++) {
        if (map->points[i].line != NULL) {
            point_count(map, &map->points[i], &counts);
        }
    }
    return counts;
}

/* The set to vary: the preset, in the number format that the board starts with, which a preset would change. */
static bool set_load(struct story *story)
{
    struct map *map = &story->map;
    char line[SESSION_COMMAND_MAX], arith[16];

    (void)snprintf(line, sizeof line, "preset %s", map_plan.preset);
    if (!play_must(story, line)) {
        return false;
    }
    if (fields_text(story->id, "arith", arith, sizeof arith)) {
        (void)snprintf(line, sizeof line, "set arith %s", arith);
        if (!play_must(story, line)) {
            return false;
        }
    }
    if (!play_must(story, "get c")) {
        return false;
    }
    map->damping_n_s_per_m = fields_number(story->session.answer, "c");
    if (!play_must(story, "status")) {
        return false;
    }
    (void)strcpy(map->status, story->session.answer);
    return play_must(story, "list");
}

/* The device counted its trials too: where its counts are not ours, a line was lost or damaged. */
static void counts_check(struct story *story)
{
    static const char *const keys[] = {"unknown", "quiet", "watch", "squeal"};
    struct map *map = &story->map;
    const struct map_counts counts = map_count(map);
    bool is_same = fields_number(map->answer, "trials") == (double)map->came &&
                   fields_number(map->answer, "refused") == (double)counts.refused;

    for (int i = 0; i < (int)(sizeof keys / sizeof keys[0]); i++) {
        is_same = is_same && fields_number(map->answer, keys[i]) == (double)counts.by_propensity[i];
    }
    if (map->unreadable > 0) {
        story_fail(story, "the map: %zu %s no point of it", map->unreadable,
                   map->unreadable == 1 ? "line is" : "lines are");
    }
    if (map_missing(map) > 0) {
        story_fail(story, "the map: %zu of %zu points never came", map_missing(map), map->side * map->side);
    } else if (!is_same) {
        story_fail(story, "the map: its points are not those that the device counted: %s", map->answer);
    } else {
        map->is_whole = map->unreadable == 0;
    }
}

static void map_ask(struct story *story)
{
    struct map *map = &story->map;
    const struct map_axis *axes = map_plan.axes;

    (void)snprintf(map->command, sizeof map->command, "scan %s %g %g %zu %s %g %g %zu transient %d", axes[0].symbol,
                   axes[0].from, axes[0].to, map->side, axes[1].symbol, axes[1].from, axes[1].to, map->side,
                   map_plan.transient_periods);
    progress_start(&map->progress, map->side * map->side, "points");
    story->session.is_patient = true;
    story->session.is_unwanted = children_is_interrupted;
    children_hold_interrupt(true);
    const enum session_result result = session_command(&story->session, story->limit_s, "%s", map->command);
    children_hold_interrupt(false);
    story->session.is_patient = false;
    story->session.is_unwanted = NULL;
    map->wall_s = progress_end(&map->progress);
    if (result == SESSION_OK) {
        (void)strcpy(map->answer, story->session.answer);
        counts_check(story);
    } else if (result == SESSION_LOST) {
        story_fail(story, "the map: %s", story->session.failure);
    } else if (strncmp(story->session.answer, "error stopped", 13) == 0) {
        (void)strcpy(map->answer, story->session.answer);
        story_fail(story, "the map was cut short: %zu of %zu points", map->came, map->side * map->side);
    } else {
        story_fail(story, "'%s' was answered: %s", map->command, story->session.answer);
    }
}

void map_play(struct story *story)
{
    struct map *map = &story->map;

    map->points = calloc(map->side * map->side, sizeof *map->points);
    if (map->points == NULL) {
        story_fail(story, "out of memory for the map");
        return;
    }
    map->is_open = true;
    if (set_load(story)) {
        tell_map_start(story);
        map_ask(story);
        tell_map(story);
    }
    map->is_open = false;
}

void map_free(struct map *map)
{
    for (size_t i = 0; map->points != NULL && i < map->side * map->side; i++) {
        free(map->points[i].line);
    }
    free(map->points);
    free(map->parameters);
}
