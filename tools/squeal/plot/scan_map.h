/* The map of a table that scan has written. */
#ifndef SQUEAL_SCAN_MAP_H
#define SQUEAL_SCAN_MAP_H

#include <stdbool.h>

#include "squeal/support/csv.h"

/* Draws it; path lacks its .svg or .png. False with the problem. */
bool scan_map_draw(const struct csv *csv, const char *title, const char *path, char problem[CSV_PROBLEM_MAX]);

#endif
