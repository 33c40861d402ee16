/* A map: one or two parameters of a set walked over a grid, a trial at each point. The rows of the second axis follow
 * each other, along each the first axis runs fastest. It hands out sets and keeps none of the answers. */
#ifndef SIM_SCAN_H
#define SIM_SCAN_H

#include <stdbool.h>
#include <stdint.h>

#include "model/params.h"

enum { SCAN_AXES = 2, SCAN_POINTS_MAX = 256 /* along an axis */ };

/* Values of one parameter, in its SI unit; log: in equal ratios, both ends of one sign and not 0. */
struct scan_axis {
    const struct params_info *info;
    float from, to;
    uint32_t points; /* 1 ... SCAN_POINTS_MAX; 1 is from alone */
    bool is_log;
};

struct scan {
    struct params base;
    struct scan_axis axes[SCAN_AXES];
    uint32_t axis_count; /* 1 or 2 */
};

/* Why an axis cannot be had, ERROR_OK if it can: OUT_OF_RANGE where an end leaves the parameter's limits or is no whole
 * number where one is asked for, USAGE where a logarithm has no meaning. [ANY, pure] */
enum error scan_axis_check(const struct scan_axis *axis);

/* The value at a place of an axis; the ends are met to the bit, and whole numbers stay whole. [ANY, pure] */
float scan_axis_value(const struct scan_axis *axis, uint32_t place);

/* Points of the whole grid. [ANY, pure] */
uint32_t scan_points(const struct scan *scan);

/* Place of a point on an axis; 0 for an axis that there is not. [ANY, pure] */
uint32_t scan_place(const struct scan *scan, uint32_t point, uint32_t axis);

/* The set at a point. [ANY, pure] */
void scan_params(const struct scan *scan, uint32_t point, struct params *params);

#endif
