/* The names that the golden tables give to kinds of motion. */
#ifndef ORACLE_CLASSIFY_H
#define ORACLE_CLASSIFY_H

#include <stddef.h>

#include "window.h"

/* States once a normal period. */
struct classify_strobe {
    double x_m, v_m_per_s;
};

enum { CLASSIFY_NAME_SIZE = 32 };

/* Smallest p such that the strobes repeat after p periods to 1e-6 of their range; 0 if none up to 64 does. */
int classify_multiplicity(const struct classify_strobe *strobe, size_t count, const struct window *window);

/* Writes the name of the motion seen in the window. lle: stretching of a small disturbance per normal period. */
void classify_name(const struct window *window, int multiplicity, double lle_per_period, char name[CLASSIFY_NAME_SIZE]);

#endif
