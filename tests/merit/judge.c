/* The rules; README.md says them in words. */
#include "judge.h"

/* Seven e-folds leave a thousandth, the detector's own tolerance: before that a transient that dies out is to be
 * seen. */
#define FOLDS_VISIBLE (-7.0)
#define SLEEP_SHARE 0.1 /* of the true motion */
#define MOTION_CALLED (1.0 / 32.0)
#define MOTION_FLOOR \
    (1.01 / 64.0) /* of the disc's speed: what moves less is `rest` to the detector, and 1 % to spare */

const char *const judge_fault_names[JUDGE_FAULTS] = {"refused", "miss",  "asleep", "small",      "false-alarm", "flash",
                                                     "watch",   "class", "cut",    "prediction", "saturated"};

bool judge_asks_class(enum truth_family family) { return family <= TRUTH_STICKSLIP_3; }

static bool is_class_right(const struct truth *truth, const struct run *run)
{
    const bool may_decay = truth->folds > FOLDS_VISIBLE && run->motion == CLASS_DECAYING;

    if (truth->family == TRUTH_REST) {
        return run->motion == CLASS_REST || may_decay;
    }
    if (truth->family == TRUTH_FORCED) {
        return (run->motion == CLASS_FORCED && run->period == truth->multiplicity) || may_decay ||
               (run->motion == CLASS_REST && truth->motion_ratio <= MOTION_FLOOR);
    }
    return run->motion == CLASS_STICKSLIP && run->period == truth->multiplicity;
}

/* What begins below the firmware's rounding may stay there, or start late. Its plant has nothing to show then. */
static bool is_asleep(const struct truth *truth, const struct run *run)
{
    const double motion = truth->family == TRUTH_DIVERGING ? 1.0 : truth->motion_ratio;

    return motion > MOTION_FLOOR && (double)run->speed_ratio < SLEEP_SHARE * motion;
}

/* A self-excited motion has to exceed two floors. At the knee of a friction floor limit cycles begin from nothing. */
static bool is_small(const struct truth *truth)
{
    return (truth->family == TRUTH_LIMITCYCLE_SLIP || truth->family == TRUTH_APERIODIC) &&
           truth->motion_ratio <= MOTION_CALLED;
}

struct judgement judge_row(const struct truth *truth, const struct run *run)
{
    const bool is_loud = truth->kind == TRUTH_LOUD;
    const bool is_quiet = truth->kind == TRUTH_QUIET;
    const bool is_uncalled = is_loud && run->propensity != PROPENSITY_SQUEAL;
    struct judgement judgement = {.has = {false}};
    bool *has = judgement.has;

    has[JUDGE_REFUSED] = run->is_refused;
    if (run->is_refused) {
        return judgement;
    }
    judgement.is_class_asked = (is_loud || is_quiet) && truth->is_settled && judge_asks_class(truth->family);
    has[JUDGE_SMALL] = is_uncalled && is_small(truth);
    has[JUDGE_ASLEEP] = is_uncalled && !is_small(truth) && is_asleep(truth, run);
    has[JUDGE_MISS] = is_uncalled && !has[JUDGE_SMALL] && !has[JUDGE_ASLEEP];
    has[JUDGE_ALARM] = is_quiet && run->propensity == PROPENSITY_SQUEAL;
    has[JUDGE_FLASH] = is_quiet && run->has_flash;
    has[JUDGE_WATCH] = is_quiet && run->propensity == PROPENSITY_WATCH;
    has[JUDGE_CLASS] = judgement.is_class_asked && !is_class_right(truth, run);
    has[JUDGE_CUT] = (is_loud || is_quiet) && run->cut_propensity != run->propensity;
    has[JUDGE_PREDICTION] =
        (is_loud && run->predicted == PREDICTION_QUIET) || (is_quiet && run->predicted == PREDICTION_SQUEAL);
    has[JUDGE_SATURATED] = truth->family != TRUTH_DIVERGING && run->saturations > 0u;
    return judgement;
}
