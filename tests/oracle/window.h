/* What is measured over a stretch of time: extremes, means, shares of the modes, passages and maxima. */
#ifndef ORACLE_WINDOW_H
#define ORACLE_WINDOW_H

#include "orbit.h"

enum { WINDOW_MAXIMA = 512 };

struct window {
    const struct plant *plant;
    double time_s;
    double x_max, x_min, v_max, v_min, y_max, y_min;
    double mu_min;                           /* of the law without its floor, while slipping */
    double stick_s, slip_minus_s, pulling_s; /* pulling: y < 0 */
    long sticks;                             /* entries into sticking */
    double x_reference;         /* sums are taken from here, so that a small motion far from zero keeps its digits */
    double x_sum, x_square_sum; /* integrals of x - reference and its square */
    bool has_level;             /* passages are counted from the moment there is a level */
    double level;
    long passages; /* upward, through the level */
    double first_passage_s, last_passage_s;
    double maximum_m[WINDOW_MAXIMA], maximum_s[WINDOW_MAXIMA]; /* the first maxima of x */
    int maxima;
};

void window_start(struct window *window, const struct plant *plant, const struct plant_state *state);
void window_add(struct window *window, const struct orbit_piece *piece);

/* From now on count upward passages of x through the middle of the extremes seen so far. */
void window_set_level(struct window *window);

double window_share(const struct window *window, double part_s);
double window_mean(const struct window *window);
double window_rms(const struct window *window); /* about the mean */
double window_passage_hz(const struct window *window);

#endif
