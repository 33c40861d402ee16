/* Methods as one would type them in double precision, without any of the firmware's code. */
#include "walk.h"

#include <math.h>
#include <string.h>

enum { SLIP_MINUS = -1, STICK = 0, SLIP_PLUS = 1, EVENTS_MAX = 4, SCAN = 64 };

static const double mass = 0.3, damping = 0.01, disc = 1.0, friction = 0.3, normal = 1.0, spring = 2.0;
static const double tanh_width = 0.01; /* of v0 */

struct pad {
    const struct walk_case *which;
    enum walk_textbook method;
    int mode;
    double s[4]; /* x, v, y, w */
};

/* sgn of the slip speed as the method has it. */
static double sign_of(const struct pad *pad, double vr)
{
    switch (pad->method) {
    case WALK_EVENT:
        return pad->mode;
    case WALK_TANH:
        return tanh(vr / (tanh_width * disc));
    case WALK_NAIVE:
    default:
        return vr > 0.0 ? 1.0 : vr < 0.0 ? -1.0 : 0.0;
    }
}

static void rate(const struct pad *pad, const double s[4], double d[4])
{
    const double vr = disc - s[1];
    const double speed =
        pad->method == WALK_EVENT ? pad->mode * vr : fabs(vr); /* smooth beyond an event to be located */
    const double force = sign_of(pad, vr) * (friction + pad->which->slope_s_per_m * speed) * normal * s[2];
    const int sticks = pad->method == WALK_EVENT && pad->mode == STICK;

    d[0] = sticks ? disc : s[1];
    d[1] = sticks ? 0.0 : (force - damping * s[1] - spring * s[0]) / mass;
    d[2] = s[3];
    d[3] = (pad->which->load_n - normal * s[2]) / mass;
}

static void runge_kutta(const struct pad *pad, double h, const double from[4], double to[4])
{
    double k[4][4], at[4];

    rate(pad, from, k[0]);
    for (int stage = 1; stage < 4; stage++) {
        for (int i = 0; i < 4; i++) {
            at[i] = from[i] + (stage < 3 ? 0.5 * h : h) * k[stage - 1][i];
        }
        rate(pad, at, k[stage]);
    }
    for (int i = 0; i < 4; i++) {
        to[i] = from[i] + h / 6.0 * (k[0][i] + 2.0 * (k[1][i] + k[2][i]) + k[3][i]);
    }
}

static double need_of(const double s[4]) { return damping * disc + spring * s[0]; }

/* What must stay positive for the mode to last, and its slope. */
static double spare(const struct pad *pad, const double s[4], double *slope)
{
    double d[4];

    rate(pad, s, d);
    if (pad->mode == STICK) {
        *slope = friction * normal * d[2] - (need_of(s) < 0.0 ? -1.0 : 1.0) * spring * d[0];
        return friction * normal * s[2] - fabs(need_of(s));
    }
    *slope = -pad->mode * d[1];
    return pad->mode * (disc - s[1]);
}

static double cubic(double a, double da, double b, double db, double u)
{
    return (1 + 2 * u) * (1 - u) * (1 - u) * a + u * (1 - u) * (1 - u) * da + u * u * (3 - 2 * u) * b +
           u * u * (u - 1) * db;
}

/* First root of the cubic through both ends in (0, 1], or 2. What starts at 0 must first have become positive. */
static double first_root(double a, double da, double b, double db)
{
    double low = 0.0;

    for (int i = 1; i <= SCAN; i++) {
        double high = (double)i / SCAN;

        if (cubic(a, da, b, db, high) < 0.0) {
            for (int bisection = 0; bisection < 60; bisection++) {
                const double middle = 0.5 * (low + high);

                if (cubic(a, da, b, db, middle) < 0.0) {
                    high = middle;
                } else {
                    low = middle;
                }
            }
            return 0.5 * (low + high);
        }
        low = high;
    }
    return 2.0;
}

/* At rest on the disc: does friction hold it? */
static void choose_mode(struct pad *pad)
{
    const double need = need_of(pad->s);

    pad->mode = fabs(need) <= friction * normal * pad->s[2] ? STICK : need > 0.0 ? SLIP_PLUS : SLIP_MINUS;
}

static void located_step(struct pad *pad, double h)
{
    for (int events = 0; events <= EVENTS_MAX; events++) {
        double end[4], slope, slope_end;
        const double here = spare(pad, pad->s, &slope);
        double part;

        runge_kutta(pad, h, pad->s, end);
        {
            const double there = spare(pad, end, &slope_end);
            part = first_root(here < 0.0 ? 0.0 : here, h * slope, there, h * slope_end);
        }
        if (part > 1.0 || events == EVENTS_MAX) {
            memcpy(pad->s, end, sizeof end);
            return;
        }
        runge_kutta(pad, part * h, pad->s, end);
        memcpy(pad->s, end, sizeof end);
        h -= part * h;
        if (pad->mode == STICK) {
            pad->mode = need_of(pad->s) > 0.0 ? SLIP_PLUS : SLIP_MINUS;
        } else {
            pad->s[1] = disc;
            choose_mode(pad);
        }
    }
}

void walk_textbook(const struct walk_case *which, enum walk_textbook method, long steps_per_period, struct walk *walk)
{
    const double period_s = 2.0 * 3.14159265358979323846 * sqrt(mass / normal);
    const double h = period_s / (double)steps_per_period;
    struct pad pad = {.which = which, .method = method, .mode = SLIP_PLUS};

    for (int look = 0; look < WALK_COUNT; look++) {
        for (long i = 0; i < steps_per_period / WALK_LOOKS; i++) {
            if (method == WALK_EVENT) {
                located_step(&pad, h);
            } else {
                double end[4];

                runge_kutta(&pad, h, pad.s, end);
                memcpy(pad.s, end, sizeof end);
            }
        }
        walk->x_m[look] = pad.s[0];
    }
}
