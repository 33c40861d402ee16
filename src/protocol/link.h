/* The binary link: frames in, frames out, hardware-free, for a program that steers the plant step by step. The main
 * loop turns it as it turns the console:
 *
 *     link_lost(&link, bytes that the UART lost since the last time)
 *     taken = link_receive(&link, bytes, size)               what was not taken is offered again
 *     is_busy = link_poll(&link)
 *     let the interrupt take an order, send text_peek(), sleep if nothing is left to send and the link is not busy
 *
 *   bytes -> frame -> request -> reply, or an order or steps and later the reply -> bytes
 *                                samples, results of a study -------------------->
 *
 * One request at a time; the next is not looked at before this one is answered. Nothing here waits. The specification
 * is PROTOCOL.md. */
#ifndef PROTOCOL_LINK_H
#define PROTOCOL_LINK_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/bytes.h"
#include "base/text.h"
#include "protocol/frame.h"
#include "protocol/identity.h"
#include "protocol/messages.h"
#include "protocol/turn.h"
#include "protocol/work.h"
#include "sim/executive.h"

enum { LINK_REQUEST_MAX = 236 /* bytes of the longest request's payload */ };

/* The request being answered. */
struct link_request {
    uint8_t type;
    uint16_t sequence;
    uint32_t step;
    size_t size; /* of the payload; what does not fit below is of a wrong length anyway */
    uint8_t payload[LINK_REQUEST_MAX];
};

/* The STEP under way, and the last one answered. */
struct link_steps {
    uint64_t target;  /* step index at its end */
    uint64_t reached; /* step index at which what was granted is used up */
    bool was_clamped, was_cut;

    bool has_last;
    uint32_t resets; /* of the plant, when it was answered */
    uint16_t last_sequence;
    uint32_t last_at; /* the request's step */
    uint8_t last_payload[LINK_STEP_REQUEST];
    uint32_t last_step; /* in the reply's head */
    uint8_t last_reply[LINK_STEP_REPLY];
};

/* What the executive's image holds for the link, which goes over in pieces. */
enum link_image_state { LINK_IMAGE_NONE, LINK_IMAGE_TAKEN, LINK_IMAGE_COMING };

struct link_image {
    enum link_image_state state;
    uint16_t next; /* bytes of one that is coming that are here */
};

struct link_stream {
    uint32_t signals; /* bit i: signal i */
    uint32_t every;   /* steps a sample; 0 off */
    uint16_t first;   /* number of the first sample */
    uint32_t sent;
    uint32_t without_scale;  /* samples that a second reset has overtaken */
    uint32_t dropped_before; /* by the ring, when the stream began */
    uint32_t dropped;        /* in all, when it ended */
};

struct link {
    struct executive *executive;
    struct turn *turn;
    struct work *work;
    struct text *text;
    const struct identity *identity;
    struct frame_receiver receiver;

    bool has_request;
    unsigned phase; /* of the request: 0 until its function has begun something */
    struct link_request request;
    struct bytes_reader arguments; /* inside the request */
    struct bytes_writer reply;
    uint8_t reply_bytes[FRAME_PAYLOAD_MAX];

    struct params staged, in_force; /* in_force: when the two were last compared */
    bool was_reset;                 /* by the COMMIT under way */
    struct link_steps steps;
    struct link_stream stream;
    uint16_t study; /* sequence of the request that has begun the study */
    struct link_image image;

    uint32_t refused; /* requests answered with ERROR */
};

/* Binds to what it talks about and where it writes; text must hold at least two frames. All must outlive the link.
 * [INIT] */
void link_init(struct link *link, struct executive *executive, struct turn *turn, struct work *work, struct text *text,
               const struct identity *identity);

/* Takes received bytes up to the end of a request, as long as its reply has room; returns how many. [MAIN] */
size_t link_receive(struct link *link, const uint8_t *bytes, size_t size);

/* So many more bytes were lost before they got here: the frame in progress is damaged. [MAIN] */
void link_lost(struct link *link, uint32_t count);

/* Goes on with whatever can go on. Returns true if it did something after which the program should come again before it
 * sleeps. [MAIN] */
bool link_poll(struct link *link);

#endif
