/* The map of the story: the device tries one set over a grid of brake force and friction slope, and says of each point
 * whether it squeals. */
#ifndef SQUEAL_MAP_H
#define SQUEAL_MAP_H

#include <stdbool.h>
#include <stddef.h>

#include "squeal/console/session.h"
#include "squeal/story/record.h"
#include "squeal/support/progress.h"

struct story;

enum { MAP_SIDE = 20, MAP_SIDE_MAX = 256 }; /* points along an axis: unless told otherwise, and that the device takes */
enum { MAP_FORCE, MAP_SLOPE, MAP_AXES };

/* What is walked along; the same number of points on each. */
struct map_axis {
    const char *symbol, *unit;
    double from, to;
};

/* What is asked for. */
struct map_plan {
    const char *preset;
    struct map_axis axes[MAP_AXES];
    int transient_periods; /* normal periods that a trial may take to settle */
};
extern const struct map_plan map_plan;

struct map_point {
    char *line; /* its fields as the device sent them; NULL if it never came */
    double at[MAP_AXES];
    enum detector_propensity propensity, predicted;
    bool is_refused; /* a set that the model cannot hold: nothing is known of it but its place */
    bool is_growing; /* at its end, so that its amplitude says little */
    double amplitude_um;
};

struct map {
    size_t side;              /* points along an axis; 0 for no map */
    size_t came;              /* points that the device has told */
    struct map_point *points; /* side * side, the first axis fastest; NULL until the map is begun */
    bool is_open;             /* what the device says now belongs to the map */
    bool is_whole;            /* every point came, and the device's own count agrees */
    size_t unreadable;        /* lines that are no point of it */
    char command[SESSION_COMMAND_MAX];
    char answer[SESSION_LINE_MAX]; /* fields: the device's own counts; empty if it gave none */
    char status[SESSION_LINE_MAX]; /* before it, of the set that it varies */
    char *parameters;              /* of that set, body lines of list, joined by LF */
    double damping_n_s_per_m;      /* c */
    double wall_s;
    struct progress progress;
};

/* Of the points that are squeal or quiet, and of which a rule says one of the two. */
struct map_rule {
    size_t agree, differ;
};

struct map_counts {
    size_t refused;
    size_t by_propensity[4];   /* by enum detector_propensity, the refused left out */
    size_t growing;            /* of squeal and watch: not yet at the size that they go to */
    double least_um, most_um;  /* amplitude of the squeals that do not grow any more; NaN without any */
    struct map_rule line;      /* squeal where |alpha| N > c */
    struct map_rule predictor; /* the closed form that the device evaluates at each point */
};

/* Loads the set and has the device make the map. What comes is kept, whatever goes wrong. */
void map_play(struct story *story);

/* Takes what the device says while the map is open. */
void map_listen(struct map *map, enum session_line kind, const char *text);

struct map_counts map_count(const struct map *map);

/* Points that never came. */
size_t map_missing(const struct map *map);

/* Removes what an earlier run left in the folder of the story. */
void map_forget(const struct story *story);

/* Writes map.csv, every field of every point that came. */
void map_write(struct story *story);

void map_free(struct map *map);

#endif
