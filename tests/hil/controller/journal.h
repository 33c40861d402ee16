/* What the controller writes on its console, for a person and for whoever draws from it. Lines end with CR LF:
 *
 *     controller on mps2-an386: stop SPEED law|free [f32|q27]       the greeting: what it can be told
 *     opened step_s=5.37743e-06 turn_steps=232 ...                  the plant is ready
 *     #turn,step,hash,...                                           a header, then a line of numbers a turn
 *     phase t_s=0.128418 now=release pressure_pa=1300000            the law has changed its phase, before that turn
 *     score law=1 kept=0.612 squeal=0.071 ...                       the stop has ended
 *     refused step busy index=255 ...: the other line is at work    it could not; the brake is released
 *     lost step: no answer in 3.2 s                                 nor could it say so
 *     error TEXT                                                    no order was given, or not understood
 *
 * Each returns false, and writes nothing, where the line does not fit. [MAIN] */
#ifndef JOURNAL_H
#define JOURNAL_H

#include "base/text.h"
#include "conversation.h"
#include "law.h"
#include "stop.h"

enum { JOURNAL_LINE_MAX = 320 }; /* bytes of the longest line */

/* All that a turn was. */
struct journal_turn {
    const struct stop *stop; /* after it */
    const struct brake *brake;
    const struct master_state *state;
    float demand_pa, pressure_pa;
    enum law_phase phase;
};

bool journal_greeting(struct text *text, const char *board);
bool journal_opened(struct text *text, const struct brake *brake);
bool journal_header(struct text *text);
bool journal_turn(struct text *text, const struct journal_turn *turn);
bool journal_phase(struct text *text, float time_s, const struct law *law);
bool journal_score(struct text *text, bool has_law, const struct stop *stop, const struct law *law,
                   const struct conversation *conversation);
bool journal_refused(struct text *text, const struct master_refusal *refusal);
bool journal_lost(struct text *text, const struct conversation *conversation);
bool journal_error(struct text *text, const char *what);

#endif
