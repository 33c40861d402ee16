/* How far a parameter is from the border of squeal: first a ladder away from its value until the verdict changes, then
 * halving until the bracket is a thousandth wide. It hands out sets and is told what became of them.
 *
 *   margin_begin -> margin_next -> (trial) -> margin_take -> margin_next ... false: below and above are known
 *
 * The nearest border is the nearest that the ladder's rungs (9 %, 30 %, 83 %, 270 %, ... of the value) do not step
 * over: an island of squeal narrower than a rung can be missed. */
#ifndef SIM_MARGIN_H
#define SIM_MARGIN_H

#include <stdbool.h>
#include <stdint.h>

#include "model/params.h"

#define MARGIN_WIDTH 1e-3f          /* of a bracket, relative */
#define MARGIN_FACTOR_DEFAULT 16.0f /* how far to look: from value/16 to 16 value */
#define MARGIN_FACTOR_LOW 1.001f
#define MARGIN_FACTOR_HIGH 1e6f

enum margin_answer { MARGIN_QUIET, MARGIN_LOUD, MARGIN_REFUSED };

/* Which way to turn the parameter for less squeal; ANY: no border was seen and all is quiet. */
enum margin_way { MARGIN_NO_WAY, MARGIN_DOWN, MARGIN_UP, MARGIN_ANY };

enum margin_stage { MARGIN_CLIMBS, MARGIN_HALVES };

struct margin_side {
    bool has_border;
    float quiet, loud; /* the bracket, SI */
    float searched;    /* the farthest value that was tried */
};

struct margin {
    struct params base;
    const struct params_info *info;
    float value, factor;
    bool is_loud; /* at the value itself */
    struct margin_side sides[2];
    /* the search */
    uint8_t side;  /* 0 below, 1 above, 2 done */
    uint8_t stage; /* enum margin_stage */
    uint32_t rung, halvings;
    float tried;
};

/* Is the parameter one whose border is asked for: an amount of the pad, its friction, its load or its disc that acts
 * once the profiles have come to rest? [ANY, pure] */
bool margin_covers(const struct params *params, const struct params_info *info);

/* is_loud: what a trial of the base said. [MAIN] */
void margin_begin(struct margin *margin, const struct params *base, const struct params_info *info, float factor,
                  bool is_loud);

/* The next set to try; false when both sides are known. [MAIN] */
bool margin_next(struct margin *margin, struct params *params);

/* What became of it. [MAIN] */
void margin_take(struct margin *margin, enum margin_answer answer);

/* Middle of a bracket. [ANY, pure] */
float margin_border(const struct margin_side *side);

/* [ANY, pure] */
enum margin_way margin_quiets(const struct margin *margin);
const char *margin_way_name(enum margin_way way);

#endif
