/* Eq. 20 and RK4 as one types them in from a textbook: arrays, a function pointer, physical units, the raw sign of vr.
 * For comparison only. textbook.c makes it in single and in double precision. */
#ifndef TEXTBOOK_H
#define TEXTBOOK_H

/* x, x', y, y' in SI units. */
struct textbook_float {
    float state[4];
    float step_s, time_s;
};

struct textbook_double {
    double state[4];
    double step_s, time_s;
};

/* At rest under Table 1 but for the brake force and friction's slope. */
void textbook_start_float(struct textbook_float *pad, float load_n, float slope_s_per_m, float step_s);
void textbook_start_double(struct textbook_double *pad, float load_n, float slope_s_per_m, float step_s);

void textbook_step_float(struct textbook_float *pad);
void textbook_step_double(struct textbook_double *pad);

#endif
