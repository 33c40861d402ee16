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

enum { EVENT_Q27_REST_LEAST = 1 << 10 }; /* of a step in Q30: nothing happens in what is left then */

static const struct slip_q27_rest event_q27_no_rest = {SUM_Q27_NO_REST, SUM_Q27_NO_REST};

/* The pad enters a regime. What rounding has left is forgotten with the side from which it was seen. */
BASE_INLINE void event_q27_enter(struct step_q27 *s, int8_t mode)
{
    s->mode = mode;
    s->rest = event_q27_no_rest;
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

/* What of a sum in Q55 an event is located by. */
static inline int32_t event_q27_upper(int64_t sum) { return (int32_t)fixed_floor(sum, 32u); }

/* How far a pad that sticks is carried in a fraction of the step. */
BASE_INLINE int32_t event_q27_carried(const struct step_q27_coeffs *c, int32_t disc, int32_t fraction)
{
    return fixed_product(fixed_part_near(c->wide.travel, fraction), disc, 32u);
}

/* x where the pad meets the disc, at a place of the piece that ends so. v is the cubic on which that place was found,
 * so its mean up to there is exactly the mean of its ends less a twelfth of what its slope changes by. */
BASE_INLINE int32_t event_q27_x_meeting(const struct slip_q27_factors *f, const struct slip_q27_view *view,
                                        const struct slip_q27_end *end, int32_t last, int32_t place, bool *tell)
{
    const int64_t both = (int64_t)end->first + last;
    const int32_t half_rise =
        tell == NULL ? fixed_floor_word(end->v - view->v, 1u) : (int32_t)fixed_floor((int64_t)end->v - view->v, 1u);
    const int32_t square = half_rise - (tell == NULL ? fixed_sum_of(SUM_Q27_SIXTH, 2 * end->first + last).high
                                                     : (int32_t)fixed_floor(SUM_Q27_SIXTH * (both + end->first), 32u));
    const int32_t cube =
        (tell == NULL ? fixed_floor_word(end->first + last, 2u) : (int32_t)fixed_floor(both, 2u)) - half_rise;
    const int32_t bend = fixed_part_near(fixed_part_near(square + fixed_part_near(cube, place), place), place);
    const int32_t travel = fixed_part_near(f->travel, place);

    if (tell == NULL) {
        struct fixed_sum sum = {1u << 31, view->x};

        fixed_sum_add(&sum, travel, fixed_floor_word(view->v + view->disc, 1u) - bend);
        return sum.high;
    }
    return fixed_saturate_and_tell(
        view->x + fixed_round_up(travel * (fixed_floor((int64_t)view->v + view->disc, 1u) - bend), 32u), tell);
}

/* Friction under the contact force p holds the pad for certain. Asked of the upper words alone, which now and then do
 * not know. */
BASE_INLINE bool event_q27_is_held_surely(const struct step_q27 *s, const struct step_q27_coeffs *c, int32_t x,
                                          int32_t p)
{
    const int32_t limit = fixed_sum_of(c->wide.friction, p).high - 1;
    struct fixed_sum pull = s->turning.resists;

    fixed_sum_add(&pull, c->wide.spring, x);
    return ((limit - pull.high) | (limit + pull.high)) >= 0;
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
