/* Whose turn it is: console and link talk to one executive, and only one of them at a time may have an order or steps
 * under way. Whoever has the turn keeps it until its command is answered; the other's commands wait (console) or are
 * refused (link). Only a stop does not wait: turn_want() makes the other end early.
 *
 * The executive's one ring of samples belongs to one stream: it is refused to the other until that has ended. So is the
 * one study to whoever asks for a second. A study has a plant of its own and needs no turn. [MAIN] */
#ifndef PROTOCOL_TURN_H
#define PROTOCOL_TURN_H

#include <stdbool.h>

enum turn_side { TURN_NOBODY, TURN_CONSOLE, TURN_LINK };

/* All zero at the start. */
struct turn {
    enum turn_side holder, streams, studies;
    bool is_wanted; /* the holder should end early */
    bool is_stuck;  /* what the holder sends finds no room: its reader is slow, or has stopped */
};

/* True if the side has the turn now, or had it already. */
bool turn_take(struct turn *turn, enum turn_side side);

/* Gives it back, if the side has it. */
void turn_leave(struct turn *turn, enum turn_side side);

/* Asks the other side, if it has the turn, to end early. */
void turn_want(struct turn *turn, enum turn_side side);

/* The same for the ring of samples. */
bool turn_take_stream(struct turn *turn, enum turn_side side);
void turn_leave_stream(struct turn *turn, enum turn_side side);

/* The same for the study; false as well while the side's own is under way. */
bool turn_take_study(struct turn *turn, enum turn_side side);
void turn_leave_study(struct turn *turn, enum turn_side side);

#endif
