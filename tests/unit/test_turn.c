/* Whose turn it is. */
#include "protocol/turn.h"

#include "tap.h"
#include "tests.h"

void test_turn(void)
{
    struct turn turn = {.holder = TURN_NOBODY};

    turn_want(&turn, TURN_LINK);
    tap_check(!turn.is_wanted, "nobody is asked to end what nobody has begun");
    tap_check(turn_take(&turn, TURN_CONSOLE) && turn_take(&turn, TURN_CONSOLE), "who has the turn has it");
    tap_check(!turn_take(&turn, TURN_LINK), "the other has not");
    turn_want(&turn, TURN_CONSOLE);
    tap_check(!turn.is_wanted, "nobody asks himself");
    turn_want(&turn, TURN_LINK);
    tap_check(turn.is_wanted, "but the other can ask");
    turn_leave(&turn, TURN_LINK);
    tap_check(!turn_take(&turn, TURN_LINK), "what one has not, one cannot leave");
    turn_leave(&turn, TURN_CONSOLE);
    tap_check(!turn.is_wanted && turn_take(&turn, TURN_LINK),
              "once it is left the other gets it, and nothing is asked");
    tap_check(turn_take_stream(&turn, TURN_LINK) && turn_take_stream(&turn, TURN_LINK) &&
                  !turn_take_stream(&turn, TURN_CONSOLE),
              "one stream at a time");
    turn_leave_stream(&turn, TURN_CONSOLE);
    turn_leave_stream(&turn, TURN_LINK);
    tap_check(turn_take_stream(&turn, TURN_CONSOLE), "the other when it has ended");
    tap_check(turn_take_study(&turn, TURN_LINK) && !turn_take_study(&turn, TURN_CONSOLE) &&
                  !turn_take_study(&turn, TURN_LINK),
              "one study at a time, whoever asks for a second");
    turn_leave_study(&turn, TURN_CONSOLE);
    tap_check(!turn_take_study(&turn, TURN_CONSOLE), "which the other cannot end");
    turn_leave_study(&turn, TURN_LINK);
    tap_check(turn_take_study(&turn, TURN_CONSOLE), "and the next when it has ended");
}
