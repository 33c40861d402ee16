/* What a case is drawn from. */
#include "draw.h"

#include <math.h>
#include <stdlib.h>

#include "sim/sim.h"

#define TAU 6.283185307179586
#define NO_FLOOR (-1e30)

/* Enough e-folds for the oracle to find what is left of a transient below 1e-6; growth has further to go. */
#define FOLDS_DECAY 16.0
#define FOLDS_GROWTH 24.0
#define TRANSIENT_LEAST 600.0
#define TRANSIENT_MOST 6000.0
#define WINDOW 200.0

const char *const draw_kind_names[DRAW_KINDS] = {"soft", "brake", "damped", "floored", "reversed"};

/* Six digits, which is what the table says. */
static double rounded(double value)
{
    char text[32];

    (void)snprintf(text, sizeof text, "%.6g", value);
    return strtod(text, NULL);
}

/* About the paper's Table 1 and the ranges of its figures. */
static void draw_soft(struct dice *dice, struct set *set)
{
    set->m = dice_log(dice, 0.1, 1.0);
    set->ke = dice_log(dice, 0.5, 20.0);
    set->c = dice_log(dice, 0.003, 0.1);
    set->N0 = dice_log(dice, 0.3, 50.0);
    set->alpha = -dice_log(dice, 5e-4, 0.1);
    set->v0 = dice_log(dice, 0.3, 6.0);
    set->mus = dice_log(dice, 0.1, 0.8);
}

/* A brake whose pad rings at 1 to 12 kHz; the slope of friction is drawn as N |alpha|/c. */
static void draw_brake(struct dice *dice, struct set *set)
{
    const double omega = TAU * dice_log(dice, 1000.0, 12000.0);

    set->ke = dice_log(dice, 1e6, 1e9);
    set->m = set->ke / (omega * omega);
    set->c = dice_log(dice, 0.004, 0.1) * sqrt(set->m * set->ke);
    set->N0 = dice_log(dice, 100.0, 10000.0);
    set->alpha = -dice_log(dice, 0.05, 5.0) * set->c / set->N0;
    set->v0 = dice_log(dice, 0.01, 10.0);
    set->mus = dice_log(dice, 0.2, 0.7);
}

static void draw_mechanics(struct dice *dice, struct set *set, bool is_brake)
{
    if (is_brake) {
        draw_brake(dice, set);
    } else {
        draw_soft(dice, set);
    }
    set->kt = set->ke * dice_log(dice, 0.05, 4.0);
    set->k = set->ke * dice_log(dice, 0.05, 4.0);
}

static void draw_normal_damping(struct dice *dice, struct set *set)
{
    set->cn = dice_log(dice, 0.01, 0.3) * sqrt(set->m * set->ke);
}

static double period_s(const struct set *set) { return TAU * sqrt(set->m / set->ke); }

static void round_all(struct set *set)
{
#define INPUT(field, name) set->name = rounded(set->name);
#define OUTPUT(name)
#include "tests/oracle/columns.def"
#undef INPUT
#undef OUTPUT
}

/* Half the cases are loaded at once from rest, a quarter start in the equilibrium of the normal direction, as exactly
 * as the table can say it, and a quarter ramp up. */
static void draw_start(struct dice *dice, struct set *set)
{
    switch (dice_choice(dice, 4)) {
    case 0:
        set->y0 = set->N0 / set->ke;
        break;
    case 1:
        set->ntype = LOAD_RAMP;
        set->N1 = set->N0;
        set->N0 = 0.0;
        set->t2 = rounded(period_s(set) * dice_log(dice, 5.0, 500.0));
        break;
    default:
        break;
    }
}

/* Long enough for the slowest of both directions, by their rates in permanent slip, after the load has come and the
 * spring has broken the first ride of the pad on the disc. */
static void choose_span(struct set *set)
{
    const double load = set->ntype > 0.0 ? set->N1 : set->N0;
    const bool is_on_floor = set->mus + set->alpha * fabs(set->v0) <= set->mumin;
    const double slope = is_on_floor ? 0.0 : set->alpha;
    const double growth = -(set->c + load * slope) / (2.0 * set->m) * period_s(set);
    const double decay = set->cn / (2.0 * set->m) * period_s(set);
    const double ride_s = set->mus * load / ((set->k + set->kt) * fabs(set->v0));
    double wait = (growth > 0.0 ? FOLDS_GROWTH : FOLDS_DECAY) / fmax(fabs(growth), 1e-6);

    wait = fmax(wait, decay > 0.0 ? FOLDS_DECAY / decay : 0.0);
    wait = fmin(fmax(wait, TRANSIENT_LEAST), TRANSIENT_MOST);
    set->ntrans = ceil(wait + (set->t2 + ride_s) / period_s(set));
    set->nwin = WINDOW;
}

struct set draw_set(struct dice *dice, enum draw_kind kind)
{
    const enum draw_kind base = kind == DRAW_REVERSED ? (enum draw_kind)dice_choice(dice, DRAW_REVERSED) : kind;
    struct set set = {.mumin = NO_FLOOR};

    draw_mechanics(dice, &set, base == DRAW_BRAKE || (base != DRAW_SOFT && dice_choice(dice, 2) == 1));
    if (base == DRAW_DAMPED || (base == DRAW_FLOORED && dice_choice(dice, 2) == 1)) {
        draw_normal_damping(dice, &set);
    }
    if (base == DRAW_FLOORED) {
        set.mumin = set.mus * dice_uniform(dice, 0.3, 0.95);
    }
    if (kind == DRAW_REVERSED) {
        set.v0 = -set.v0;
    }
    round_all(&set);
    draw_start(dice, &set);
    choose_span(&set);
    return set;
}

static bool is_refused(const struct set *set)
{
    const struct params params = set_params(set, ARITH_F32);
    struct sim_plan plan;

    return params_check(&params).error != ERROR_OK || sim_plan_make(&plan, &params, NULL).error != ERROR_OK;
}

long draw_table(FILE *file, long count, uint64_t seed)
{
    struct dice dice = {seed};
    long refused = 0;

    (void)fputs("case", file);
#define INPUT(field, name) (void)fputs("," #name, file);
#define OUTPUT(name)
#include "tests/oracle/columns.def"
#undef INPUT
    (void)fputs(",ntrans,nwin\n", file);
    for (long i = 0; i < count; i++) {
        const enum draw_kind kind = (enum draw_kind)(i % DRAW_KINDS);
        struct set set = draw_set(&dice, kind);

        while (is_refused(&set)) {
            refused++;
            set = draw_set(&dice, kind);
        }
        (void)fprintf(file, "%s-%05ld", draw_kind_names[kind], i);
#define INPUT(field, name) (void)fprintf(file, ",%.12g", set.name);
#include "tests/oracle/columns.def"
#undef INPUT
#undef OUTPUT
        (void)fprintf(file, ",%.0f,%.0f\n", set.ntrans, set.nwin);
    }
    return refused;
}
