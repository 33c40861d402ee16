/* Sine and cosine on the grid of the integrator: phases are whole multiples of 1/1024 turn, so they never drift. */
#ifndef MODEL_SINE_H
#define MODEL_SINE_H

#include <stdint.h>

enum { SINE_GRID = 1024 }; /* points per turn, the largest number of steps per period */

/* sin(2 pi index/1024), correctly rounded; any index. [ANY] */
float sine_f32(uint32_t index);

/* cos(2 pi index/1024). [ANY] */
static inline float sine_cosine_f32(uint32_t index) { return sine_f32(index + SINE_GRID / 4u); }

/* sin(2 pi k/1024) for k = 0 ... 256, correctly rounded. */
extern const float sine_quarter_f32[SINE_GRID / 4 + 1];

/* The same in Q31, but that the last, 1, is 2^-31 less. */
extern const int32_t sine_quarter_q31[SINE_GRID / 4 + 1];

#endif
