/* One row: what the firmware said against the truth. */
#ifndef MERIT_JUDGE_H
#define MERIT_JUDGE_H

#include "run.h"
#include "truth.h"

/* Everything that a row can get wrong; a row may have several. */
enum judge_fault {
    JUDGE_REFUSED, /* the firmware does not take the set */
    JUDGE_MISS,    /* loud, not called squeal */
    JUDGE_ASLEEP,  /* loud, but the firmware's plant has not begun to move: no fault of the detector, counted apart */
    JUDGE_SMALL,   /* loud, but smaller than the detector means to call: counted apart too */
    JUDGE_ALARM,   /* quiet, called squeal */
    JUDGE_FLASH,   /* quiet, called squeal on the way though the pad had not touched for long */
    JUDGE_WATCH,   /* quiet, called watch: no fault, but counted */
    JUDGE_CLASS,   /* a class that must agree does not */
    JUDGE_CUT,     /* a trial that was cut short has another verdict */
    JUDGE_PREDICTION, /* predicted the other verdict, beyond its margin */
    JUDGE_SATURATED,  /* numbers overflowed in a motion that is bounded */
    JUDGE_FAULTS
};

extern const char *const judge_fault_names[JUDGE_FAULTS];

struct judgement {
    bool has[JUDGE_FAULTS];
    bool is_class_asked;
};

/* Must the detector name this family? */
bool judge_asks_class(enum truth_family family);

struct judgement judge_row(const struct truth *truth, const struct run *run);

#endif
