/* The pad seen once a normal period: when has it come to rest there, and where does it begin to alternate? */
#ifndef SQUEAL_ORBIT_H
#define SQUEAL_ORBIT_H

#include "squeal/paper/lab_live.h"

enum { ORBIT_STROBES = 32 };

struct orbit {
    double x_m[ORBIT_STROBES], v_m_per_s[ORBIT_STROBES]; /* the last ones */
    unsigned periods;                                    /* that it took */
    bool is_diverging;
    bool is_settled;    /* the strobes repeat, each or every second one, to 1e-5 of their size */
    double alternation; /* mean distance of neighbours, of their size: 0 for period 1 */
};

/* Goes on from the present state, with every sample at a whole period, until the strobes repeat, for so many periods at
 * most. */
struct orbit orbit_settle(struct lab *lab, unsigned most);

/* Does a settled orbit take two periods? */
bool orbit_is_doubled(const struct orbit *orbit);

/* ln |multiplier| a period of the alternating part of the motion, as it dies out after the start of the set in force;
 * NaN where it does not, or where that takes longer than so many periods. */
double orbit_log_multiplier(struct lab *lab, unsigned most);

/* Growth of the distance of two plants of the set in force, of which the second starts offset_m farther along the disc:
 * e-folds a period, between two periods. distance_m, if not NULL, takes the distance at every whole period up to the
 * last one; the first of them counts as 0, and the velocity by the pad's own frequency. */
double orbit_parting(struct lab *lab, double offset_m, unsigned from, unsigned to, double *distance_m);

/* Where a parameter of the set in force makes period 1 become period 2: between one, with period 1, and two, with
 * period 2. The bracket is halved coarsely; then ln |multiplier|, which is 0 there, is followed by a parabola through
 * three values on the side of period 1. NaN where the ends are not as said. */
double orbit_doubling(struct lab *lab, const char *symbol, double one, double two);

#endif
