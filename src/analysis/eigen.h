/* Complex eigenvalues of steady sliding, as brake engineers look for squeal: of the motion about the equilibrium under
 * a constant load, the disc turning. Friction follows the normal direction and does not act back on it, so the two
 * modes are apart. The real part positive: squeal propensity. Float, for main. [pure] */
#ifndef ANALYSIS_EIGEN_H
#define ANALYSIS_EIGEN_H

#include <stdbool.h>

/* s'' + damping s' + stiffness s = 0, in the model's units of time 1/wn. */
struct eigen {
    float real;          /* of the least damped one: growth per unit of time */
    float imaginary;     /* 0: it does not swing */
    float damping_ratio; /* -real over the modulus: below 0 grows; above 1 for what does not swing */
};

struct eigen eigen_of(float damping, float stiffness);

/* The unstable outer cycle: where slip grows (slope + damping < 0), sticking holds it back, but only below this speed;
 * a faster pad runs away as printed, where no floor keeps friction from turning round. By the describing function V* =
 * 4 mu n/(pi (-(eps n) - C)); inf where slip does not grow. */
float eigen_outer_speed(float friction, float slope, float damping);

#endif
