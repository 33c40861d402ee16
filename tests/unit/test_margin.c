/* The search for a border, against answers that this test gives by a rule it knows. */
#include "sim/margin.h"

#include "base/fmath.h"
#include "plants.h"
#include "tap.h"
#include "tests.h"

static struct margin margin;
static uint32_t asked;

/* Loud between low and high. */
static bool is_loud_between(float value, float low, float high) { return value > low && value < high; }

static const struct params_info *find(const char *symbol)
{
    size_t length = 0u;

    while (symbol[length] != '\0') {
        length++;
    }
    return params_find(symbol, length);
}

/* Searches from the base's value; sets beyond the limit cannot be had. */
static void search(const char *assignments, const char *symbol, float low, float high, float limit)
{
    const struct params base = plants_params(assignments);
    const struct params_info *info = find(symbol);
    struct params params;

    asked = 0u;
    margin_begin(&margin, &base, info, MARGIN_FACTOR_DEFAULT, is_loud_between(params_value(&base, info), low, high));
    while (asked < 200u && margin_next(&margin, &params)) {
        const float value = params_value(&params, info);

        asked++;
        if (fmath_abs(value) > limit) {
            margin_take(&margin, MARGIN_REFUSED);
        } else {
            margin_take(&margin, is_loud_between(value, low, high) ? MARGIN_LOUD : MARGIN_QUIET);
        }
    }
}

static bool is_bracket(const struct margin_side *side, float border)
{
    const float low = fmath_min(side->quiet, side->loud);
    const float high = fmath_max(side->quiet, side->loud);

    return side->has_border && low <= border && high >= border && high - low <= 1.001e-3f * fmath_abs(border);
}

static void check_borders(void)
{
    search("N0 5", "N0", 2.5f, 13.0f, 1e9f);
    tap_check(is_bracket(&margin.sides[0], 2.5f) && is_bracket(&margin.sides[1], 13.0f),
              "a border on either side, to a thousandth");
    tap_check(margin.sides[0].loud > margin.sides[0].quiet && margin.sides[1].loud < margin.sides[1].quiet,
              "loud on the inner side");
    tap_check(margin_quiets(&margin) == MARGIN_DOWN, "what squeals is turned towards the nearer");
    tap_check(asked < 45u, "with some twenty sets a side");
    search("N0 5", "N0", 7.0f, 1e9f, 1e9f);
    tap_check(!margin.sides[0].has_border && margin.sides[0].searched == 5.0f / 16.0f &&
                  is_bracket(&margin.sides[1], 7.0f),
              "one side may have none as far as one looked");
    tap_check(margin_quiets(&margin) == MARGIN_DOWN, "what is quiet is turned away from it");
    search("alpha -0.02", "alpha", -1.0f, -0.05f, 1e9f);
    tap_check(is_bracket(&margin.sides[0], -0.05f) && !margin.sides[1].has_border, "below 0 more is less");
    tap_check(margin_quiets(&margin) == MARGIN_UP, "and up is away");
    search("N0 5", "N0", 0.0f, 1e9f, 1e9f);
    tap_check(!margin.sides[0].has_border && !margin.sides[1].has_border && margin_quiets(&margin) == MARGIN_NO_WAY,
              "what squeals everywhere has no way out");
    search("N0 5", "N0", -2.0f, -1.0f, 1e9f);
    tap_check(margin_quiets(&margin) == MARGIN_ANY, "what squeals nowhere has any");
}

static void check_limits(void)
{
    search("N0 5", "N0", 70.0f, 1e9f, 20.0f);
    tap_check(!margin.sides[1].has_border && margin.sides[1].searched < 20.0f && margin.sides[1].searched > 9.0f,
              "a set that cannot be had ends the side");
    search("mu_s 8", "mu_s", 20.0f, 30.0f, 1e9f);
    tap_check(!margin.sides[1].has_border && margin.sides[1].searched == 10.0f, "the parameter's own limit too");
    search("alpha 0", "alpha", -100.0f, -0.05f, 1e9f);
    tap_check(is_bracket(&margin.sides[0], -0.05f), "from 0 it starts with a part of the natural unit");
    search("cn 0", "cn", 0.01f, 100.0f, 1e9f);
    tap_check(!margin.sides[0].has_border && is_bracket(&margin.sides[1], 0.01f), "and stays where there is something");
}

static void check_way(void)
{
    search("v0 0", "v0", -1e-9f, 1e-9f, 1e9f);
    margin.is_loud = false;
    margin.sides[0] = (struct margin_side){.has_border = true, .quiet = -1.0f, .loud = -1.1f};
    margin.sides[1] = (struct margin_side){.has_border = true, .quiet = 1.0f, .loud = 1.1f};
    tap_check(margin_quiets(&margin) == MARGIN_NO_WAY, "from 0, with squeal on either side, no way is out");
}

static void check_cover(void)
{
    const struct params table = plants_params("");
    const struct params brake = plants_preset("brake", "");

    tap_check(margin_covers(&table, find("N0")) && !margin_covers(&table, find("N1")), "a constant load is N0");
    tap_check(!margin_covers(&brake, find("N0")) && margin_covers(&brake, find("N1")), "a ramp's is N1");
    tap_check(!margin_covers(&table, find("mu_floor")) && margin_covers(&brake, find("mu_floor")),
              "a floor that there is");
    tap_check(!margin_covers(&table, find("spp")) && !margin_covers(&table, find("t1")) &&
                  !margin_covers(&table, find("x0")),
              "nothing that is no amount");
}

void test_margin(void)
{
    check_borders();
    check_limits();
    check_way();
    check_cover();
}
