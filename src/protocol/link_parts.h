/* What the link's parts share. Not for anybody else. */
#ifndef PROTOCOL_LINK_PARTS_H
#define PROTOCOL_LINK_PARTS_H

#include "base/errors.h"
#include "protocol/link.h"

/* A request's function is called again and again until the request is answered, never while an order waits. */
enum link_progress {
    LINK_WAITS,    /* for the interrupt, or for the line */
    LINK_ADVANCES, /* something was given to the interrupt */
    LINK_ANSWERED
};

/* Sends link->reply, which the function has filled, and sends nothing else. */
enum link_progress link_answer(struct link *link);

/* The same for a reply that was made when the plant stood at another step. */
enum link_progress link_answer_from(struct link *link, uint32_t step);

/* Why not: all but the error may be left out. */
struct link_refusal {
    enum error error;
    bool has_index;
    uint8_t index;     /* the parameter, or the field of the request, to blame */
    uint32_t expected; /* sequence, step, length, version or CRC */
    float low, high;   /* what would have been accepted */
};

enum link_progress link_refuse(struct link *link, const struct link_refusal *refusal);

/* OUT_OF_RANGE for a field of the request. */
enum link_progress link_refuse_field(struct link *link, uint8_t field, float low, float high);

/* What is wrong with a set. */
enum link_progress link_refuse_problem(struct link *link, const struct params_problem *problem);

enum link_progress link_refuse_plain(struct link *link, enum error error);

/* Is there room for a frame that comes by itself, and a reply after it? */
bool link_has_room(const struct link *link);

/* May the plant, which stands as the report says, be stepped or copied from here? Takes the turn. ERROR_OK, or why
 * not. */
enum error link_find_obstacle(struct link *link, const struct executive_report *report);

/* Samples of the link's stream: is one waiting, those written or lost since it began. */
bool link_has_sample(const struct link *link);
uint32_t link_dropped(const struct link *link);

/* Writes samples as far as they leave room for a reply. Returns true if there was one, written or not. */
bool link_write_samples(struct link *link);

/* Goes on with the link's study, and sends what it has to tell. Returns true if there is one that can go on. */
bool link_continue_study(struct link *link);

/* Ends the link's study, if it has one; false as long as there is no room to say so. */
bool link_end_study(struct link *link);

/* A number in SI; what is none is always the same NaN. */
void link_put_value(struct bytes_writer *writer, float value);

/* The set that COMMIT would put into force, which follows the set in force whenever that changes. */
struct params *link_staged(struct link *link);

/* CRC-32 over the floats of a set in the order of the table, low byte first, and behind them over each table of
 * breakpoints: their count as a byte, and their times and values in turn. */
uint32_t link_crc(const struct params *params);

/* One for each row of messages.def. */
#define MESSAGE(type, field, name, request, reply, help) enum link_progress link_##name(struct link *link);
#include "protocol/messages.def"
#undef MESSAGE

#endif
