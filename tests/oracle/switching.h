/* The instants at which the plant's equations change, and what holds afterwards (Filippov's rules):
 *
 * at vr = 0 sticking needs the friction need = c v0 + (k+kt) x. If |need| <= mu_s P the pad sticks; otherwise it slips
 * on with the sign of need. Sticking ends when mu_s P falls below |need|. Static and kinetic friction are equal at
 * vr = 0, so there is no hysteresis. With P < 0 (bilateral contact that pulls) the pad can only cross. */
#ifndef ORACLE_SWITCHING_H
#define ORACLE_SWITCHING_H

#include "phase.h"

enum switching_event {
    EVENT_NONE,
    EVENT_MEET,       /* slip came to vr = 0 */
    EVENT_LEAVE_PLUS, /* sticking broke */
    EVENT_LEAVE_MINUS,
    EVENT_FLOOR,  /* friction reached or left its floor */
    EVENT_CONTACT /* y passed 0 */
};

/* Mode and flags that fit the initial position and speeds. */
void switching_start(const struct plant *plant, struct plant_state *state);

/* The first event of the phase that starts at the state, not later than *t. Sets *t to its instant. */
enum switching_event switching_find(const struct plant *plant, const struct plant_state *state,
                                    const struct phase *phase, double *t);

/* Changes mode and flags of the state that the phase has reached at its time t. */
void switching_apply(const struct plant *plant, enum switching_event event, const struct phase *phase, double t,
                     struct plant_state *state);

#endif
