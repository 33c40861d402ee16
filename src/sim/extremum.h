/* Extremes between samples, in integers: raw samples at 64 steps a period lose up to 1.2e-3 of an amplitude. */
#ifndef SIM_EXTREMUM_H
#define SIM_EXTREMUM_H

#include <stdint.h>

/* part/whole in Q15 for 0 <= part <= whole, whole > 0; error below 2^-14. No 64-bit division. [ISR, pure] */
uint32_t extremum_ratio_q15(uint32_t part, uint32_t whole);

/* Extreme of x between two samples whose velocities have opposite signs: the cubic Hermite polynomial at the place
 * where a straight velocity would be 0. All in Q4.27; step_q27 is the velocity's weight, h in units of x per v. [ISR,
 * pure] */
int32_t extremum_of_displacement(int32_t x0, int32_t v0, int32_t x1, int32_t v1, int32_t step_q27);

/* Extreme of the parabola through three equidistant samples, the middle one being the outermost. [ISR, pure] */
int32_t extremum_of_parabola(int32_t before, int32_t middle, int32_t after);

#endif
