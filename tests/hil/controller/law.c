/* Two questions a turn: which phase, and what pressure it wants. */
#include "law.h"

#include "base/fmath.h"

enum { DITHER_HALF_TURNS = 2 };

struct law_settings law_usual(float turn_s)
{
    return (struct law_settings){
        .turn_s = turn_s,
        .build_pa_per_s = 130e5f,
        .build_least_pa_per_s = 15e5f,
        .careful_ratio = 0.125f,
        .release_pa_per_s = 650e5f,
        .ease_per_s = 2.0f,
        .keep_ratio = 0.55f,
        .lower_ratio = 0.8f,
        .dither_ratio = 0.01f,
        .hold_s = 0.02f,
        .calm_s = 0.06f,
        .patience_s = 0.08f,
    };
}

struct law law_start(const struct law_settings *settings)
{
    return (struct law){.phase = LAW_BUILD, .build_pa_per_s = settings->build_pa_per_s};
}

static void enter(struct law *law, enum law_phase phase)
{
    law->phase = phase;
    law->phase_turns = 0u;
    law->quiet_turns = 0u;
}

/* To the nearest turn. */
static bool lasts(uint32_t turns, float time_s, const struct law_settings *settings)
{
    return ((float)turns + 0.5f) * settings->turn_s >= time_s;
}

/* What was heard at this pressure must not be heard again: further down now, and more slowly up next time. */
static void back_off(struct law *law, const struct law_settings *settings)
{
    law->squeals++;
    law->low_pa = settings->keep_ratio * law->wanted_pa;
    law->build_pa_per_s = fmath_max(settings->careful_ratio * law->build_pa_per_s, settings->build_least_pa_per_s);
    enter(law, LAW_RELEASE);
}

static void decide_in_dither(struct law *law, const struct law_settings *settings)
{
    if (lasts(law->quiet_turns, settings->calm_s, settings)) {
        enter(law, LAW_BUILD);
    } else if (law->quiet_turns == 0u && lasts(law->phase_turns, settings->patience_s, settings)) {
        law->low_pa *= settings->lower_ratio;
        enter(law, LAW_RELEASE);
    }
}

static void decide(struct law *law, const struct law_settings *settings, uint8_t propensity)
{
    switch (law->phase) {
    case LAW_BUILD:
    case LAW_HOLD:
        if (propensity == PROPENSITY_SQUEAL) {
            back_off(law, settings);
        } else if (law->phase == LAW_BUILD && propensity == PROPENSITY_WATCH) {
            enter(law, LAW_HOLD);
        } else if (law->phase == LAW_HOLD && lasts(law->quiet_turns, settings->hold_s, settings)) {
            enter(law, LAW_BUILD);
        }
        break;
    case LAW_RELEASE:
        if (law->wanted_pa <= law->low_pa) {
            enter(law, LAW_DITHER);
        }
        break;
    case LAW_DITHER:
        decide_in_dither(law, settings);
        break;
    case LAW_SAFE:
    default:
        break;
    }
}

static float dithered(const struct law *law, const struct law_settings *settings)
{
    const bool is_up = law->phase_turns / DITHER_HALF_TURNS % 2u == 0u;

    return law->low_pa * (1.0f + (is_up ? settings->dither_ratio : -settings->dither_ratio));
}

static float wanted(const struct law *law, const struct law_settings *settings)
{
    switch (law->phase) {
    case LAW_BUILD:
        return law->wanted_pa + law->build_pa_per_s * settings->turn_s;
    case LAW_HOLD:
        return law->wanted_pa * (1.0f - settings->ease_per_s * settings->turn_s);
    case LAW_RELEASE:
        return fmath_max(law->wanted_pa - settings->release_pa_per_s * settings->turn_s, law->low_pa);
    case LAW_DITHER:
        return dithered(law, settings);
    case LAW_SAFE:
    default:
        return 0.0f;
    }
}

struct law law_next(const struct law_settings *settings, const struct law *now, const struct law_inputs *inputs)
{
    struct law next = *now;

    if (now->phase == LAW_SAFE || !inputs->is_sound) {
        enter(&next, LAW_SAFE);
        next.wanted_pa = 0.0f;
        next.pressure_pa = 0.0f;
        return next;
    }
    if (!(inputs->demand_pa > 0.0f)) {
        return law_start(settings);
    }
    next.phase_turns++;
    next.quiet_turns = inputs->propensity == PROPENSITY_QUIET ? next.quiet_turns + 1u : 0u;
    decide(&next, settings, inputs->propensity);
    next.wanted_pa = fmath_min(wanted(&next, settings), inputs->demand_pa);
    next.pressure_pa = fmath_min(0.5f * (now->wanted_pa + next.wanted_pa), inputs->demand_pa);
    return next;
}

const char *law_phase_name(enum law_phase phase)
{
    static const char *const names[] = {"build", "hold", "release", "dither", "safe"};

    return names[phase];
}
