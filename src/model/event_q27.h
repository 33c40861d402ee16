/* Steps of the Q4.27 plant in pieces: where regimes switch inside the step, and wherever the fast path does not serve.
 * Part of step_q27, in a file of its own; the rules are those of event_f32.c. */
#ifndef MODEL_EVENT_Q27_H
#define MODEL_EVENT_Q27_H

#include "model/step_q27.h"

/* What of the step is to be reported, and how often the contact has changed in it. */
struct event_q27_progress {
    struct plant_notes notes;
    unsigned contacts;
};

/* What the fast path knows of a whole step when it finds that it does not serve: the normal motion, and where the pad
 * slips, its end as seen from its side. */
struct event_q27_attempt {
    int32_t y, w;                   /* at its end */
    const struct slip_q27_end *end; /* NULL if the pad sticks */
};

/* Without an attempt the step saturates where it must; with one it is known to stay within the fine arithmetic. */
void event_q27_step(struct step_q27 *s, const struct step_q27_coeffs *c, struct event_q27_progress *progress,
                    const struct event_q27_attempt *attempt);

/* The pad enters a regime. What rounding has left is forgotten with the side from which it was seen. */
BASE_INLINE void event_q27_enter(struct step_q27 *s, int8_t mode)
{
    s->mode = mode;
    s->rest = (struct slip_q27_rest){SUM_Q27_NO_REST, SUM_Q27_NO_REST};
}

/* The disc has a new speed. A sticking pad follows if friction can also accelerate it; a slipping one keeps its
 * speed. */
void event_q27_set_speed(struct step_q27 *s, const struct step_q27_coeffs *c, int32_t speed);

/* h times the force that would hold the pad on the disc, Q55: C v0 + K x. Exact, and so are the decisions on it. */
BASE_INLINE int64_t event_q27_need(const struct step_q27_coeffs *c, int32_t x, int32_t disc)
{
    struct fixed_sum sum = fixed_sum_of(c->drag, disc);

    fixed_sum_add(&sum, c->wide.spring, x);
    return -fixed_sum_whole(&sum);
}

/* Can friction under the contact force p hold the pad, against an extra need? */
BASE_INLINE bool event_q27_is_held(const struct step_q27_coeffs *c, int32_t x, int32_t disc, int32_t p, int64_t extra)
{
    const int64_t need = event_q27_need(c, x, disc) + extra;
    const struct fixed_sum holding = fixed_sum_of(c->wide.friction, p);
    const int64_t limit = fixed_sum_whole(&holding);

    return need <= limit && -need <= limit;
}

#endif
