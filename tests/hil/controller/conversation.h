/* What the controller says to the plant over the link, and hears from it. Bytes in, bytes out; time comes as ticks.
 *
 *     conversation_open()        HELLO, the preset, what the controller sets, what it must know
 *     CONVERSATION_READY         the plant stands and waits:
 *     conversation_turn()        one STEP with this pressure and speed; READY again when it is answered, in state
 *     conversation_release()     the end: the brake is opened
 *
 * On silence the request is repeated, the same bytes: the plant makes no STEP twice. After too many of them, or where
 * the plant refuses, the brake is released as far as that can be said, and why stays in end and refusal. [MAIN] */
#ifndef CONVERSATION_H
#define CONVERSATION_H

#include <stdbool.h>
#include <stdint.h>

#include "brake.h"
#include "protocol/master.h"

enum conversation_phase {
    CONVERSATION_CLOSED,
    CONVERSATION_OPENING,
    CONVERSATION_READY,
    CONVERSATION_TURNING,
    CONVERSATION_RELEASING
};

enum conversation_end {
    CONVERSATION_WELL,    /* nothing went wrong */
    CONVERSATION_REFUSED, /* see refusal */
    CONVERSATION_LOST     /* no answer */
};

/* The control period, and how long silence is borne. Two and a half periods of the brake's 2 kHz squeal: the jumps of
 * pressure from turn to turn then make the pad ring in turn one way and the other, and cancel. In periods of half a
 * millisecond they would add up, and the controller itself would make the brake sing. */
#define CONVERSATION_TURN_S 1.25e-3f

enum {
    CONVERSATION_TICK_HZ = 100,
    CONVERSATION_REPEAT_TICKS = 20, /* of silence, before the request is repeated */
    CONVERSATION_REPEATS = 15,      /* before the plant is given up */
    CONVERSATION_OUTPUT = 1024      /* bytes: a request, all its repetitions, and room for the longest frame */
};

struct conversation {
    struct master master;
    struct text *output;
    enum conversation_phase phase;
    enum conversation_end end;
    float arithmetic; /* ARITH_F32, ARITH_Q27; below 0: the plant's own */
    uint32_t at;      /* the request of the opening that waits */
    uint32_t staged_crc;
    uint32_t ticks;     /* of silence */
    uint32_t repeats;   /* of the request that waits */
    uint32_t repeated;  /* of all since the opening */
    struct brake brake; /* known from READY on */
    struct master_state state;
    struct master_refusal refusal;
};

/* Closed. What is to be sent goes to output, of CONVERSATION_OUTPUT bytes. [INIT] */
void conversation_init(struct conversation *conversation, struct text *output);

/* Begins, from wherever it was. */
void conversation_open(struct conversation *conversation, float arithmetic);

/* One STEP of a turn's length. Only when READY. */
void conversation_turn(struct conversation *conversation, float pressure_pa, float speed_m_per_s);

/* Opens the brake, and closes when the plant has said that it has heard. */
void conversation_release(struct conversation *conversation);

/* One byte that the link has brought. */
void conversation_take(struct conversation *conversation, uint8_t byte);

/* One tick has passed. */
void conversation_pass(struct conversation *conversation);

#endif
