/* A map of trials over two parameters: on the device, as a table, and as a picture. */
#ifndef SQUEAL_LAB_MAP_H
#define SQUEAL_LAB_MAP_H

#include "squeal/paper/lab.h"

struct lab_map_axis {
    const char *symbol, *label;
    double from, to;
    unsigned points;
    bool is_log;
};

struct lab_map {
    const char *name, *title, *subtitle, *caption;
    struct lab_map_axis axes[2];
    unsigned transient, window;
    bool is_metric;          /* sizes in m, not in um */
    const double (*line)[2]; /* one to be drawn over it, and how many points it has */
    size_t line_points;
    const char *line_label; /* beside its last point */
};

/* Tries every point of the set in force, and draws. Returns the points, the first axis fastest. */
const struct device_point *lab_map_make(struct lab *lab, const struct lab_map *map, size_t *count);

#endif
