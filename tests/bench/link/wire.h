/* What one turn of lockstep takes on the line: the bytes of a STEP and of its reply. */
#ifndef WIRE_H
#define WIRE_H

#include "protocol/frame.h"

enum {
    WIRE_AROUND = 2, /* bytes: of the stuffing of a frame this short, and the delimiter */
#define MESSAGE(type, field, name, request, reply, help)             \
    WIRE_##field##_ASKED = FRAME_SIZE_MIN + (request) + WIRE_AROUND, \
    WIRE_##field##_ANSWERED = FRAME_SIZE_MIN + (reply) + WIRE_AROUND,
#include "protocol/messages.def"
#undef MESSAGE
};

#endif
