/* Time that only goes forward, for limits and for what a thing took. */
#ifndef SQUEAL_CLOCK_H
#define SQUEAL_CLOCK_H

/* Seconds since some instant before the start of this process. */
double clock_now_s(void);

#endif
