#include "protocol/turn.h"

bool turn_take(struct turn *turn, enum turn_side side)
{
    if (turn->holder == TURN_NOBODY) {
        turn->holder = side;
    }
    return turn->holder == side;
}

void turn_leave(struct turn *turn, enum turn_side side)
{
    if (turn->holder == side) {
        turn->holder = TURN_NOBODY;
        turn->is_wanted = false;
        turn->is_stuck = false;
    }
}

void turn_want(struct turn *turn, enum turn_side side)
{
    turn->is_wanted = turn->is_wanted || (turn->holder != TURN_NOBODY && turn->holder != side);
}

bool turn_take_stream(struct turn *turn, enum turn_side side)
{
    if (turn->streams == TURN_NOBODY) {
        turn->streams = side;
    }
    return turn->streams == side;
}

void turn_leave_stream(struct turn *turn, enum turn_side side)
{
    if (turn->streams == side) {
        turn->streams = TURN_NOBODY;
    }
}

bool turn_take_study(struct turn *turn, enum turn_side side)
{
    if (turn->studies != TURN_NOBODY) {
        return false;
    }
    turn->studies = side;
    return true;
}

void turn_leave_study(struct turn *turn, enum turn_side side)
{
    if (turn->studies == side) {
        turn->studies = TURN_NOBODY;
    }
}
