/* The steering end of the link: what a controller, a tool or a test says and hears. Hardware-free: bytes in, bytes out;
 * wires, waiting and time are the caller's.
 *
 *     master_ask(&master, &out, LINK_RESET, NULL, 0);          a request becomes a frame in out
 *     send text_peek(&out), and for each byte that comes back:
 *         switch (master_take(&master, byte, &frame)) {
 *         case MASTER_ANSWERED:                                frame holds the reply's payload
 *         case MASTER_REFUSED:                                 master_read_refusal() tells why
 *         case MASTER_UNASKED:                                 a sample, or a result of a study
 *     nothing for too long: master_ask_again(&master, &out)    the same bytes: no STEP is made twice
 *
 * One request at a time. [MAIN] */
#ifndef PROTOCOL_MASTER_H
#define PROTOCOL_MASTER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/errors.h"
#include "base/text.h"
#include "protocol/frame.h"
#include "protocol/messages.h"
#include "sim/input.h"

enum master_event {
    MASTER_NOTHING,
    MASTER_ANSWERED, /* the reply to the request */
    MASTER_REFUSED,  /* ERROR instead of it */
    MASTER_UNASKED,  /* a frame that comes by itself */
    MASTER_STRAY     /* a reply to no request that waits, such as the second one to a request sent twice */
};

struct master {
    struct frame_receiver receiver;
    bool is_waiting;
    bool is_clear;        /* the line holds nothing of ours that was not answered */
    struct frame request; /* the last one; its payload lies in payload */
    uint8_t payload[FRAME_PAYLOAD_MAX];
    uint16_t sequence;      /* of the last request but STEP */
    uint16_t step_sequence; /* of the last STEP that was answered, or of the one that waits */
    uint32_t step;          /* low word of the plant's step counter in the last reply */
    uint32_t strays;
    uint32_t repeats; /* of the request that waits */
    uint32_t echoes;  /* refusals of the last refused request that may yet come, for it was asked again so often */
    uint8_t refusal[LINK_ERROR_SIZE];
};

/* Nothing asked, nothing received. [INIT] */
void master_init(struct master *master);

/* Appends a request's frame to out; the first one, and one that follows silence, behind a 00 that ends whatever the
 * line held before. Size as in messages.def; STEP goes by master_step(). False, and nothing is done, if out lacks the
 * room. */
bool master_ask(struct master *master, struct text *out, enum link_message type, const void *payload, size_t size);

/* STEP: count steps (1 .. 1000000) from where the plant stood at the last reply, with a demand; its step does not
 * matter. */
bool master_step(struct master *master, struct text *out, uint32_t count, const struct input_demand *demand);

/* The request that waits, once more and byte by byte the same. */
bool master_ask_again(struct master *master, struct text *out);

/* Takes one byte. *frame is set unless MASTER_NOTHING comes back, and valid until the next byte. */
enum master_event master_take(struct master *master, uint8_t byte, struct frame *frame);

/* Why not. */
struct master_refusal {
    uint8_t type;      /* of the request */
    uint8_t error;     /* enum error; a number that is not in our table comes from a newer device */
    uint8_t index;     /* parameter or field to blame, LINK_NO_INDEX: none */
    uint32_t expected; /* length, sequence, step, version or CRC that would have been accepted */
    float low, high;   /* values that would have been accepted, where that applies */
};

void master_read_refusal(const struct frame *frame, struct master_refusal *refusal);

/* Where the plant stands after STEP. SI units. */
struct master_state {
    uint64_t step;
    uint32_t hash;
    float x_m, xd_m_per_s, y_m, yd_m_per_s;
    float load_n, friction_n;
    float disc_m_per_s;
    int8_t mode;        /* -1 slip-, 0 stick, 1 slip+ */
    uint8_t propensity; /* enum detector_propensity */
    uint8_t motion;     /* enum detector_class */
    uint8_t period;
    uint8_t flags; /* LINK_IS_FAULT and its like */
};

void master_read_state(const struct frame *frame, struct master_state *state);

#endif
