/* The control law of the controller: each arrow of its picture, each promise of its header. */
#include "hil/controller/law.h"

#include "tap.h"
#include "tests.h"

/* Round numbers: a turn is 10 ms; a turn of building is 1000 Pa, of releasing 4000 Pa, of easing a hundredth. */
static const struct law_settings settings = {
    .turn_s = 0.01f,
    .build_pa_per_s = 1e5f,
    .build_least_pa_per_s = 2e4f,
    .careful_ratio = 0.25f,
    .release_pa_per_s = 4e5f,
    .ease_per_s = 1.0f,
    .keep_ratio = 0.5f,
    .lower_ratio = 0.8f,
    .dither_ratio = 0.1f,
    .hold_s = 0.03f,
    .calm_s = 0.05f,
    .patience_s = 0.07f,
};

static struct law law; /* bounds of the applied pressure are looked at below; all else is what the phase wants */

static void turn(uint8_t propensity, float demand_pa)
{
    const struct law_inputs inputs = {.demand_pa = demand_pa, .propensity = propensity, .is_sound = true};

    law = law_next(&settings, &law, &inputs);
}

static void turns(unsigned count, uint8_t propensity)
{
    for (; count > 0u; count--) {
        turn(propensity, 1e6f);
    }
}

/* Built up to 10000 Pa. */
static void build(void)
{
    law = law_start(&settings);
    turns(10u, PROPENSITY_QUIET);
}

static void check_build(void)
{
    law = law_start(&settings);
    tap_check(law.phase == LAW_BUILD && law.pressure_pa == 0.0f, "it starts without pressure");
    build();
    tap_check_close(law.wanted_pa, 10000.0f, 0.1f, "pressure is built up at its rate");
    turn(PROPENSITY_QUIET, 10500.0f);
    tap_check(law.wanted_pa == 10500.0f, "and not beyond the demand");
    turn(PROPENSITY_QUIET, 3000.0f);
    tap_check(law.pressure_pa == 3000.0f, "a driver who lets go is obeyed at once");
    turns(3u, PROPENSITY_UNKNOWN);
    tap_check(law.phase == LAW_BUILD, "what is not known yet does not keep it from building");
}

static void check_hold(void)
{
    build();
    turn(PROPENSITY_WATCH, 1e6f);
    tap_check(law.phase == LAW_HOLD, "growth: hold");
    tap_check_close(law.wanted_pa, 9900.0f, 0.1f, "the pressure is eased");
    turns(2u, PROPENSITY_QUIET);
    turn(PROPENSITY_WATCH, 1e6f);
    turns(2u, PROPENSITY_QUIET);
    tap_check(law.phase == LAW_HOLD, "quiet must last");
    turn(PROPENSITY_QUIET, 1e6f);
    tap_check(law.phase == LAW_BUILD && law.build_pa_per_s == settings.build_pa_per_s,
              "then it builds up as before, for nothing was heard");
    turn(PROPENSITY_WATCH, 1e6f);
    turn(PROPENSITY_SQUEAL, 1e6f);
    tap_check(law.phase == LAW_RELEASE && law.squeals == 1u, "squeal out of the hold is squeal");
}

static void check_release(void)
{
    build();
    turn(PROPENSITY_SQUEAL, 1e6f);
    tap_check(law.phase == LAW_RELEASE && law.low_pa > 4999.0f && law.low_pa < 5001.0f,
              "squeal: release to half of it");
    tap_check_close(law.wanted_pa, 6000.0f, 0.1f, "at its rate");
    turn(PROPENSITY_SQUEAL, 1e6f);
    tap_check(law.phase == LAW_RELEASE && law.wanted_pa == law.low_pa, "and not below");
    turn(PROPENSITY_SQUEAL, 1e6f);
    tap_check(law.phase == LAW_DITHER && law.squeals == 1u, "then dither, the same squeal still in the ear");
}

static void check_dither(void)
{
    float low = 1e9f, high = 0.0f, sum = 0.0f;

    build();
    turns(3u, PROPENSITY_SQUEAL);
    for (unsigned i = 0u; i < 4u; i++) {
        turn(PROPENSITY_WATCH, 1e6f);
        low = law.wanted_pa < low ? law.wanted_pa : low;
        high = law.wanted_pa > high ? law.wanted_pa : high;
        sum += law.wanted_pa;
    }
    tap_check_close(high, 5500.0f, 1.0f, "the dither's upper end");
    tap_check_close(low, 4500.0f, 1.0f, "its lower end");
    tap_check_close(sum / 4.0f, 5000.0f, 1.0f, "about the low pressure");
    turns(3u, PROPENSITY_SQUEAL);
    tap_check(law.phase == LAW_RELEASE, "patience has an end");
    tap_check_close(law.low_pa, 4000.0f, 1.0f, "and a next step down");
    turns(2u, PROPENSITY_SQUEAL);
    tap_check(law.phase == LAW_DITHER && law.squeals == 1u, "no second squeal is counted for it");
    turns(4u, PROPENSITY_QUIET);
    tap_check(law.phase == LAW_DITHER, "quiet must last here too");
    turn(PROPENSITY_QUIET, 1e6f);
    tap_check(law.phase == LAW_BUILD && law.build_pa_per_s == 25000.0f, "then it builds up a quarter as fast");
    turn(PROPENSITY_SQUEAL, 1e6f);
    tap_check(law.build_pa_per_s == settings.build_least_pa_per_s, "but never slower than the least");
    tap_check(law.squeals == 2u, "the second squeal");
}

/* Every jump that the law makes by itself is made in two halves. */
static void check_halves(void)
{
    float before;

    build();
    tap_check_close(law.pressure_pa, 9500.0f, 0.1f, "half way between two turns while it rises");
    before = law.wanted_pa;
    turn(PROPENSITY_SQUEAL, 1e6f);
    tap_check_close(law.pressure_pa, 0.5f * (before + law.wanted_pa), 0.1f, "and where it turns back");
    turns(3u, PROPENSITY_SQUEAL);
    tap_check_close(law.pressure_pa, 5500.0f, 0.1f, "the dither's upper end");
    turn(PROPENSITY_SQUEAL, 1e6f);
    tap_check_close(law.pressure_pa, 5000.0f, 0.1f, "one half of its jump");
    turn(PROPENSITY_SQUEAL, 1e6f);
    tap_check_close(law.pressure_pa, 4500.0f, 0.1f, "and the other");
}

static void check_patience(void)
{
    build();
    turns(3u, PROPENSITY_SQUEAL);
    turns(5u, PROPENSITY_WATCH);
    turns(4u, PROPENSITY_QUIET);
    tap_check(law.phase == LAW_DITHER, "who has just calmed down is given the time to prove it");
    turn(PROPENSITY_WATCH, 1e6f);
    tap_check(law.phase == LAW_RELEASE, "and no more");
}

static void check_end(void)
{
    struct law before;

    build();
    turns(3u, PROPENSITY_SQUEAL);
    turn(PROPENSITY_SQUEAL, 0.0f);
    tap_check(law.phase == LAW_BUILD && law.pressure_pa == 0.0f && law.build_pa_per_s == settings.build_pa_per_s,
              "no demand: no pressure, and all is forgotten");
    build();
    before = law;
    law = law_next(&settings, &before, &(struct law_inputs){.demand_pa = 1e6f, .propensity = PROPENSITY_QUIET});
    tap_check(law.phase == LAW_SAFE && law.pressure_pa == 0.0f, "a plant that is not sound: safe, no pressure");
    turns(20u, PROPENSITY_QUIET);
    turn(PROPENSITY_QUIET, 0.0f);
    turn(PROPENSITY_QUIET, 1e6f);
    tap_check(law.phase == LAW_SAFE && law.pressure_pa == 0.0f, "and so it stays, whatever the driver does");
    tap_check(before.phase == LAW_BUILD && before.wanted_pa > 9999.0f, "what it was is not touched");
    tap_check_text(law_phase_name(LAW_SAFE), "safe", "phases have names");
}

/* Whatever the plant says, pressure keeps its bounds. */
static void check_anything(void)
{
    uint32_t dice = 7u;
    bool holds = true;

    law = law_start(&settings);
    for (unsigned i = 0u; i < 20000u; i++) {
        const float demand_pa = (float)(tap_random(&dice) % 50000u);
        const uint8_t propensity = (uint8_t)(tap_random(&dice) % 4u);

        turn(propensity, demand_pa);
        holds = holds && law.pressure_pa >= 0.0f && law.pressure_pa <= demand_pa &&
                law.build_pa_per_s >= settings.build_least_pa_per_s && law.build_pa_per_s <= settings.build_pa_per_s;
    }
    tap_check(holds, "never below 0, above the demand, faster or slower than it may, whatever comes");
}

void test_law(void)
{
    check_build();
    check_hold();
    check_release();
    check_dither();
    check_patience();
    check_halves();
    check_end();
    check_anything();
}
