/* Polynomials: Horner's rule, and bisection to the last bit, which cannot miss. */
#include "polynomial.h"

enum { INTERVALS = 6 };

double polynomial_value(const struct polynomial *p, double t)
{
    double sum = p->term[POLYNOMIAL_DEGREE];

    for (int i = POLYNOMIAL_DEGREE - 1; i >= 0; i--) {
        sum = sum * t + p->term[i];
    }
    return sum;
}

struct polynomial polynomial_slope(const struct polynomial *p)
{
    struct polynomial slope;

    for (int i = 0; i < POLYNOMIAL_DEGREE; i++) {
        slope.term[i] = (double)(i + 1) * p->term[i + 1];
    }
    slope.term[POLYNOMIAL_DEGREE] = 0.0;
    return slope;
}

struct polynomial polynomial_affine(const struct polynomial *p, double factor, double constant)
{
    struct polynomial result;

    for (int i = 0; i <= POLYNOMIAL_DEGREE; i++) {
        result.term[i] = factor * p->term[i];
    }
    result.term[0] += constant;
    return result;
}

struct polynomial polynomial_deflate(const struct polynomial *p, int zeros)
{
    struct polynomial result;

    for (int i = 0; i <= POLYNOMIAL_DEGREE; i++) {
        result.term[i] = i + zeros <= POLYNOMIAL_DEGREE ? p->term[i + zeros] : 0.0;
    }
    return result;
}

/* Halves [low, high] until it cannot be halved; keeps p's sign at low. Returns the far end. */
static double bisect(const struct polynomial *p, double low, double high)
{
    const bool is_negative_low = polynomial_value(p, low) < 0.0;

    for (;;) {
        const double middle = 0.5 * (low + high);

        if (!(middle > low && middle < high)) {
            return high;
        }
        if ((polynomial_value(p, middle) < 0.0) == is_negative_low) {
            low = middle;
        } else {
            high = middle;
        }
    }
}

double polynomial_root(const struct polynomial *p, double low, double high) { return bisect(p, low, high); }

bool polynomial_first_negative(const struct polynomial *p, double end, double *t)
{
    const struct polynomial slope = polynomial_slope(p);
    double before = 0.0;
    double slope_before = slope.term[0];

    *t = 0.0;
    if (p->term[0] < 0.0) {
        return true;
    }
    for (int i = 1; i <= INTERVALS; i++) {
        const double after = end * i / INTERVALS;
        const double slope_after = polynomial_value(&slope, after);
        double negative = after;

        if (polynomial_value(p, after) >= 0.0 && slope_before < 0.0 && slope_after > 0.0) {
            negative = bisect(&slope, before, after);
        }
        if (polynomial_value(p, negative) < 0.0) {
            *t = bisect(p, before, negative);
            return true;
        }
        before = after;
        slope_before = slope_after;
    }
    return false;
}
