/* What both ends of the link must know: versions, types and the numbers inside payloads. The specification is
 * PROTOCOL.md. */
#ifndef PROTOCOL_MESSAGES_H
#define PROTOCOL_MESSAGES_H

enum {
    LINK_MAJOR = 1,
    LINK_MINOR = 2,
    LINK_REPLY = 0x80, /* added to the request's type */
    LINK_ERROR = 0xff,
    LINK_SAMPLE = 0x40, /* by itself, like the next three */
    LINK_POINT = 0x41,
    LINK_BORDER = 0x42,
    LINK_STUDY_END = 0x43,
    LINK_ERROR_SIZE = 15, /* bytes of its payload */
    LINK_NO_INDEX = 255,  /* nothing to blame; no second axis of SCAN; all parameters of MARGIN */
    LINK_STEP_REQUEST = 14,
    LINK_STEP_REPLY = 45,
    LINK_PIECE = 232,      /* bytes of a run that go over at a time */
    LINK_TABLE_PIECE = 16, /* points of a table that do */
    LINK_TABLE_REQUEST = 132
};

enum link_message {
#define MESSAGE(type, field, name, request, reply, help) LINK_##field = type,
#include "protocol/messages.def"
#undef MESSAGE
};

/* Of HELLO's reply. */
enum { LINK_IS_EMULATED = 1, LINK_HAS_FPU = 2 };
enum { LINK_VERSION_WIDTH = 16, LINK_BUILD_WIDTH = 32, LINK_BOARD_WIDTH = 24, LINK_CORE_WIDTH = 16 };

/* DICTIONARY's tables, and what it says of a row. */
enum link_table { LINK_PARAMS, LINK_SIGNALS, LINK_PRESETS, LINK_SELFTESTS, LINK_TABLE_COUNT };
enum link_kind { LINK_REAL, LINK_WHOLE, LINK_CHOICE, LINK_BITS };
enum link_change { LINK_LIVE, LINK_RESTART, LINK_READ_ONLY };
enum { LINK_SYMBOL_WIDTH = 24, LINK_UNIT_WIDTH = 48, LINK_HELP_WIDTH = 149 };

/* What READ reads. */
enum link_place { LINK_IN_FORCE, LINK_STAGED, LINK_NOW, LINK_PLACE_COUNT };

/* What TABLE does: tells that of the set in force or of the staged one, or puts points into the staged one. */
enum link_table_act { LINK_TABLE_IN_FORCE, LINK_TABLE_STAGED, LINK_TABLE_PUT, LINK_TABLE_ACTS };

/* Beside the kind of load of a STEP: an explicit start, which leaves the safe state. */
enum { LINK_STARTS = 0x80 };

/* Of STEP's reply. */
enum { LINK_IS_FAULT = 1, LINK_WAS_CLAMPED = 2, LINK_WAS_CUT = 4, LINK_IS_STALE = 8, LINK_IS_SAFE = 16 };

/* Of VERDICT's reply. */
enum { LINK_IS_AUDIBLE = 1, LINK_IS_BISTABLE = 2 };

/* Of a study's request, and of POINT. */
enum { LINK_IS_WHOLE = 1 };
enum { LINK_IS_LOUD = 1, LINK_IS_UNDECIDED = 2 };

#endif
