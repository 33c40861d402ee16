/* More of what an experiment may do with its device: a change while it runs, a trial of the set in force, a border of
 * squeal. */
#ifndef SQUEAL_LAB_LIVE_H
#define SQUEAL_LAB_LIVE_H

#include "squeal/paper/lab.h"

/* lab_set() of a formatted text. */
void lab_setf(struct lab *lab, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Changes one parameter between two steps; the state stays. */
void lab_put(struct lab *lab, const char *symbol, double value);

/* Table 1 with the options' settings, and what differs from it. */
void lab_table1(struct lab *lab, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* A trial of the set in force, from its start. */
struct device_point lab_trial(struct lab *lab, unsigned transient, unsigned window);

/* Range of x in a trial, and does the pad stick or overtake the disc in it, or run away? */
double lab_point_xpp_m(const struct device_point *point);
bool lab_point_has_events(const struct device_point *point);

/* Range of x after so many periods from the start, to a few parts in a hundred thousand. */
double lab_xpp_m(struct lab *lab, unsigned periods);

/* Sticking, crossing and the like that the plant has located since its reset. */
double lab_events(struct lab *lab);

/* The nearest borders of squeal of one parameter, as margin on the console has them. */
struct device_border lab_border(struct lab *lab, const char *symbol);

/* Halves a bracket so many times; no, yes: ends of which the answers are known. Returns its middle. */
double lab_bisect(struct lab *lab, double no, double yes, int times, bool (*is_yes)(struct lab *lab, double value));

/* A picture that something else has drawn as lab_path() says. */
void lab_path(struct lab *lab, char path[PAPER_PATH_MAX], const char *name);
void lab_picture(struct lab *lab, const char *name, const char *caption);

#endif
