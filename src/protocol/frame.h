/* Frames on a line of bytes: what a program says to another, whole and unharmed or not at all.
 *
 *     type u8 . sequence u16 . step u32 . payload, 0 .. 240 bytes . crc32 u32        low byte first
 *     \___________________________________________________________________/
 *                     byte stuffing (base/cobs.h), then 00
 *
 * The CRC (base/crc32.h) covers all bytes before it. Type, sequence, step and payload mean nothing here. A 00 ends a
 * frame and nothing else, so whatever a line does to the bytes, the frame after the next 00 is received again; a sender
 * may send a 00 first to get rid of what the line held before. [MAIN] */
#ifndef PROTOCOL_FRAME_H
#define PROTOCOL_FRAME_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/cobs.h"
#include "base/text.h"

enum {
    FRAME_PAYLOAD_MAX = 240,              /* bytes */
    FRAME_HEAD_SIZE = 1 + 2 + 4,          /* type, sequence, step */
    FRAME_SIZE_MIN = FRAME_HEAD_SIZE + 4, /* and the CRC */
    FRAME_SIZE_MAX = FRAME_SIZE_MIN + FRAME_PAYLOAD_MAX,
    FRAME_STUFFED_MAX = COBS_SIZE_MAX(FRAME_SIZE_MAX), /* between two delimiters */
    FRAME_WIRE_MAX = FRAME_STUFFED_MAX + 1             /* with its delimiter */
};

struct frame {
    uint8_t type;
    uint16_t sequence;
    uint32_t step;          /* low word of the plant's step counter */
    const uint8_t *payload; /* size bytes; a received one is valid until the receiver takes its next byte */
    size_t size;            /* 0 .. FRAME_PAYLOAD_MAX */
};

/* Appends the frame, ready for the line, or returns false and leaves text as it was if it does not fit whole. */
bool frame_write(struct text *text, const struct frame *frame);

/* One end of a line. Each non-empty piece between two delimiters is accepted or counts under one of the five reasons,
 * the first that applies in this order. Counters wrap at 2^32. */
struct frame_receiver {
    uint8_t bytes[FRAME_STUFFED_MAX];
    size_t size;                  /* bytes of the frame in progress, as far as they fit */
    bool is_damaged, is_too_long; /* the frame in progress is lost */

    uint32_t accepted;
    uint32_t damaged;   /* frame_damage() was called */
    uint32_t too_long;  /* more than FRAME_STUFFED_MAX bytes */
    uint32_t bad_cobs;  /* the stuffing does not come out even */
    uint32_t too_short; /* unstuffed, less than FRAME_SIZE_MIN bytes */
    uint32_t bad_crc;
    uint32_t garbage_bytes; /* in all pieces that were not accepted, without their delimiters */
};

/* Nothing received, counters 0. [INIT] */
void frame_open(struct frame_receiver *receiver);

/* Takes one byte; true if it ends a good frame, which is then in *frame. Otherwise *frame is left as it was. Constant
 * work but for a delimiter, which may cost unstuffing and CRC of one frame. */
bool frame_take(struct frame_receiver *receiver, uint8_t byte, struct frame *frame);

/* Bytes were lost on the way here: what comes until the next delimiter, with what came before, is no frame. */
void frame_damage(struct frame_receiver *receiver);

#endif
