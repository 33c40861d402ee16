/* Polynomials of fixed degree in the time since the start of a phase: value, slope, roots. */
#ifndef ORACLE_POLYNOMIAL_H
#define ORACLE_POLYNOMIAL_H

#include <stdbool.h>

enum { POLYNOMIAL_DEGREE = 22 };

struct polynomial {
    double term[POLYNOMIAL_DEGREE + 1]; /* term[i] belongs to t^i */
};

double polynomial_value(const struct polynomial *p, double t);

/* The derivative as a polynomial; its highest term is zero. */
struct polynomial polynomial_slope(const struct polynomial *p);

/* factor * p + constant */
struct polynomial polynomial_affine(const struct polynomial *p, double factor, double constant);

/* p/t^zeros, for a polynomial whose first terms are known to be zero. */
struct polynomial polynomial_deflate(const struct polynomial *p, int zeros);

/* First t in [0, end] where p becomes negative, to the last bit; a p that starts negative gives 0. Finds dips between
 * the samples too, as long as p has no more than one minimum in a sixth of the interval. False: p stays >= 0. */
bool polynomial_first_negative(const struct polynomial *p, double end, double *t);

/* The root in [low, high], where the values at both ends differ in sign, to the last bit. */
double polynomial_root(const struct polynomial *p, double low, double high);

#endif
