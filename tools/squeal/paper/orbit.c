/* Strobes come as samples, one each so many steps as a normal period has. */
#include "squeal/paper/orbit.h"

#include "squeal/paper/fit.h"

#include <math.h>

enum { CHUNK_PERIODS = 64, FITTED_LEAST = 12, POINTS = 3, HALVINGS = 5, PATIENCE = 1600, FOLLOWED_PERIODS = 5000 };

#define REPEATS 1e-5 /* of the size: strobes that are so near are the same */
#define DOUBLED 1e-2

#define SLOW -4e-3 /* ln |multiplier| that takes a thousand periods to be measured */
#define FAR_SHARE 0.03

/* Between these sizes of the alternating part it is small enough to be linear, and above rounding. */
#define LINEAR 1e-2
#define ROUNDING 1e-4

/* Distance in the phase plane, velocity by the time in which a period makes one radian. */
static double length_m(struct lab *lab, double x_m, double v_m_per_s)
{
    return hypot(x_m, v_m_per_s * lab_period_s(lab) / (2.0 * acos(-1.0)));
}

static double distance_m(struct lab *lab, const struct lab_track *track, size_t i, size_t j)
{
    return length_m(lab, track->value[0][i] - track->value[0][j], track->value[1][i] - track->value[1][j]);
}

static double size_m(struct lab *lab, const struct lab_track *track, size_t first)
{
    double size = 0.0;

    for (size_t i = first; i < track->count; i++) {
        size = fmax(size, length_m(lab, track->value[0][i], track->value[1][i]));
    }
    return size;
}

static void judge(struct lab *lab, const struct lab_track *track, struct orbit *orbit)
{
    const size_t first = track->count - ORBIT_STROBES;
    const double size = size_m(lab, track, first);
    double repeats = 0.0, alternates = 0.0;

    for (size_t i = first; i < track->count; i++) {
        orbit->x_m[i - first] = track->value[0][i];
        orbit->v_m_per_s[i - first] = track->value[1][i];
        if (i >= first + 2) {
            repeats = fmax(repeats, distance_m(lab, track, i, i - 2));
            alternates += distance_m(lab, track, i, i - 1) / (ORBIT_STROBES - 2);
        }
    }
    orbit->alternation = size > 0.0 ? alternates / size : 0.0;
    orbit->is_settled = repeats <= REPEATS * size;
}

struct orbit orbit_settle(struct lab *lab, unsigned most)
{
    struct orbit orbit = {.periods = 0};

    while (orbit.periods < most && !orbit.is_settled && !orbit.is_diverging) {
        const struct lab_track track = lab_record(lab, "x,xd", CHUNK_PERIODS, lab_steps_per_period(lab));
        orbit.periods += CHUNK_PERIODS;
        orbit.is_diverging = track.count < CHUNK_PERIODS;
        if (!orbit.is_diverging) {
            judge(lab, &track, &orbit);
        }
    }
    return orbit;
}

bool orbit_is_doubled(const struct orbit *orbit) { return orbit->alternation > DOUBLED; }

/* The alternating part at a strobe. */
static double alternating(const struct lab_track *track, size_t i)
{
    return (i % 2 == 0 ? 1.0 : -1.0) * (track->value[0][i] - track->value[0][i - 1]);
}

/* Slope of the straight line through the logarithms of the alternating part since it became small for good. Rounding
 * leaves some of it, larger the nearer to the doubling; that is taken off. */
double orbit_log_multiplier(struct lab *lab, unsigned most)
{
    struct fit fit = {0};

    lab_reset(lab);
    const struct lab_track track = lab_record(lab, "x,xd", most, lab_steps_per_period(lab));
    if (track.count < 2) {
        return (double)NAN;
    }
    const double size = size_m(lab, &track, track.count / 2), left = alternating(&track, track.count - 1);
    if (fabs(left) > LINEAR * size) {
        return (double)NAN;
    }
    for (size_t i = track.count - 1; i > 0; i--) {
        const double share = fabs(alternating(&track, i) - left) / size;
        if (share > LINEAR) {
            break;
        }
        if (share > ROUNDING) {
            fit_add(&fit, (double)i, log(share));
        }
    }
    return fit.count < FITTED_LEAST ? (double)NAN : fit_slope(&fit);
}

/* --- Two plants --------------------------------------------------------------------------------------------------- */

double orbit_parting(struct lab *lab, double offset_m, unsigned from, unsigned to, double *distance_m)
{
    const double x0_m = lab_get(lab, "x0"), omega = sqrt((lab_get(lab, "kt") + lab_get(lab, "k")) / lab_get(lab, "m"));
    struct fit fit = {0};

    lab_reset(lab);
    const struct lab_track one = lab_record(lab, "x,xd", to, lab_steps_per_period(lab));
    lab_setf(lab, "x0 %.9g", x0_m + offset_m);
    const struct lab_track two = lab_record(lab, "x,xd", to, lab_steps_per_period(lab));
    lab_setf(lab, "x0 %.9g", x0_m);
    for (size_t i = 0; i < to && i < one.count && i < two.count; i++) {
        const double distance = hypot(two.value[0][i] - one.value[0][i], (two.value[1][i] - one.value[1][i]) / omega);
        if (i >= from && distance > 0.0) {
            fit_add(&fit, (double)i, log(distance));
        }
        if (distance_m != NULL) {
            distance_m[i] = distance;
        }
    }
    return fit_slope(&fit);
}

/* --- Doubling ----------------------------------------------------------------------------------------------------- */

static bool is_doubled_at(struct lab *lab, const char *symbol, double value)
{
    lab_reset(lab);
    lab_put(lab, symbol, value);
    const struct orbit orbit = orbit_settle(lab, PATIENCE);
    return orbit_is_doubled(&orbit);
}

/* Where the parabola through three values of ln |multiplier|, which gives the parameter, passes 0. */
static double vanishing(const double value[POINTS], const double log_multiplier[POINTS])
{
    double sum = 0.0;

    for (int i = 0; i < POINTS; i++) {
        double weight = value[i];
        for (int j = 0; j < POINTS; j++) {
            weight *= j == i ? 1.0 : log_multiplier[j] / (log_multiplier[j] - log_multiplier[i]);
        }
        sum += weight;
    }
    return sum;
}

double orbit_doubling(struct lab *lab, const char *symbol, double one, double two)
{
    const double sign = two > one ? -1.0 : 1.0;
    double value[POINTS], log_multiplier[POINTS];

    if (is_doubled_at(lab, symbol, one) || !is_doubled_at(lab, symbol, two)) {
        return (double)NAN;
    }
    for (int i = 0; i < HALVINGS; i++) {
        const double middle = 0.5 * (one + two);
        *(is_doubled_at(lab, symbol, middle) ? &two : &one) = middle;
    }
    /* First as far away as that bracket asks for, then where the part dies out neither fast nor for ever. */
    double distance = FAR_SHARE * one;
    double found = 0.5 * (one + two);
    for (int pass = 0; pass < 2; pass++) {
        for (int i = 0; i < POINTS; i++) {
            value[i] = found + sign * distance * (i + 1);
            lab_reset(lab);
            lab_put(lab, symbol, value[i]);
            log_multiplier[i] = orbit_log_multiplier(lab, FOLLOWED_PERIODS);
        }
        found = vanishing(value, log_multiplier);
        distance = SLOW * (value[0] - found) / log_multiplier[0] * sign;
    }
    return found;
}
