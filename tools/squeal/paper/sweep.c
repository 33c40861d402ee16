/* Changes are made between two steps, at whole periods. */
#include "squeal/paper/sweep.h"

#include <math.h>

enum { PLACES = 99, PLACES_SMALL = 11, MOST_PERIODS = 3000, MOST_PERIODS_SMALL = 384 };

#define HYSTERESIS 1e-2 /* of the size */

/* After the parameter has changed. */
static void take_place(struct lab *lab, struct sweep *sweep, double value, unsigned place, int way)
{
    const struct orbit orbit = orbit_settle(lab, lab_options(lab)->is_small ? MOST_PERIODS_SMALL : MOST_PERIODS);
    double *end = &sweep->end[way][place];

    *end = (double)NAN;
    if (orbit.is_diverging) {
        sweep->diverged++;
        lab_reset(lab);
        return;
    }
    sweep->unsettled += orbit.is_settled ? 0 : 1;
    for (int i = 0; i < (orbit.is_settled ? 2 : ORBIT_STROBES); i++) {
        table_add(lab, &sweep->strobes, (const double[]){value, way == 0 ? 1.0 : -1.0, orbit.x_m[i]});
        *end = fmax(*end, orbit.x_m[i]);
        sweep->size_m = fmax(sweep->size_m, fabs(orbit.x_m[i]));
    }
}

struct sweep sweep_make(struct lab *lab, const char *symbol, double from, double to)
{
    const unsigned places = lab_options(lab)->is_small ? PLACES_SMALL : PLACES;
    struct sweep sweep = {.strobes = table_begin("value,way,x[m]"), .places = places};

    for (int way = 0; way < 2; way++) {
        sweep.end[way] = lab_memory(lab, places, sizeof(double));
        for (unsigned i = 0; i < places; i++) {
            const unsigned place = way == 0 ? i : places - 1 - i;
            const double value = from + (to - from) * place / (places - 1);
            lab_put(lab, symbol, value);
            take_place(lab, &sweep, value, place, way);
        }
    }
    return sweep;
}

unsigned sweep_hysteresis(const struct sweep *sweep)
{
    unsigned places = 0;

    for (unsigned i = 0; i < sweep->places; i++) {
        places += fabs(sweep->end[0][i] - sweep->end[1][i]) > HYSTERESIS * sweep->size_m ? 1 : 0;
    }
    return places;
}
