/* Ladder and bracket. */
#include "sim/margin.h"

#include "base/fmath.h"

enum {
    BELOW,
    ABOVE,
    DONE,
    HALVINGS_MAX = 40, /* a border at 0 is never bracketed by ratio */
    RUNGS_FROM_NOTHING = 12
};

#define IS(field) (info->offset == offsetof(struct params, field))

bool margin_covers(const struct params *params, const struct params_info *info)
{
    const int load = (int)params->load_profile;
    const int speed = (int)params->speed_profile;

    if (IS(load_n)) {
        return load == LOAD_CONSTANT || load == LOAD_SINE;
    }
    if (IS(load_end_n)) {
        return load != LOAD_CONSTANT && load != LOAD_TABLE;
    }
    if (IS(speed_m_per_s)) {
        return speed == SPEED_CONSTANT || speed == SPEED_SINE || speed == SPEED_INERTIA;
    }
    if (IS(speed_end_m_per_s)) {
        return speed == SPEED_STEP || speed == SPEED_RAMP || speed == SPEED_PULSES || speed == SPEED_SINE;
    }
    if (IS(friction_floor_ratio)) {
        return params->friction_floor_ratio > -1e29f;
    }
    return IS(mass_kg) || IS(damping_n_s_per_m) || IS(stiffness_normal_n_per_m) || IS(stiffness_contact_n_per_m) ||
           IS(stiffness_caliper_n_per_m) || IS(damping_normal_n_s_per_m) || IS(friction_static_ratio) ||
           IS(friction_slope_s_per_m);
}

/* What a parameter that is 0 is measured against: the amount that makes its dimensionless group 1. */
static float natural_unit(const struct params *params, const struct params_info *info)
{
    const float impedance = fmath_sqrt(params->mass_kg) * fmath_sqrt(params->stiffness_normal_n_per_m);
    const float load = fmath_max(fmath_max(params->load_n, params->load_end_n), 1e-6f);

    if (IS(damping_n_s_per_m) || IS(damping_normal_n_s_per_m)) {
        return impedance;
    }
    if (IS(stiffness_contact_n_per_m) || IS(stiffness_caliper_n_per_m)) {
        return params->stiffness_normal_n_per_m;
    }
    if (IS(load_n) || IS(load_end_n)) {
        return fmath_max(fmath_abs(params->speed_m_per_s), 1e-6f) * impedance;
    }
    if (IS(speed_m_per_s) || IS(speed_end_m_per_s)) {
        return load / impedance;
    }
    return IS(friction_slope_s_per_m) ? impedance / load : 1.0f;
}

/* Value of a rung; false if there is none. From a value: by ratios that square, away to the factor or in to its
 * inverse. From 0: by powers of two up from a thousandth of the natural unit. */
static bool rung_value(const struct margin *margin, float *value)
{
    const float sign = margin->side == ABOVE ? 1.0f : -1.0f;
    const bool is_outward = margin->value * sign > 0.0f;
    const float widest = fmath_log2(margin->factor);
    const float exponent = ((float)(1u << margin->rung) - 1.0f) / 8.0f;
    const float before = ((float)(1u << (margin->rung - 1u)) - 1.0f) / 8.0f;

    if (margin->value == 0.0f) {
        *value = sign * natural_unit(&margin->base, margin->info) * fmath_exp2((float)margin->rung - 11.0f);
        return margin->rung <= RUNGS_FROM_NOTHING;
    }
    *value = margin->value * fmath_exp2(is_outward ? fmath_min(exponent, widest) : -fmath_min(exponent, widest));
    return before < widest;
}

static void begin_side(struct margin *margin, uint8_t side)
{
    margin->side = side;
    margin->stage = MARGIN_CLIMBS;
    margin->rung = 1u;
    margin->halvings = 0u;
    if (side != DONE) {
        margin->sides[side] = (struct margin_side){.searched = margin->value};
    }
}

void margin_begin(struct margin *margin, const struct params *base, const struct params_info *info, float factor,
                  bool is_loud)
{
    margin->base = *base;
    margin->info = info;
    margin->value = params_value(base, info);
    margin->factor = factor;
    margin->is_loud = is_loud;
    begin_side(margin, BELOW);
}

float margin_border(const struct margin_side *side)
{
    if ((side->quiet > 0.0f && side->loud > 0.0f) || (side->quiet < 0.0f && side->loud < 0.0f)) {
        const float middle = fmath_sqrt(fmath_abs(side->quiet)) * fmath_sqrt(fmath_abs(side->loud));

        return side->quiet < 0.0f ? -middle : middle;
    }
    return 0.5f * (side->quiet + side->loud);
}

static bool is_narrow(const struct margin_side *side)
{
    return fmath_abs(side->quiet - side->loud) <=
           MARGIN_WIDTH * fmath_max(fmath_abs(side->quiet), fmath_abs(side->loud));
}

/* The rung inside the parameter's limits, or the limit itself if it was not reached yet; false at the ladder's end. */
static bool climb(struct margin *margin)
{
    const struct params_info *info = margin->info;
    const float searched = margin->sides[margin->side].searched;

    if (!rung_value(margin, &margin->tried)) {
        return false;
    }
    margin->tried = fmath_min(fmath_max(margin->tried, info->low), info->high);
    return margin->tried != searched;
}

bool margin_next(struct margin *margin, struct params *params)
{
    while (margin->side != DONE) {
        const struct margin_side *side = &margin->sides[margin->side];
        bool has_value;

        if (margin->stage == MARGIN_CLIMBS) {
            has_value = climb(margin);
        } else {
            has_value = !is_narrow(side) && margin->halvings++ < HALVINGS_MAX;
            margin->tried = margin_border(side);
        }
        if (has_value) {
            *params = margin->base;
            params_set(params, margin->info, margin->tried);
            return true;
        }
        begin_side(margin, (uint8_t)(margin->side + 1u));
    }
    return false;
}

void margin_take(struct margin *margin, enum margin_answer answer)
{
    struct margin_side *side = &margin->sides[margin->side];
    const bool is_loud = answer == MARGIN_LOUD;

    if (answer == MARGIN_REFUSED) {
        begin_side(margin, (uint8_t)(margin->side + 1u)); /* what was found on this side stays */
        return;
    }
    if (margin->stage == MARGIN_CLIMBS) {
        if (is_loud != margin->is_loud) {
            side->has_border = true;
            side->quiet = is_loud ? side->searched : margin->tried;
            side->loud = is_loud ? margin->tried : side->searched;
            margin->stage = MARGIN_HALVES;
        }
        side->searched = margin->tried;
        margin->rung++;
    } else if (is_loud) {
        side->loud = margin->tried;
    } else {
        side->quiet = margin->tried;
    }
}

/* How far the border of a side is: by ratio, or from 0 by difference. */
static float distance(const struct margin *margin, uint8_t side)
{
    const float border = margin_border(&margin->sides[side]);

    return margin->value == 0.0f ? fmath_abs(border) : fmath_abs(fmath_log2(border / margin->value));
}

/* The nearer border of the two; DONE if there is none. */
static uint8_t nearest(const struct margin *margin)
{
    const struct margin_side *below = &margin->sides[BELOW];
    const struct margin_side *above = &margin->sides[ABOVE];

    if (below->has_border && above->has_border) {
        return distance(margin, BELOW) <= distance(margin, ABOVE) ? BELOW : ABOVE;
    }
    if (!below->has_border && !above->has_border) {
        return DONE;
    }
    return below->has_border ? BELOW : ABOVE;
}

enum margin_way margin_quiets(const struct margin *margin)
{
    const uint8_t side = nearest(margin);

    if (side == DONE) {
        return margin->is_loud ? MARGIN_NO_WAY : MARGIN_ANY;
    }
    if (!margin->is_loud && margin->value == 0.0f && margin->sides[BELOW].has_border &&
        margin->sides[ABOVE].has_border) {
        return MARGIN_NO_WAY;
    }
    return (side == BELOW) == margin->is_loud ? MARGIN_DOWN : MARGIN_UP;
}

const char *margin_way_name(enum margin_way way)
{
    static const char *const names[] = {"none", "down", "up", "any"};

    return (unsigned)way < sizeof names / sizeof names[0] ? names[way] : "?";
}
