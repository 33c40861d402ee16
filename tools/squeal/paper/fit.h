/* The straight line through points, by least squares. */
#ifndef SQUEAL_FIT_H
#define SQUEAL_FIT_H

struct fit {
    double count, x, xx, y, xy; /* sums; begins as zeros */
};

static inline void fit_add(struct fit *fit, double x, double y)
{
    fit->count += 1.0;
    fit->x += x;
    fit->xx += x * x;
    fit->y += y;
    fit->xy += x * y;
}

/* NaN through fewer than two places. */
static inline double fit_slope(const struct fit *fit)
{
    return (fit->count * fit->xy - fit->x * fit->y) / (fit->count * fit->xx - fit->x * fit->x);
}

#endif
